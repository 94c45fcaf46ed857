// Contact sets: each contact once, named for what it is, with a normal that both features allow.
#include "chasles/contact/constraint_rows.h"
#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"
#include "tests/support/grid.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

const Polyhedron& cube() {
    static const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    return body;
}

const Polyhedron& table() {
    static const Polyhedron body = box({5, 5, 0.5}).polyhedron();
    return body;
}

/// The square [-5, 5]^2 at z = 1/2, of 2 n^2 triangles.
Polyhedron tiled_table(std::uint32_t n) {
    Body body;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            body.vertices.emplace_back(10.0 * i / n - 5, 10.0 * j / n - 5, 0.5);
    body.faces = grid_triangles(n, n);
    return body.polyhedron();
}

Polyhedron tiled_torus() {
    const Soup soup = torus(48, 24);
    return Polyhedron::from_polygons(soup.vertices, soup.faces);
}

FirstContact contacts_of(const Polyhedron& moving, const Polyhedron& fixed, const Pose& start, const Pose& goal,
                         double margin = 0) {
    return first_contact({.moving = moving,
                          .fixed = fixed,
                          .motion = ScrewMotion::between(start, goal, 3), // one screw, as `ScrewMotion::pose_at` has it
                          .options = {.margin = margin, .find = Find::first_with_all_contacts}});
}

std::vector<ContactKind> kinds_of(const FirstContact& found) {
    std::vector<ContactKind> kinds;
    for (const Contact& contact : found.contacts)
        kinds.push_back(contact.kind);
    return kinds;
}

void expect_normals(const FirstContact& found, const Eigen::Vector3d& normal) {
    for (const Contact& contact : found.contacts)
        EXPECT_LT((contact.normal - normal).norm(), 1e-9) << contact.normal.transpose();
}

using enum ContactKind;
using Kinds = std::vector<ContactKind>;

TEST(ContactSet, BoxOnTableHasFourCornersWhateverTheTriangles) {
    for (const std::uint32_t n : {1U, 2U, 7U, 40U})
        for (const double margin : {0.0, 0.25}) {
            const auto found = contacts_of(cube(), tiled_table(n), shifted(0.1, 0.3, 4), shifted(0.1, 0.3, 0), margin);
            ASSERT_EQ(kinds_of(found), Kinds(4, vertex_face)) << n << " " << margin;
            for (std::uint32_t corner = 0; corner < 4; ++corner)
                EXPECT_EQ(found.contacts[corner].moving.first, corner);
            expect_normals(found, Eigen::Vector3d::UnitZ());
        }
}

TEST(ContactSet, BoxOverTheRimOfATable) {
    const auto found = contacts_of(cube(), table(), shifted(5, 5, 4), shifted(5, 5, 0));
    EXPECT_EQ(kinds_of(found), (Kinds{vertex_face, face_vertex, edge_edge, edge_edge}));
    expect_normals(found, Eigen::Vector3d::UnitZ());
}

TEST(ContactSet, EqualFacesMeetAtTheirCorners) {
    const auto found = contacts_of(cube(), cube(), shifted(3, 0, 0), shifted(0, 0, 0));
    EXPECT_EQ(kinds_of(found), Kinds(4, vertex_vertex));
    expect_normals(found, Eigen::Vector3d::UnitX());
}

TEST(ContactSet, TurnedFacesMeetAtCrossingsOfTheirRims) {
    const auto found =
        contacts_of(cube(), cube(), turned({3, 0, 0}, {1, 0, 0}, 0.4), turned({0, 0, 0}, {1, 0, 0}, 0.4));
    EXPECT_EQ(kinds_of(found), Kinds(8, edge_edge)) << "an octagon";
    expect_normals(found, Eigen::Vector3d::UnitX());
}

TEST(ContactSet, ParallelEdgesMeetAtTheEndsOfWhatTheyShare) {
    for (const double margin : {0.0, 0.01}) {
        const auto found = contacts_of(cube(), cube(), shifted(2, 0.3, 2), shifted(0, 0.3, 0), margin);
        ASSERT_EQ(kinds_of(found), (Kinds{vertex_edge, edge_vertex}));
        EXPECT_NEAR(found.contacts[0].point.y(), -0.2, 1e-12);
        EXPECT_NEAR(found.contacts[1].point.y(), 0.5, 1e-12);
        expect_normals(found, Eigen::Vector3d(1, 0, 1).normalized());
    }
}

TEST(ContactSet, EqualEdgesMeetAtTheirEnds) {
    const auto found = contacts_of(cube(), cube(), shifted(2, 0, 2), shifted(0, 0, 0));
    EXPECT_EQ(kinds_of(found), Kinds(2, vertex_vertex));
}

TEST(ContactSet, TipOnTip) {
    for (const double margin : {0.0, 0.01}) {
        const auto found = contacts_of(cube(), cube(), shifted(2, 2, 2), shifted(0, 0, 0), margin);
        ASSERT_EQ(kinds_of(found), Kinds{vertex_vertex});
        EXPECT_EQ(found.contacts[0].moving, (Feature{0, 0}));
        EXPECT_EQ(found.contacts[0].fixed, (Feature{7, 7}));
        EXPECT_NEAR(found.contacts[0].approach_speed, 2 * std::sqrt(3), 1e-9);
        EXPECT_NEAR(found.contacts[0].gap, margin, 1e-11);
    }
}

TEST(ContactSet, NormalAtATipIsTheWayFromWhereTheTipsWereNearest) {
    // Coming in flat, the nearest points before were on an edge, or on a face: the normal is that one's.
    const Eigen::Vector3d tip(1, 1, 1);
    const auto normal_for = [&](const Eigen::Vector3d& from) {
        const Eigen::Vector3d start = tip + from;
        const auto found = contacts_of(cube(), cube(), shifted(start.x(), start.y(), start.z()), shifted(1, 1, 1));
        EXPECT_EQ(kinds_of(found), Kinds{vertex_vertex});
        return found.contacts.at(0).normal;
    };
    EXPECT_LT((normal_for({1, 2, 3}) - Eigen::Vector3d(1, 2, 3).normalized()).norm(), 1e-9);
    EXPECT_LT((normal_for({1, 2, -0.5}) - Eigen::Vector3d(1, 2, 0).normalized()).norm(), 1e-9);
    EXPECT_LT((normal_for({1, -2, -0.5}) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-9);
}

/// An octahedron with tips at x = length and x = -length, and at a distance of 1 along the other axes.
Polyhedron octahedron(double length) {
    Body body;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0})
            body.vertices.push_back(sign * (axis == 0 ? length : 1) * Eigen::Vector3d::Unit(axis));
    body.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return body.polyhedron();
}

/// Whether both tips of octahedra allow a normal: no direction along a side from the fixed tip (at +x) or against one
/// from the moving tip (at -x) leads against it.
double excess_of(const Eigen::Vector3d& normal, double moving_length) {
    double excess = -1;
    for (const double length : {1.0, moving_length})
        for (const double y : {1.0, -1.0})
            for (const Eigen::Vector3d& side : {Eigen::Vector3d(-length, y, 0), Eigen::Vector3d(-length, 0, y)})
                excess = std::max(excess, normal.dot(side));
    return excess;
}

TEST(ContactSet, NormalAtTipsOfFourSidesIsTheBestThatBothAllow) {
    std::mt19937 random(8);
    for (const double length : {1.0, 4.0}) // the sides of a long tip allow more than those of the fixed tip
        for (int i = 0; i < 12; ++i) {
            const Eigen::Vector3d from(1, uniform(random, -3, 3), uniform(random, -3, 3));
            const auto found =
                contacts_of(octahedron(length), octahedron(1), shifted(length + 1 + from.x(), from.y(), from.z()),
                            shifted(length + 1, 0, 0));
            ASSERT_EQ(kinds_of(found), Kinds{vertex_vertex});
            const Eigen::Vector3d normal = found.contacts[0].normal;
            EXPECT_LT(excess_of(normal, length), 1e-9);
            for (int sample = 0; sample < 3000; ++sample) {
                const Eigen::Vector3d other = (normal + random_vector(random, 0.5)).normalized();
                EXPECT_TRUE(excess_of(other, length) > 0 || other.dot(from) <= normal.dot(from) + 1e-9);
            }
        }
}

TEST(ContactSet, ABoundedListSaysThatItIsCut) {
    const auto on_itself = contacts_of(tiled_torus(), tiled_torus(), shifted(0, 0, 0), shifted(1, 0, 0));
    EXPECT_EQ(on_itself.verdict, Verdict::contact_at_start);
    EXPECT_TRUE(on_itself.contacts_cut);
    EXPECT_GT(on_itself.contacts.size(), 20U);
    EXPECT_LE(on_itself.contacts.size(), most_contacts);
    const auto crossing = contacts_of(cube(), cube(), turned({0.9, 0.8, 0.7}, {1, 2, 3}, 0.3), shifted(3, 0, 0));
    EXPECT_TRUE(crossing.overlap);
    EXPECT_TRUE(crossing.contacts_cut) << "the search ended with the first overlap";
    EXPECT_FALSE(contacts_of(cube(), table(), shifted(0, 0, 4), shifted(0, 0, 0)).contacts_cut);
    EXPECT_FALSE(contacts_of(cube(), cube(), shifted(0, 0, 0), shifted(3, 0, 0)).contacts_cut)
        << "a cube on itself has eight contacts";
}

TEST(ContactSet, FlatLandingOfManyFaces) {
    // 800 triangles on 1,800: the corners of the smaller square, at which nothing but its own vertices is.
    Body sheet;
    for (std::uint32_t i = 0; i <= 20; ++i)
        for (std::uint32_t j = 0; j <= 20; ++j)
            sheet.vertices.emplace_back(0.1 * i - 1, 0.1 * j - 1, 0);
    sheet.faces = grid_triangles(20, 20);
    const auto found = contacts_of(sheet.polyhedron(), tiled_table(30), turned({0.01, 0.02, 2}, {0, 0, 1}, 0.2),
                                   turned({0.01, 0.02, 0}, {0, 0, 1}, 0.2));
    ASSERT_EQ(found.contacts.size(), 4u);
    for (const Contact& contact : found.contacts) {
        EXPECT_EQ(contact.kind, vertex_face);
        EXPECT_TRUE(contact.moving.first == 0 || contact.moving.first == 20 || contact.moving.first == 420 ||
                    contact.moving.first == 440);
    }
}

TEST(ConstraintRows, ARowTimesTheTwistIsTheRateOfTheGap) {
    const Pose start = turned({0.3, 0.2, 2}, {1, 0.3, 0.2}, 0.5);
    const Pose goal = turned({0.1, 0.4, 0}, {1, -0.3, 0.5}, 0.7);
    for (const double margin : {0.0, 0.2}) {
        const auto motion = ScrewMotion::between(start, goal);
        const auto found = contacts_of(cube(), table(), start, goal, margin);
        ASSERT_EQ(found.verdict, Verdict::contact);
        const auto rows = constraint_rows(found.contacts);
        ASSERT_EQ(rows.rows(), static_cast<Eigen::Index>(found.contacts.size()));
        // The twist by central differences of the motion's own poses.
        const double step = 1e-6;
        const Eigen::Isometry3d before = motion.pose_at(found.time.lower - step).isometry();
        const Eigen::Isometry3d after = motion.pose_at(found.time.lower + step).isometry();
        const Eigen::Isometry3d here = motion.pose_at(found.time.lower).isometry();
        const Eigen::Matrix4d rate = (after.matrix() - before.matrix()) / (2 * step) * here.inverse().matrix();
        Eigen::Matrix<double, 6, 1> twist;
        twist << rate(0, 3), rate(1, 3), rate(2, 3), rate(2, 1), rate(0, 2), rate(1, 0);
        for (Eigen::Index i = 0; i < rows.rows(); ++i)
            EXPECT_NEAR(rows.row(i).dot(twist), -found.contacts[static_cast<std::size_t>(i)].approach_speed, 1e-6);
    }
}

TEST(ConstraintRows, LiftingOpensAndTurningOverACornerCloses) {
    const auto found = contacts_of(cube(), table(), shifted(0, 0, 4), shifted(0, 0, 0));
    const auto rows = constraint_rows(found.contacts);
    ASSERT_EQ(rows.rows(), 4);
    const auto rates = [&](const Eigen::Vector3d& linear, const Eigen::Vector3d& angular) {
        Eigen::Matrix<double, 6, 1> twist;
        twist << linear, angular;
        return Eigen::VectorXd(rows * twist);
    };
    EXPECT_GT(rates({0, 0, 1}, {0, 0, 0}).minCoeff(), 0.9);
    EXPECT_LT(rates({1, 2, 0}, {0, 0, 3}).cwiseAbs().maxCoeff(), 1e-9) << "sliding and spinning on the table";
    EXPECT_LT(rates({0, 0, 0}, {1, 0, 0}).minCoeff(), -0.4) << "tilting presses one side into it";
}

} // namespace
} // namespace chasles::test
