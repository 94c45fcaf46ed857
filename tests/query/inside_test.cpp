// Bodies inside of each other: which one, for every kind of question, against membership in boxes by exact rationals.
#include "chasles/base/invalid_input.h"
#include "chasles/mesh/primitives.h"
#include "chasles/query/least_distance.h"
#include "chasles/query/path.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"
#include "tests/support/rational.h"
#include "tests/support/refusal.h"

#include <array>
#include <cstdlib>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// A box between two corners; turned inwards, it takes its inside away.
struct SignedBox {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
    bool is_inwards = false;
};

/// Boxes as the connected parts of one surface.
Polyhedron body_of(const std::vector<SignedBox>& boxes, Solid solid = Solid::automatic) {
    static const std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
    for (const SignedBox& box : boxes) {
        const auto first = std::uint32_t(vertices.size());
        for (std::uint32_t corner = 0; corner < 8; ++corner)
            vertices.emplace_back(corner & 1U ? box.upper.x() : box.lower.x(),
                                  corner & 2U ? box.upper.y() : box.lower.y(),
                                  corner & 4U ? box.upper.z() : box.lower.z());
        for (const auto& side : sides) {
            std::vector<std::uint32_t> face;
            for (const std::uint32_t corner : side)
                face.push_back(first + corner);
            if (box.is_inwards)
                std::ranges::reverse(face);
            faces.push_back(face);
        }
    }
    return Polyhedron::from_polygons(vertices, faces, {.solid = solid});
}

SignedBox cube(double half, bool is_inwards = false) {
    return {Eigen::Vector3d::Constant(-half), Eigen::Vector3d::Constant(half), is_inwards};
}

/// The pose of the fixed body as the moving one sees it.
Pose inverse(const Pose& pose) {
    const Eigen::Quaterniond back = pose.rotation.normalized().conjugate();
    return {-(back * pose.translation), back};
}

FirstContact at_rest(const Polyhedron& moving, const Polyhedron& fixed, const Pose& pose = Pose()) {
    return first_contact({.moving = moving, .fixed = fixed, .motion = ScrewMotion::between(pose, pose)});
}

void expect_inside(const FirstContact& found, bool moving_is_inside) {
    ASSERT_EQ(found.verdict, Verdict::contact_at_start);
    EXPECT_TRUE(found.certain);
    ASSERT_TRUE(found.inside);
    EXPECT_EQ(found.inside->moving_is_inside, moving_is_inside);
    EXPECT_TRUE(found.contacts.empty());
    EXPECT_FALSE(found.overlap);
    EXPECT_EQ(found.time.upper, 0);
    EXPECT_EQ(found.clear_until, 0);
}

TEST(Inside, EitherBodyMayBeInsideOfTheOtherOne) {
    const Polyhedron small = body_of({cube(0.1)}), large = body_of({cube(1)});
    const Pose there({0.5, 0.25, -0.5}, Eigen::Quaterniond(1, 0.2, 0.3, -0.1));
    const FirstContact inner = at_rest(small, large, there);
    expect_inside(inner, true);
    EXPECT_TRUE(inner.inside->point.isApprox(there.isometry() * small.vertices()[inner.inside->vertex.first], 1e-15));
    expect_inside(at_rest(large, small, inverse(there)), false);
    expect_inside(inner.swapped(), false);
    EXPECT_EQ(at_rest(small, large, shifted(1.5, 0.25, -0.5)).verdict, Verdict::clear);
}

TEST(Inside, IsAContactForEveryQuestion) {
    const Polyhedron small = body_of({cube(0.1)}), large = body_of({cube(1)});
    const Pose start = shifted(0.5, 0, 0), goal = shifted(5, 0, 0);
    for (const Motion& motion : {Motion::screw(start, goal), Motion::sweep(start, goal), Motion::velocity(start, goal),
                                 Motion::b_spline({start, start, goal, goal})})
        for (const Find find : {Find::first, Find::any, Find::first_with_all_contacts})
            for (const double margin : {0.0, 0.2, 0.45, 3.0}) {
                expect_inside(first_contact({.moving = small,
                                             .fixed = large,
                                             .motion = motion,
                                             .options = {.margin = margin, .find = find}}),
                              true);
                if (margin > 0)
                    expect_inside(first_contact({.moving = small,
                                                 .fixed = large,
                                                 .motion = motion,
                                                 .options = {.margin = margin, .hold = 0.01, .find = find}}),
                                  true);
            }
    const LeastDistance least = least_distance({small, large, ScrewMotion::between(start, start)});
    EXPECT_EQ(least.distance.upper, 0);
    EXPECT_TRUE(least.certain);
    EXPECT_TRUE(least.inside && least.inside->moving_is_inside);
    expect_inside(
        first_contact_on_path({small, large, {Motion::at_rest(start), ScrewMotion::between(start, goal)}}).contact,
        true);
}

/// One side of a tetrahedron has its own corners, a rounding away from the others: a seam, which counts as closed.
TEST(Inside, BesideSeamsIsTold) {
    const double seam = 0x1p-46, gap = 0x1p-41;
    Body body{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1 + seam, 0, 0}, {0, 1 + seam, 0}, {0, 0, 1 + seam}},
              {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {4, 5, 6}}};
    const Polyhedron fixed = body.polyhedron();
    ASSERT_EQ(fixed.report().solid_parts, 1U);
    ASSERT_FALSE(fixed.report().closed);
    for (const double shift : {gap, -gap}) {
        const Polyhedron moving =
            triangle({0.5, 0.25, 0.25 + shift}, {0.25, 0.5, 0.25 + shift}, {0.25, 0.25, 0.5 + shift}).polyhedron();
        const FirstContact found = at_rest(moving, fixed);
        EXPECT_TRUE(found.certain);
        EXPECT_EQ(found.verdict, shift > 0 ? Verdict::clear : Verdict::contact_at_start);
        EXPECT_EQ(found.inside.has_value(), shift < 0);
    }
}

TEST(Inside, SurfacesThatMeetAtTheStartSayMore) {
    const Polyhedron small = body_of({cube(0.5)}), large = body_of({cube(1)});
    for (const double shift : {0.5, 0.75, 1.0}) { // touching from within, crossing
        const FirstContact found = at_rest(small, large, shifted(shift, 0.0625, 0.125));
        EXPECT_EQ(found.verdict, Verdict::contact_at_start);
        EXPECT_FALSE(found.inside) << shift;
        EXPECT_TRUE(found.overlap || !found.contacts.empty()) << shift;
    }
}

TEST(Inside, HollowShellsAndRoomsAreHollow) {
    const Polyhedron thing = body_of({cube(0.1)});
    const Polyhedron shell = body_of({cube(1), cube(0.9, true)}), room = body_of({cube(1, true)});
    EXPECT_EQ(at_rest(thing, shell).verdict, Verdict::clear);
    EXPECT_EQ(at_rest(thing, room).verdict, Verdict::clear);
    expect_inside(at_rest(body_of({cube(0.02)}), shell, shifted(0.95, 0, 0)), true);
    expect_inside(at_rest(body_of({cube(2)}), room), false); // its walls are in solid matter
    expect_inside(at_rest(body_of({cube(2)}), shell), false);
    expect_inside(at_rest(thing, body_of({cube(1), cube(0.9), cube(0.8, true)})), true); // 2 - 1 times around
}

TEST(Inside, SolidSaysWhetherTheInsideCounts) {
    const Polyhedron thing = body_of({cube(0.1)}), large = body_of({cube(1)});
    EXPECT_EQ(at_rest(thing, body_of({cube(1)}, Solid::no)).verdict, Verdict::clear);
    expect_inside(at_rest(thing, body_of({cube(1)}, Solid::yes)), true);
    expect_inside(at_rest(body_of({cube(0.1)}, Solid::no), large), true); // a surface in a solid
    std::vector<Eigen::Vector3d> vertices(large.vertices().begin(), large.vertices().end());
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t face = 0; face + 1 < large.face_count(); ++face)
        faces.emplace_back(large.face(face).begin(), large.face(face).end());
    EXPECT_EQ(at_rest(thing, Polyhedron::from_polygons(vertices, faces)).verdict, Verdict::clear);
    EXPECT_EQ(
        refusal([&] { (void)Polyhedron::from_polygons(vertices, faces, {.solid = Solid::yes}); }),
        "mesh: solid: the surface is not closed, or its faces are not turned the same way: along 4 edges, faces do "
        "not run equally often in both directions (vertices 1-3, 1-5, 3-7, ...); mend the mesh, or leave solid at "
        "automatic");
}

/// No box of the bodies touches another one, so the largest nodes prove the surfaces apart at once.
TEST(Inside, NoCoarseTestSkipsIt) {
    const Polyhedron ball = enclosing_sphere(0.2, 0.0005).shape;
    ASSERT_GT(ball.face_count(), 1000U);
    const Polyhedron hall = body_of({cube(10)});
    Random random(4401);
    for (int i = 0; i < 200; ++i) {
        const Pose start = random_pose(random, 4), goal = random_goal(random, start, 0.3, 0.5);
        expect_inside(first_contact({.moving = ball, .fixed = hall, .motion = ScrewMotion::between(start, goal)}),
                      true);
        expect_inside(first_contact({.moving = ball, .fixed = hall, .motion = ConstantVelocity::between(start, goal)}),
                      true);
        expect_inside(
            first_contact(
                {.moving = hall, .fixed = ball, .motion = ScrewMotion::between(inverse(start), inverse(goal))}),
            false);
    }
}

/// Nearer to the surface than any rounding to double: exact arithmetic decides.
TEST(Inside, IsExact) {
    const double gap = 1e-18;
    const Polyhedron large = body_of({{Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}});
    const auto speck = [&](double lower, double upper) {
        return body_of({{Eigen::Vector3d::Constant(lower), Eigen::Vector3d::Constant(upper)}});
    };
    expect_inside(at_rest(speck(gap, 2 * gap), large), true);
    EXPECT_EQ(at_rest(speck(-2 * gap, -gap), large).verdict, Verdict::clear);
}

/// A random body on a grid, so that parts share corners, edges and sides, and lie in each other.
std::vector<SignedBox> random_boxes(Random& random, double size) {
    std::vector<SignedBox> boxes;
    const int count = random.integer(1, 8);
    for (int i = 0; i < count; ++i) {
        SignedBox box;
        for (int axis = 0; axis < 3; ++axis) {
            const int lower = random.integer(0, 6), upper = random.integer(lower + 1, 8);
            box.lower[axis] = size * (lower - 4);
            box.upper[axis] = size * (upper - 4);
        }
        box.is_inwards = random.chance(0.25);
        boxes.push_back(box);
    }
    return boxes;
}

struct ExactPlace {
    std::array<std::array<Rational, 3>, 3> turn; ///< over the square of the quaternion
    std::array<Rational, 3> shift;

    explicit ExactPlace(const Pose& pose) {
        const Rational w = exact(pose.rotation.w()), x = exact(pose.rotation.x()), y = exact(pose.rotation.y()),
                       z = exact(pose.rotation.z());
        const Rational square = w * w + x * x + y * y + z * z;
        turn = {
            {{(w * w + x * x - y * y - z * z) / square, 2 * (x * y - w * z) / square, 2 * (x * z + w * y) / square},
             {2 * (x * y + w * z) / square, (w * w - x * x + y * y - z * z) / square, 2 * (y * z - w * x) / square},
             {2 * (x * z - w * y) / square, 2 * (y * z + w * x) / square, (w * w - x * x - y * y + z * z) / square}}};
        for (int i = 0; i < 3; ++i)
            shift[std::size_t(i)] = exact(pose.translation[i]);
    }
    [[nodiscard]] std::array<Rational, 3> operator()(const Eigen::Vector3d& p) const {
        std::array<Rational, 3> moved = shift;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                moved[i] += turn[i][j] * exact(p[Eigen::Index(j)]);
        return moved;
    }
    [[nodiscard]] std::array<Rational, 3> back(const Eigen::Vector3d& p) const {
        std::array<Rational, 3> moved;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                moved[i] += turn[j][i] * (exact(p[Eigen::Index(j)]) - shift[j]);
        return moved;
    }
};

bool is_in(const std::vector<SignedBox>& boxes, const std::array<Rational, 3>& point) {
    int winding = 0;
    for (const SignedBox& box : boxes) {
        bool has_point = true;
        for (std::size_t i = 0; i < 3; ++i)
            has_point = has_point && exact(box.lower[Eigen::Index(i)]) < point[i] &&
                        point[i] < exact(box.upper[Eigen::Index(i)]);
        winding += !has_point ? 0 : box.is_inwards ? -1 : 1;
    }
    return winding > 0;
}

TEST(Inside, AgreesWithExactMembershipInBoxes) {
    Random random(4402);
    const int rounds = std::getenv("CHASLES_LONG") ? 20'000 : 1'500; // NOLINT(concurrency-mt-unsafe)
    int nested = 0, clear = 0, meeting = 0;
    for (int round = 0; round < rounds; ++round) {
        const std::vector<SignedBox> inner = random_boxes(random, random.chance(0.7) ? 0.0625 : 0.5),
                                     outer = random_boxes(random, 1);
        const bool is_turned = random.chance(0.5);
        const Pose pose =
            is_turned ? random_pose(random, 4) : Pose(random_point(random, 4), Eigen::Quaterniond::Identity());
        const ExactPlace place(pose);
        bool moving_is_in = false, fixed_is_in = false;
        const Polyhedron moving = body_of(inner), fixed = body_of(outer);
        for (const Eigen::Vector3d& vertex : moving.vertices())
            moving_is_in = moving_is_in || is_in(outer, place(vertex));
        for (const Eigen::Vector3d& vertex : fixed.vertices())
            fixed_is_in = fixed_is_in || is_in(inner, place.back(vertex));
        const bool is_screw = random.chance(0.5);
        const Motion motion = is_screw ? Motion(ScrewMotion::between(pose, pose)) : Motion::at_rest(pose);
        const FirstContact surfaces = first_contact({body_of(inner, Solid::no), body_of(outer, Solid::no), motion});
        const FirstContact found = first_contact({moving, fixed, motion});
        EXPECT_EQ(found.verdict, surfaces.verdict == Verdict::contact_at_start || moving_is_in || fixed_is_in
                                     ? Verdict::contact_at_start
                                     : Verdict::clear)
            << round;
        EXPECT_TRUE(found.certain) << round;
        EXPECT_EQ(found.inside.has_value(), surfaces.verdict == Verdict::clear && (moving_is_in || fixed_is_in));
        if (found.inside) {
            EXPECT_TRUE(found.inside->moving_is_inside ? moving_is_in : fixed_is_in) << round;
            ++nested;
        }
        clear += found.verdict == Verdict::clear;
        meeting += surfaces.verdict == Verdict::contact_at_start;
    }
    EXPECT_GT(nested, rounds / 20);
    EXPECT_GT(clear, rounds / 20);
    EXPECT_GT(meeting, rounds / 20);
}

} // namespace
} // namespace chasles::test
