// Which edges and vertices lie inside flat parts, told from how the bodies were made.
#include "chasles/mesh/body.h"
#include "chasles/mesh/exact_orientation.h"
#include "tests/query/bodies.h"
#include "tests/support/grid.h"
#include "tests/support/random.h"
#include "tests/support/rational.h"

#include <set>

namespace chasles::test {
namespace {

struct Owned {
    std::set<std::uint32_t> vertices;
    std::size_t edges = 0;
};

Owned owned_of(const Polyhedron& body) {
    Owned owned;
    for (std::size_t f = 0; f < body.face_count(); ++f) {
        owned.vertices.insert(body.body().owned_vertices(f).begin(), body.body().owned_vertices(f).end());
        owned.edges += body.body().owned_edges(f).size();
    }
    return owned;
}

/// A plate of triangles in the plane z = x / 2 + y / 4, which doubles describe exactly.
Body tilted_plate(std::uint32_t n) {
    Body body;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            body.vertices.emplace_back(i, j, 0.5 * i + 0.25 * j);
    body.faces = grid_triangles(n, n);
    return body;
}

TEST(FlatFeatures, OnlyTheRimOfAPlateIsOwned) {
    for (const std::uint32_t n : {1U, 2U, 9U}) {
        const Owned owned = owned_of(tilted_plate(n).polyhedron());
        EXPECT_EQ(owned.vertices.size(), 4 * n);
        EXPECT_EQ(owned.edges, 4 * n);
    }
}

TEST(FlatFeatures, TheLeastBendIsAFeature) {
    Body body = tilted_plate(4);
    const std::uint32_t middle = 2 * 5 + 2;
    body.vertices[middle].z() = std::nextafter(body.vertices[middle].z(), 10);
    const Owned owned = owned_of(body.polyhedron());
    EXPECT_TRUE(owned.vertices.contains(middle));
    EXPECT_EQ(owned.vertices.size(), 16U + 1 + 6) << "the middle, and its neighbours at the ends of bent edges";
    EXPECT_EQ(owned.edges, 16U + 6 + 6) << "the edges at the middle and around it";
}

TEST(FlatFeatures, AFoldedFaceHasARim) {
    // Both faces are in one plane and on one side of their common edge.
    const Body folded{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}};
    const Owned owned = owned_of(folded.polyhedron());
    EXPECT_EQ(owned.vertices.size(), 4U);
    EXPECT_EQ(owned.edges, 5U);
}

TEST(FlatFeatures, AnEdgeOfThreeFacesIsAFeature) {
    const Body fin{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    EXPECT_EQ(owned_of(fin.polyhedron()).edges, 7U);
}

TEST(FlatFeatures, PolygonsOfAFlatSideHaveNoEdgeBetweenThem) {
    const Body two{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 4, 5}, {1, 2, 3, 4}}};
    const Owned owned = owned_of(two.polyhedron());
    EXPECT_EQ(owned.vertices.size(), 6U) << "the ends of the edge are on the rim";
    EXPECT_EQ(owned.edges, 6U);
}

TEST(FlatFeatures, ANodeIsBareIfItsFacesOwnNothing) {
    Body body = tilted_plate(12);
    for (const std::uint32_t bent : {3U * 13 + 4, 8U * 13 + 8}) // two hills in the plain
        body.vertices[bent].z() += 1;
    const Polyhedron plate = body.polyhedron();
    const auto nodes = plate.body().bvh().nodes();
    int bare_leaves = 0, bare_nodes = 0, only_vertices = 0;
    std::vector<bool> is_bare(nodes.size());
    for (std::size_t i = nodes.size(); i-- > 0;) {
        const BvhNode& node = nodes[i];
        const bool has_vertices = node.is_leaf() && !plate.body().owned_vertices(node.first).empty();
        const bool has_edges = node.is_leaf() && !plate.body().owned_edges(node.first).empty();
        is_bare[i] = node.is_leaf() ? !has_vertices && !has_edges : is_bare[node.first] && is_bare[node.first + 1];
        EXPECT_EQ(node.is_bare(), is_bare[i]) << "node " << i;
        only_vertices += has_vertices && !has_edges ? 1 : 0;
        (node.is_leaf() ? bare_leaves : bare_nodes) += is_bare[i] ? 1 : 0;
    }
    EXPECT_GT(bare_leaves, 100);
    EXPECT_GT(bare_nodes, 20);
    EXPECT_GT(only_vertices, 0) << "faces that own a vertex and no edge are not bare";
}

TEST(FlatFeatures, CoplanarIsDecidedExactly) {
    Random random(231);
    int in_plane = 0, barely_off = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto point = [&] {
            const auto v = random.vector(1);
            return Eigen::Vector3d(v.x, v.y, v.z);
        };
        const double size = std::abs(random.scaled(-12, 12));
        const Eigen::Vector3d a = size * point(), u = size * point(), v = size * point();
        Eigen::Vector3d d = a + std::ldexp(1.0, -random.integer(0, 3)) * u + double(random.integer(-2, 2)) * v;
        const Eigen::Vector3d b = a + u, c = a + v; // rounded: the four are in one plane now and then
        if (random.chance(0.3))
            d[random.integer(0, 2)] = std::nextafter(d[0], 1e30);
        const auto row = [&](const Eigen::Vector3d& p) {
            return std::array<Rational, 3>{Rational(p.x()) - Rational(a.x()), Rational(p.y()) - Rational(a.y()),
                                           Rational(p.z()) - Rational(a.z())};
        };
        const auto [bx, by, bz] = row(b);
        const auto [cx, cy, cz] = row(c);
        const auto [dx, dy, dz] = row(d);
        const Rational volume = bx * (cy * dz - cz * dy) + by * (cz * dx - cx * dz) + bz * (cx * dy - cy * dx);
        EXPECT_EQ(are_coplanar(a, b, c, d), volume == 0);
        in_plane += volume == 0 ? 1 : 0;
        barely_off += volume != 0 && abs(volume) < Rational(1e-14 * size * size * size) ? 1 : 0;
    }
    EXPECT_GT(in_plane, 40);
    EXPECT_GT(barely_off, 400);
}

} // namespace
} // namespace chasles::test
