// Whether two features are near, against the distance of triangles by clamping.
#include "chasles/contact/near_pair.h"

#include "chasles/motion/any_trajectory.h"
#include "tests/query/bodies.h"
#include "tests/support/surface_distance.h"

#include <gtest/gtest.h>

namespace chasles::contact {
namespace {

using test::random_vector;
using test::uniform;
using Corners = test::Triangle3<double>;

/// Calls `visit` with every pair of features of two triangles.
template <class Visit>
void for_each_pair(Visit visit) {
    const auto vertex = [](std::uint32_t i) { return Feature{i, i}; };
    const auto edge = [](std::uint32_t i) {
        const auto [from, to] = std::minmax({i, (i + 1) % 3});
        return Feature{from, to};
    };
    for (std::uint32_t i = 0; i < 3; ++i) {
        visit({ContactKind::vertex_face, vertex(i), {0, 0}});
        visit({ContactKind::face_vertex, {0, 0}, vertex(i)});
        for (std::uint32_t j = 0; j < 3; ++j) {
            visit({ContactKind::edge_edge, edge(i), edge(j)});
            visit({ContactKind::vertex_edge, vertex(i), edge(j)});
            visit({ContactKind::edge_vertex, edge(i), vertex(j)});
            visit({ContactKind::vertex_vertex, vertex(i), vertex(j)});
        }
    }
}

Corners random_corners(std::mt19937& random) {
    return {random_vector(random, 1), random_vector(random, 1), random_vector(random, 1)};
}

double distance_of(const Corners& a, const Corners& b) {
    return std::sqrt(test::squared_distance_of_triangles<double>(a, b));
}

TEST(NearTest, NoVertexIsBelowASegment) {
    test::Body wire = test::triangle({0, 0, -50}, {1, 0, -50}, {0, 1, -50});
    wire.vertices.insert(wire.vertices.end(), {{-1, 0, 0}, {1, 0, 0}});
    wire.faces.push_back({3, 4, 4});
    const Polyhedron fixed = wire.polyhedron();
    const Polyhedron moving =
        test::triangle({0, 0, 0}, {1, 0, 5}, {0, 1, 5}).polyhedron(); // its vertex 0 is on the wire
    const Motion motion = ScrewMotion::between(Pose{}, Pose{});
    const auto piece = motion.trajectory().pieces()->at(0);
    const motion::ControlMaps<double> maps = motion::double_maps(piece->cubic());
    const RelativeConfiguration bodies(moving.body(), fixed.body(), maps, 0);
    const ContactScene scene{bodies, true, 0.125, 1e-13};
    NearTest test(scene);
    EXPECT_FALSE(test.are_near({ContactKind::vertex_face, {0, 0}, {1, 1}}));
    EXPECT_TRUE(test.are_near({ContactKind::vertex_edge, {0, 0}, {3, 4}}));
    EXPECT_EQ(test.side_on_fixed_face(1, 0), 0);
}

TEST(NearTest, SomeFeaturesOfTrianglesAreNearIfTheTrianglesAre) {
    std::mt19937 random(3);
    int near_pairs = 0, far_pairs = 0;
    for (int i = 0; i < 3000; ++i) {
        const Corners a = random_corners(random);
        const Corners b = random_corners(random);
        const Pose pose = test::random_pose(random, 2, 3);
        const Eigen::Isometry3d placed = pose.isometry();
        const double distance = distance_of({placed * a[0], placed * a[1], placed * a[2]}, b);
        if (distance < 1e-3)
            continue;
        const Polyhedron moving = test::triangle(a[0], a[1], a[2]).polyhedron();
        const Polyhedron fixed = test::triangle(b[0], b[1], b[2]).polyhedron();
        const Motion motion = ScrewMotion::between(pose, pose);
        const auto piece = motion.trajectory().pieces()->at(0);
        const motion::ControlMaps<double> maps = motion::double_maps(piece->cubic());
        const RelativeConfiguration bodies(moving.body(), fixed.body(), maps, 0);
        const double margin = distance * uniform(random, 0.5, 1.5);
        const ContactScene scene{bodies, true, margin, 1e-13};
        NearTest test(scene);
        bool is_any_near = false, is_any_contact = false;
        double least = 1e300;
        for_each_pair([&](const FeaturePair& features) {
            if (!test.are_near(features))
                return;
            is_any_near = true;
            is_any_contact = is_any_contact || test.are_in_contact(features);
            const double apart = bodies.nearest(features).apart().norm();
            EXPECT_LE(apart, margin + 2e-13);
            EXPECT_GE(apart, distance - 1e-12) << "no features are nearer than the triangles";
            least = std::min(least, apart);
        });
        EXPECT_EQ(is_any_near, distance <= margin) << i;
        EXPECT_EQ(is_any_contact, is_any_near) << "the nearest features are at a local minimum";
        EXPECT_TRUE(!is_any_near || std::abs(least - distance) < 1e-12);
        (is_any_near ? near_pairs : far_pairs) += 1;
    }
    EXPECT_GT(near_pairs, 500);
    EXPECT_GT(far_pairs, 500);
}

TEST(NearTest, TouchingFeaturesNeedNotBeInside) {
    const Polyhedron a = test::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).polyhedron();
    const Polyhedron b = test::triangle({0, 0, 0}, {-1, 0, 1}, {0, -1, 1}).polyhedron();
    const Motion motion = ScrewMotion::between(Pose(), Pose());
    const auto piece = motion.trajectory().pieces()->at(0);
    const motion::ControlMaps<double> maps = motion::double_maps(piece->cubic());
    const RelativeConfiguration bodies(a.body(), b.body(), maps, 0);
    const ContactScene scene{bodies, true, 0, 1e-13};
    NearTest test(scene);
    EXPECT_TRUE(test.are_near({ContactKind::vertex_face, {0, 0}, {0, 0}})) << "a vertex at a corner of the face";
    EXPECT_TRUE(test.are_near({ContactKind::edge_edge, {0, 1}, {0, 1}})) << "edges that touch at their ends";
    EXPECT_FALSE(test.are_near({ContactKind::vertex_face, {1, 1}, {0, 0}}));
    EXPECT_FALSE(test.are_near({ContactKind::edge_edge, {1, 2}, {0, 1}}));
}

TEST(NearTest, AFaceWithoutAReliableNormalCountsAsItsSides) {
    const Polyhedron sliver = test::triangle({0, 0, 0}, {1, 1, 0}, {2, 2, 1e-18}).polyhedron();
    const Polyhedron other = test::triangle({1.5, 1.5, 0.1}, {1.5, 1.5, 2}, {1.5, 3, 2}).polyhedron();
    const Motion motion = ScrewMotion::between(Pose(), Pose());
    const auto piece = motion.trajectory().pieces()->at(0);
    const motion::ControlMaps<double> maps = motion::double_maps(piece->cubic());
    const RelativeConfiguration bodies(other.body(), sliver.body(), maps, 0);
    for (const auto& [margin, is_near] : {std::pair(0.11, true), std::pair(0.09, false)}) {
        const ContactScene scene{bodies, true, margin, 1e-13};
        EXPECT_EQ(NearTest(scene).are_near({ContactKind::vertex_face, {0, 0}, {0, 0}}), is_near);
    }
}

} // namespace
} // namespace chasles::contact
