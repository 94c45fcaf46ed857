// Faces without area: the parts of their lines that no edge covers become segments, with edges, vertices and an id.
// The surface stays the same set of points.
#include "chasles/mesh/adjacent_directions.h"
#include "chasles/mesh/body.h"
#include "chasles/mesh/face_normal.h"
#include "chasles/mesh/normal_cones.h"
#include "tests/mesh/shapes.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles {
namespace {

using Ids = std::vector<std::uint32_t>;
using test::made_from;
using test::Soup;

/// A cube with one more face.
Polyhedron cube_with(const std::vector<Eigen::Vector3d>& vertices, const Ids& face) {
    Soup soup = test::cube();
    soup.vertices.insert(soup.vertices.end(), vertices.begin(), vertices.end());
    soup.faces.push_back(face);
    return made_from(soup);
}

/// The outlines of the segments.
std::vector<Ids> segments_of(const Polyhedron& body) {
    std::vector<Ids> segments;
    for (std::size_t face = 0; face < body.face_count(); ++face)
        if (body.body().is_segment(face))
            segments.emplace_back(body.face(face).begin(), body.face(face).end());
    EXPECT_EQ(segments.size(), body.report().segments);
    return segments;
}

TEST(Segments, KeepADiagonal) {
    const Polyhedron body = cube_with({}, {0, 7, 7});
    EXPECT_EQ(segments_of(body), (std::vector<Ids>{{0, 7, 7}}));
    EXPECT_EQ(body.source_face(6), 6U);
    const MeshReport report = body.report();
    EXPECT_EQ(report.faces, 7U);
    EXPECT_EQ(report.edges, 13U);
    EXPECT_EQ(report.dropped_faces, 0U);
    EXPECT_TRUE(report.closed);
    ASSERT_EQ(body.body().owned_edges(6).size(), 1U);
    EXPECT_EQ(body.body().owned_edges(6)[0].to, 7U);
}

TEST(Segments, OfVerticesThatCoincide) {
    EXPECT_EQ(segments_of(cube_with({{0, 0, 0}}, {0, 8, 7})), (std::vector<Ids>{{0, 7, 7}}));
    EXPECT_EQ(segments_of(cube_with({}, {0, 7, 0, 7})), (std::vector<Ids>{{0, 7, 7}}));
    EXPECT_EQ(segments_of(cube_with({}, {0, 1, 5, 5})), (std::vector<Ids>{})) << "a triangle with an area";
}

TEST(Segments, KeepEachVertexOfALine) {
    EXPECT_EQ(segments_of(cube_with({{0.5, 0.5, 0.5}}, {0, 7, 8})), (std::vector<Ids>{{0, 8, 8}, {7, 8, 8}}));
}

TEST(Segments, AreThePartsThatNoEdgeCovers) {
    // Four corners on a line. The neighbours have the edge between two of them.
    const std::vector<Eigen::Vector3d> vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 1, 0}};
    const auto parts_beside = [&](const Ids& neighbour) {
        return segments_of(made_from({vertices, {neighbour, {3, 1, 0, 2}}}));
    };
    EXPECT_EQ(parts_beside({0, 1, 4}), (std::vector<Ids>{{1, 2, 2}, {2, 3, 3}}));
    EXPECT_EQ(parts_beside({2, 1, 4}), (std::vector<Ids>{{0, 1, 1}, {2, 3, 3}}));
    EXPECT_EQ(parts_beside({1, 4, 3}), (std::vector<Ids>{{0, 1, 1}}));
    EXPECT_EQ(parts_beside({0, 4, 3}), (std::vector<Ids>{}));
}

TEST(Segments, OccurOnce) {
    Soup soup = test::cube();
    soup.faces.insert(soup.faces.end(), {{0, 7, 7}, {7, 0, 0}, {0, 7, 0}});
    const Polyhedron body = made_from(soup);
    EXPECT_EQ(segments_of(body).size(), 1U);
    EXPECT_EQ(body.report().dropped_faces, 2U);
}

TEST(Segments, OfOnePoint) {
    const Polyhedron lone = cube_with({{5, 5, 5}, {5, 5, 5}}, {8, 9, 8});
    EXPECT_EQ(segments_of(lone), (std::vector<Ids>{{8, 8, 8}}));
    EXPECT_EQ(lone.body().owned_vertices(6).size(), 1U);
    EXPECT_EQ(lone.report().upper, Eigen::Vector3d(5, 5, 5));
    EXPECT_EQ(segments_of(cube_with({}, {3, 3, 3})), (std::vector<Ids>{})) << "a vertex of other faces";
}

TEST(Segments, MakeVerticesInsideFlatSidesFeatures) {
    // Four triangles around the middle of a square: the middle is flat, until a wire begins there.
    Soup soup{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}, {1, 1, 3}},
              {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    const auto owns_middle = [](const Polyhedron& body) {
        for (std::size_t face = 0; face < body.face_count(); ++face)
            if (std::ranges::count(body.body().owned_vertices(face), 4U) > 0)
                return true;
        return false;
    };
    EXPECT_FALSE(owns_middle(made_from(soup)));
    soup.faces.push_back({4, 5, 4});
    EXPECT_TRUE(owns_middle(made_from(soup)));
}

TEST(Segments, OfPolygonsBehindPolygonsWithTriangles) {
    Soup soup = test::sheet({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
    soup.faces.push_back({1, 4, 4, 1});
    const Polyhedron body = made_from(soup);
    EXPECT_FALSE(body.face_triangles(0).empty());
    EXPECT_TRUE(body.face_triangles(1).empty());
    EXPECT_EQ(segments_of(body), (std::vector<Ids>{{1, 4, 4}}));
}

TEST(Segments, HaveNoPlaneAndNoDirectionsAcross) {
    const Polyhedron body = cube_with({{5, 5, 5}}, {0, 7, 7});
    const FaceNormal normal = face_normal(body.body(), 6);
    EXPECT_EQ(normal.error, 1);
    EXPECT_NEAR(normal.unit.norm(), 1, 1e-12);
    EXPECT_FALSE(any_direction_from_edge(body.body(), {0, 7}, [](const Eigen::Vector3d&) { return true; }));
    EXPECT_FLOAT_EQ(cone_of_edge(body.body(), {0, 7}).angle, float(std::numbers::pi / 2));
    const Polyhedron lone = cube_with({{5, 5, 5}}, {8, 8, 8});
    EXPECT_EQ(face_normal(lone.body(), 6).unit.norm(), 1);
    EXPECT_FALSE(any_direction_from_vertex(lone.body(), 8, [](const Eigen::Vector3d&) { return true; }));
}

TEST(Segments, ThatASegmentNamesMakeTheSameBodyAgain) {
    const Polyhedron first = cube_with({{0.5, 0.5, 0.5}}, {0, 7, 8});
    std::vector<Ids> faces;
    for (std::size_t face = 0; face < first.face_count(); ++face)
        faces.emplace_back(first.face(face).begin(), first.face(face).end());
    const Polyhedron again = Polyhedron::from_polygons(first.vertices(), faces);
    ASSERT_EQ(again.face_count(), first.face_count());
    EXPECT_EQ(segments_of(again), segments_of(first));
}

TEST(Segments, OfALineWithManyCornersTakeNoLongTime) {
    constexpr std::uint32_t count = 200'000;
    Soup soup = test::cube();
    Ids line;
    for (std::uint32_t i = 0; i < count; ++i) {
        soup.vertices.emplace_back(i, 0, 5);
        line.push_back(8 + i);
    }
    soup.faces.push_back(line);
    EXPECT_EQ(made_from(soup).report().segments, count - 1);
}

TEST(ThinPolygons, AreCutWithoutAnOption) {
    // A quad as wide as the rounding of its length has no direction.
    const Polyhedron body = made_from(test::sheet({{0, 0}, {1, 0}, {1, 0x1p-52}, {0, 0x1p-52}}));
    EXPECT_EQ(body.face_count(), 2U);
    EXPECT_EQ(body.source_face(1), 0U);
}

TEST(CutPolygons, ContainWhatTheOutlineWindsAround) {
    // A bow tie: a fan of two triangles contains both lobes.
    const Polyhedron tie = made_from(test::sheet({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), {.triangulate = true});
    EXPECT_EQ(tie.face_count(), 2U);
    // A spike: its end is a segment beside the triangle.
    const Polyhedron spike = made_from(test::sheet({{0, 0}, {1, 0}, {0, 0}, {0, 1}, {-1, 0}}), {.triangulate = true});
    EXPECT_EQ(segments_of(spike), (std::vector<Ids>{{0, 1, 1}}));
}

} // namespace
} // namespace chasles
