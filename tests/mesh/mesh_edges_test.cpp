// Every edge is listed once, in order, with the right number of faces.
#include "chasles/mesh/mesh_edges.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace chasles {
namespace {

FlatLists<std::uint32_t> outlines_of(const std::vector<std::vector<std::uint32_t>>& faces) {
    FlatLists<std::uint32_t> outlines;
    for (const auto& face : faces)
        outlines.append(face);
    return outlines;
}

bool contains(const MeshEdges& edges, std::uint32_t a, std::uint32_t b) {
    return std::ranges::any_of(edges.edges_from(std::min(a, b)), [&](Edge edge) { return edge.to == std::max(a, b); });
}

TEST(MeshEdges, OfTwoTrianglesShareOne) {
    const MeshEdges edges = collect_edges(outlines_of({{0, 1, 2}, {2, 1, 3}}), 4);
    ASSERT_EQ(edges.edges.size(), 5U);
    EXPECT_TRUE(std::ranges::is_sorted(edges.edges, {}, [](Edge e) { return std::pair(e.from, e.to); }));
    EXPECT_EQ(edges.boundary, 4U);
    EXPECT_EQ(edges.nonmanifold, 0U);
    EXPECT_TRUE(contains(edges, 2, 1));
    EXPECT_FALSE(contains(edges, 0, 3));
    EXPECT_EQ(edges.edge_of_side[1], edges.edge_of_side[3]);
}

TEST(MeshEdges, CountThreeFacesAsNonmanifold) {
    const MeshEdges edges = collect_edges(outlines_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), 5);
    EXPECT_EQ(edges.nonmanifold, 1U);
    EXPECT_EQ(edges.boundary, 6U);
}

TEST(MeshEdges, LeaveOutTheBridgeOfAHole) {
    // Outline 0 1 2, bridge 2 - 3, hole 3 4 5, and back over the bridge.
    const std::vector<std::uint32_t> keyhole = {0, 1, 2, 3, 4, 5, 3, 2};
    const MeshEdges edges = collect_edges(outlines_of({keyhole}), 6);
    EXPECT_EQ(edges.edges.size(), 6U);
    EXPECT_FALSE(contains(edges, 2, 3));
    EXPECT_EQ(edges.edge_of_side[2], MeshEdges::none);
    EXPECT_EQ(edges.edge_of_side[6], MeshEdges::none);
    EXPECT_EQ(edges.boundary, 6U);
}

TEST(MeshEdges, KeepABridgeThatAnotherFaceStandsOn) {
    const std::vector<std::uint32_t> keyhole = {0, 1, 2, 3, 4, 5, 3, 2};
    const MeshEdges edges = collect_edges(outlines_of({keyhole, {2, 3, 6}}), 7);
    EXPECT_TRUE(contains(edges, 2, 3));
    EXPECT_NE(edges.edge_of_side[2], MeshEdges::none);
}

TEST(MeshEdges, GrowByTheEdgesOfSegments) {
    MeshEdges edges = collect_edges(outlines_of({{0, 1, 2}}), 5);
    edges.append_segments(outlines_of({{2, 3, 3}, {4, 4, 4}}));
    ASSERT_EQ(edges.edges.size(), 5U);
    EXPECT_EQ(edges.edges[3].to, 3U);
    EXPECT_EQ(edges.edges[4].from, 4U);
    EXPECT_EQ(edges.two_faces.size(), 5U);
    const std::vector<std::uint32_t> sides(edges.edge_of_side.begin() + 3, edges.edge_of_side.end());
    EXPECT_EQ(sides,
              (std::vector<std::uint32_t>{3, MeshEdges::none, MeshEdges::none, 4, MeshEdges::none, MeshEdges::none}));
    EXPECT_EQ(edges.boundary, 3U);
}

} // namespace
} // namespace chasles
