// Directions from a vertex or an edge into the surface.
#include "chasles/mesh/adjacent_directions.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

std::vector<Eigen::Vector3d> collected(const auto& visit) {
    std::vector<Eigen::Vector3d> ways;
    visit([&](const Eigen::Vector3d& way) {
        ways.push_back(way);
        return false;
    });
    return ways;
}

/// Two triangles that share the edge from 0 to 1. One is in z = 0, the other is vertical.
Polyhedron hinge() {
    const std::vector<Eigen::Vector3d> vertices{{0, 0, 0}, {2, 0, 0}, {0.3, 1, 0}, {0.7, 0, 3}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}, {1, 0, 3}};
    return Polyhedron::from_polygons(vertices, faces);
}

TEST(Surroundings, AnEdgeLeadsAcrossItsFaces) {
    const Polyhedron body = hinge();
    const auto ways = collected([&](auto leads) { any_direction_from_edge(body.body(), {0, 1}, leads); });
    ASSERT_EQ(ways.size(), 2u);
    EXPECT_EQ(ways[0], Eigen::Vector3d(0, 1, 0));
    EXPECT_EQ(ways[1], Eigen::Vector3d(0, 0, 3));
    EXPECT_EQ(collected([&](auto leads) {
                  any_direction_from_edge(body.body(), {0, 2}, leads);
              }).size(),
              1u)
        << "an open rim";
}

TEST(Surroundings, AVertexLeadsAlongTheRimsOfItsFaces) {
    const Polyhedron body = hinge();
    const auto ways = collected([&](auto leads) { any_direction_from_vertex(body.body(), 0, leads); });
    EXPECT_EQ(ways.size(), 4u) << "two for each of two faces";
    EXPECT_EQ(body.body().faces_around(0).size(), 2u);
    EXPECT_EQ(body.body().faces_around(2).size(), 1u);
}

TEST(Surroundings, APolygonThatIsNotConvexLeadsThroughItsTriangles) {
    // An L: at its inner corner every direction into the face is between two sides of some triangle.
    const std::vector<Eigen::Vector3d> vertices{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2, 3, 4, 5}};
    const Polyhedron body = Polyhedron::from_polygons(vertices, faces);
    const Eigen::Vector3d inwards(-1, -1, 0);
    EXPECT_TRUE(
        any_direction_from_vertex(body.body(), 3, [&](const Eigen::Vector3d& way) { return way.dot(inwards) > 0.5; }));
    EXPECT_TRUE(any_direction_from_edge(body.body(), {2, 3}, [](const Eigen::Vector3d& way) { return way.y() < 0; }));
    EXPECT_FALSE(any_direction_from_edge(body.body(), {2, 3}, [](const Eigen::Vector3d& way) { return way.y() > 0; }));
}

} // namespace
} // namespace chasles
