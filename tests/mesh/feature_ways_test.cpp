// Directions into the surface, against the corners of a box.
#include "chasles/mesh/feature_ways.h"

#include "chasles/mesh/body.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

TEST(FeatureWays, LeadAlongTheFacesOfABoxWithTheirMeanFirst) {
    const Polyhedron box = test::box({1, 2, 3}).polyhedron();
    const Body& body = box.body();
    const FeatureWays& ways = body.feature_ways();
    std::size_t vertices = 0, edges = 0;
    for (std::uint32_t face = 0; face < body.face_count(); ++face) {
        EXPECT_EQ(ways.first_vertex[face], vertices);
        EXPECT_EQ(ways.first_edge[face], edges);
        for (const std::uint32_t vertex : body.owned_vertices(face)) {
            const auto list = ways.of_vertex[vertices++];
            ASSERT_EQ(list.size(), 4U) << "three edges and their mean";
            const Eigen::Vector3d inward = -body.vertices()[vertex].cwiseSign() / 3;
            EXPECT_LE((list[0] - inward).norm(), 1e-15);
            for (std::size_t i = 1; i < 4; ++i)
                EXPECT_NEAR(list[i].dot(inward), 1.0 / 3, 1e-15);
        }
        for (const Edge& edge : body.owned_edges(face)) {
            const auto list = ways.of_edge[edges++];
            ASSERT_EQ(list.size(), 3U) << "across two faces, and their mean";
            const Eigen::Vector3d along = body.vertices()[edge.to] - body.vertices()[edge.from];
            EXPECT_LE((2 * list[0] - list[1] - list[2]).norm(), 1e-15);
            for (std::size_t i = 1; i < 3; ++i) {
                EXPECT_NEAR(list[i].norm(), 1, 1e-15);
                EXPECT_NEAR(list[i].dot(along), 0, 1e-15);
                EXPECT_LT(list[i].dot(body.vertices()[edge.from]), 0) << "inward";
            }
        }
    }
    EXPECT_EQ(vertices, 8U);
    EXPECT_EQ(edges, 12U);
}

TEST(FeatureWays, OfARimLeadAcrossItsOneFace) {
    const Polyhedron triangle = test::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).polyhedron();
    const FeatureWays& ways = triangle.body().feature_ways();
    EXPECT_EQ(ways.of_edge.size(), 3U);
    for (std::size_t i = 0; i < ways.of_edge.size(); ++i)
        EXPECT_EQ(ways.of_edge[i].size(), 1U);
    for (std::size_t i = 0; i < ways.of_vertex.size(); ++i)
        EXPECT_EQ(ways.of_vertex[i].size(), 3U);
}

} // namespace
} // namespace chasles
