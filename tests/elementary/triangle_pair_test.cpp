// Triangle against triangle by the decomposition of the paper (section 4.1): nine pairs of edges, and six pairs of a
// vertex and a face.
#include "chasles/query/first_contact.h"
#include "chasles/search/feature_tests.h"
#include "tests/support/random_poses.h"
#include "tests/support/trajectories.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

using namespace test;
using Triangle = std::array<Eigen::Vector3d, 3>;

Polyhedron body(const Triangle& corners) {
    const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}};
    return Polyhedron::from_polygons(corners, faces);
}

/// The least lower end over all pairs of features, and the number of pairs.
struct Decomposition {
    double first = 2;
    int edge_edge = 0;
    int vertex_face = 0;

    void note(const std::optional<algebra::FeasibleInterval>& found) {
        if (found)
            first = std::min(first, found->lower);
    }
};

double reach(const Polyhedron& triangle) {
    double largest = 0;
    for (const Eigen::Vector3d& v : triangle.vertices())
        largest = std::max(largest, v.cwiseAbs().maxCoeff());
    return largest;
}

Decomposition decomposed(const Polyhedron& moving, const Polyhedron& fixed, const ScrewMotion& screw) {
    const auto maps = motion::rounded(motion::control_maps(cubic_of(screw)));
    search::FeatureTests<double> tests(moving.body(), fixed.body(),
                                       elementary::error_scale(maps, reach(moving), reach(fixed)));
    tests.use(maps, {});
    Decomposition all;
    for (const Edge& a : moving.body().owned_edges(0))
        for (const Edge& b : fixed.body().owned_edges(0)) {
            all.note(tests.touch({ContactKind::edge_edge, {a.from, a.to}, {b.from, b.to}}));
            ++all.edge_edge;
        }
    for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {
        all.note(tests.touch({ContactKind::vertex_face, {vertex, vertex}, {0, 0}}));
        all.note(tests.touch({ContactKind::face_vertex, {0, 0}, {vertex, vertex}}));
        all.vertex_face += 2;
    }
    return all;
}

FirstContact asked(const Polyhedron& moving, const Polyhedron& fixed, const ScrewMotion& screw) {
    return first_contact({.moving = moving, .fixed = fixed, .motion = screw.with_max_turn(3)});
}

const Triangle flat{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 0, 0), Eigen::Vector3d(0, 4, 0)};

ScrewMotion falling(double height) {
    return ScrewMotion::between(Pose(), Pose({0, 0, -height}, Eigen::Quaterniond::Identity()));
}

TEST(TrianglePair, Section41Fig5HasNinePairsOfEdgesAndSixOfVertexAndFace) {
    const Polyhedron moving = body({Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(2, 1, 2), Eigen::Vector3d(1, 2, 3)});
    const Decomposition all = decomposed(moving, body(flat), falling(4));
    EXPECT_EQ(all.edge_edge, 9);
    EXPECT_EQ(all.vertex_face, 6);
    EXPECT_NEAR(all.first, 0.25, 1e-12);
}

TEST(TrianglePair, Section41Fig5VertexMeetsFace) {
    const Polyhedron moving = body({Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(2, 1, 2), Eigen::Vector3d(1, 2, 3)});
    const FirstContact found = asked(moving, body(flat), falling(4));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_NEAR(found.time.lower, 0.25, 1e-12);
    ASSERT_EQ(found.contacts.size(), 1u);
    EXPECT_EQ(found.contacts[0].kind, ContactKind::vertex_face);
    EXPECT_EQ(found.contacts[0].moving.first, 0u);
    EXPECT_TRUE(found.contacts[0].point.isApprox(Eigen::Vector3d(1, 1, 0), 1e-11));
}

TEST(TrianglePair, Section41Fig5FaceMeetsVertex) {
    const Triangle high{Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(4, 0, 1), Eigen::Vector3d(0, 4, 1)};
    const Polyhedron peak = body({Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(2, 1, -2), Eigen::Vector3d(1, 2, -3)});
    const FirstContact found = asked(body(high), peak, falling(4));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_NEAR(found.time.lower, 0.25, 1e-12);
    ASSERT_EQ(found.contacts.size(), 1u);
    EXPECT_EQ(found.contacts[0].kind, ContactKind::face_vertex);
    EXPECT_EQ(found.contacts[0].fixed.first, 0u);
}

TEST(TrianglePair, Section41Fig5EdgeMeetsEdge) {
    const Polyhedron upper = body({Eigen::Vector3d(0, -1, 1), Eigen::Vector3d(0, 1, 1), Eigen::Vector3d(0, 0, 3)});
    const Polyhedron lower = body({Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, -2)});
    const FirstContact found = asked(upper, lower, falling(4));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_NEAR(found.time.lower, 0.25, 1e-12);
    ASSERT_EQ(found.contacts.size(), 1u);
    EXPECT_EQ(found.contacts[0].kind, ContactKind::edge_edge);
    EXPECT_LT(found.contacts[0].point.norm(), 1e-11);
}

TEST(TrianglePair, Section41Fig5QueryFindsTheFirstOfAllFifteen) {
    Random random(751);
    int contacts = 0;
    int clear = 0;
    for (int trial = 0; trial < 600; ++trial) {
        const auto corners = [&](const Eigen::Vector3d& centre) {
            return Triangle{centre + random_point(random, 2), centre + random_point(random, 2),
                            centre + random_point(random, 2)};
        };
        const Polyhedron moving = body(corners({0, 0, 4.5}));
        const Polyhedron fixed = body(corners({0, 0, 0}));
        const Pose goal = random_goal(random, Pose(), random.uniform(0, 0.7), 1);
        const auto screw =
            ScrewMotion::between(Pose(), Pose(goal.translation - Eigen::Vector3d(0, 0, 4.5), goal.rotation));
        const FirstContact found = asked(moving, fixed, screw);
        const Decomposition all = decomposed(moving, fixed, screw);
        ASSERT_EQ(found.verdict == Verdict::clear, all.first > 1);
        if (all.first > 1) {
            ++clear;
            continue;
        }
        ++contacts;
        EXPECT_NEAR(found.tau.lower, all.first, 1e-9);
    }
    EXPECT_GE(contacts, 120);
    EXPECT_GE(clear, 60);
}

} // namespace
} // namespace chasles
