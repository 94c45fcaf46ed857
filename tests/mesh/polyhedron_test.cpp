// The promises of a polyhedron: outlines, ids, ownership, dropped faces and counts.
#include "chasles/mesh/body.h"

#include "tests/mesh/shapes.h"
#include "tests/support/rational.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace chasles {
namespace {

using test::made_from;
using test::Soup;

std::vector<std::uint32_t> ids(std::span<const std::uint32_t> list) {
    return {list.begin(), list.end()};
}

/// The sides of all outlines, from the lower vertex id to the higher one, with the number of occurrences of each.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides_of(const Polyhedron& body) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (std::size_t f = 0; f < body.face_count(); ++f)
        for (std::size_t i = 0; i < body.face(f).size(); ++i)
            ++sides[std::minmax(body.face(f)[i], body.face(f)[(i + 1) % body.face(f).size()])];
    return sides;
}

bool has_side(std::span<const std::uint32_t> outline, Edge edge) {
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (std::minmax(outline[i], outline[(i + 1) % outline.size()]) == std::minmax(edge.from, edge.to))
            return true;
    return false;
}

/// The volume that four points span is zero.
bool are_in_one_plane(const Polyhedron& body, const std::set<std::uint32_t>& corners) {
    const std::vector<std::uint32_t> ids(corners.begin(), corners.end());
    const auto arm = [&](std::size_t i, int axis) {
        return test::Rational(body.vertices()[ids[i]][axis]) - test::Rational(body.vertices()[ids[0]][axis]);
    };
    const auto minor = [&](int i, int j) { return test::Rational(arm(2, i) * arm(3, j) - arm(2, j) * arm(3, i)); };
    return arm(1, 0) * minor(1, 2) + arm(1, 1) * minor(2, 0) + arm(1, 2) * minor(0, 1) == 0;
}

/// Whether an edge that no face owns may be flat: two triangles have it, and lie in one plane.
bool may_be_flat(const Polyhedron& body, const std::pair<std::uint32_t, std::uint32_t>& edge) {
    std::set<std::uint32_t> corners;
    std::size_t faces = 0;
    for (const std::uint32_t face : body.body().faces_around(edge.first))
        if (has_side(body.face(face), {edge.first, edge.second})) {
            corners.insert(body.face(face).begin(), body.face(face).end());
            ++faces;
        }
    return faces == 2 && corners.size() == 4 && are_in_one_plane(body, corners);
}

/// For bodies without bridged holes: each vertex and each side of an outline is owned once, by one of its faces, unless
/// it is flat.
void expect_owned_once(const Polyhedron& body) {
    std::multiset<std::uint32_t> vertices;
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t f = 0; f < body.face_count(); ++f) {
        for (const std::uint32_t vertex : body.body().owned_vertices(f)) {
            EXPECT_TRUE(std::ranges::count(body.face(f), vertex) > 0);
            vertices.insert(vertex);
        }
        for (const Edge edge : body.body().owned_edges(f)) {
            EXPECT_LT(edge.from, edge.to);
            EXPECT_TRUE(has_side(body.face(f), edge));
            edges.emplace(edge.from, edge.to);
        }
    }
    std::set<std::uint32_t> ends;
    for (const auto& [side, count] : sides_of(body))
        if (edges.count(side) == 1)
            ends.insert({side.first, side.second});
        else
            EXPECT_TRUE(edges.count(side) == 0 && may_be_flat(body, side));
    EXPECT_TRUE(std::ranges::equal(vertices, ends)) << "each vertex with an edge that is not flat";
}

TEST(Polyhedron, IsTheCubeItWasMadeFrom) {
    const Soup soup = test::cube();
    const Polyhedron cube = made_from(soup);
    ASSERT_EQ(cube.face_count(), 6U);
    EXPECT_EQ(cube.vertex_count(), 8U);
    for (std::size_t f = 0; f < 6; ++f) {
        EXPECT_EQ(ids(cube.face(f)), soup.faces[f]);
        EXPECT_EQ(cube.source_face(f), f);
        EXPECT_TRUE(cube.face_triangles(f).empty());
        EXPECT_LE(cube.body().owned_vertices(f).size(), 2U);
        EXPECT_EQ(cube.body().owned_edges(f).size(), 2U);
    }
    expect_owned_once(cube);
    const MeshReport report = cube.report();
    EXPECT_EQ(report.vertices, 8U);
    EXPECT_EQ(report.distinct_vertices, 8U);
    EXPECT_EQ(report.triangles, 12U);
    EXPECT_EQ(report.polygons, 6U);
    EXPECT_EQ(report.edges, 12U);
    EXPECT_EQ(report.boundary_edges, 0U);
    EXPECT_EQ(report.nonmanifold_edges, 0U);
    EXPECT_EQ(report.dropped_faces, 0U);
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(cube.body().bvh().nodes().size(), 11U);
}

TEST(Polyhedron, IsTheSameFromFacesThatLieInOneArray) {
    const Soup soup = test::cube();
    std::vector<std::uint32_t> indices;
    for (const auto& face : soup.faces)
        indices.insert(indices.end(), face.begin(), face.end());
    std::vector<std::span<const std::uint32_t>> faces;
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        faces.push_back(std::span<const std::uint32_t>(indices).subspan(4 * f, 4));
    const Polyhedron cube = Polyhedron::from_outlines(soup.vertices, faces);
    ASSERT_EQ(cube.face_count(), 6U);
    for (std::size_t f = 0; f < 6; ++f)
        EXPECT_EQ(ids(cube.face(f)), soup.faces[f]);
}

TEST(Polyhedron, OwnsEachFeatureOfATorusOnceAndEvenly) {
    const Polyhedron torus = made_from(test::torus(37, 23));
    expect_owned_once(torus);
    for (std::size_t f = 0; f < torus.face_count(); ++f) {
        EXPECT_LE(torus.body().owned_vertices(f).size(), 1U);
        EXPECT_LE(torus.body().owned_edges(f).size(), 2U);
    }
    EXPECT_EQ(torus.report().edges, 3U * 37 * 23);
    EXPECT_TRUE(torus.report().closed);
}

TEST(Polyhedron, NamesTheFirstOfEqualVertices) {
    Soup soup = test::cube();
    soup.vertices.emplace_back(-0.0, 0, 0); // equals vertex 0
    soup.faces[0] = {8, 4, 6, 2};
    const Polyhedron cube = made_from(soup);
    EXPECT_EQ(ids(cube.face(0)), (std::vector<std::uint32_t>{0, 4, 6, 2}));
    EXPECT_EQ(cube.vertex_count(), 9U);
    EXPECT_EQ(cube.report().distinct_vertices, 8U);
    EXPECT_TRUE(cube.report().closed);
    expect_owned_once(cube);
}

TEST(Polyhedron, IgnoresVerticesOfNoFace) {
    Soup soup = test::cube();
    soup.vertices.emplace_back(100, 100, 100);
    const Polyhedron cube = made_from(soup);
    expect_owned_once(cube);
    EXPECT_EQ(cube.body().bvh().centre(), Eigen::Vector3d(0.5, 0.5, 0.5));
}

TEST(Polyhedron, DropsFacesThatMergingShrankToAnEdge) {
    Soup soup = test::cube();
    soup.vertices.emplace_back(soup.vertices[1]);
    soup.faces.insert(soup.faces.begin() + 2, {0, 1, 8});
    const Polyhedron cube = made_from(soup);
    EXPECT_EQ(cube.face_count(), 6U);
    EXPECT_EQ(cube.report().dropped_faces, 1U);
    EXPECT_EQ(cube.source_face(1), 1U);
    EXPECT_EQ(cube.source_face(2), 3U);
    expect_owned_once(cube);
}

TEST(Polyhedron, DropsFacesThatMergingShrankToAVertex) {
    Soup soup = test::cube();
    soup.vertices.insert(soup.vertices.end(), 2, soup.vertices[3]);
    soup.faces.push_back({3, 8, 9});
    EXPECT_EQ(made_from(soup).report().dropped_faces, 1U);
}

TEST(Polyhedron, RemovesMergedCornersOfAQuadThatKeepsAnArea) {
    Soup soup = test::cube();
    soup.vertices.emplace_back(soup.vertices[0]);
    soup.faces[2] = {0, 8, 1, 5};
    soup.faces.push_back({8, 5, 4, 0});
    const Polyhedron cube = made_from(soup);
    EXPECT_EQ(ids(cube.face(2)), (std::vector<std::uint32_t>{0, 1, 5}));
    EXPECT_EQ(ids(cube.face(6)), (std::vector<std::uint32_t>{0, 5, 4}));
    EXPECT_EQ(cube.report().dropped_faces, 0U);
    EXPECT_TRUE(cube.report().closed);
}

TEST(Polyhedron, DropsFacesWithoutAreaThatEdgesCover) {
    Soup soup = test::cube();
    soup.vertices.emplace_back(0.25, 0, 0);
    soup.vertices.emplace_back(0.75, 0, 0);
    soup.faces.push_back({0, 8, 1});    // on one edge of its neighbours
    soup.faces.push_back({0, 0, 1});    // has a vertex twice
    soup.faces.push_back({8, 9, 1, 0}); // four corners on one line
    const Polyhedron cube = made_from(soup);
    EXPECT_EQ(cube.report().dropped_faces, 3U);
    EXPECT_EQ(cube.report().segments, 0U);
}

TEST(Polyhedron, DropsFacesThatShorterEdgesCover) {
    Soup soup{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}}, {{0, 1, 3}, {1, 2, 4}, {0, 2, 1}}};
    EXPECT_EQ(made_from(soup).report().dropped_faces, 1U);
}

TEST(Polyhedron, KeepsPolygonsThatAreNotConvexInOnePiece) {
    Soup soup = test::cube();
    const Soup ell = test::sheet({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), ell.vertices.begin(), ell.vertices.end());
    soup.faces.insert(soup.faces.begin() + 1, ell.faces.front());
    for (std::uint32_t& id : soup.faces[1])
        id += first;
    const Polyhedron body = made_from(soup);
    EXPECT_EQ(body.face(1).size(), 6U);
    EXPECT_EQ(body.face_triangles(1).size(), 12U);
    EXPECT_TRUE(body.face_triangles(0).empty());
    EXPECT_TRUE(body.face_triangles(6).empty());
    EXPECT_EQ(body.report().triangles, 16U);
    EXPECT_EQ(body.report().boundary_edges, 6U);
    expect_owned_once(body);
}

TEST(Polyhedron, TakesAHoleBridgedToItsOutline) {
    const Polyhedron plate = made_from(test::sheet(test::square_with_bridged_hole()));
    ASSERT_EQ(plate.face_count(), 1U);
    EXPECT_EQ(plate.face_triangles(0).size(), 24U);
    // The bridge is not an edge. Each corner of the square and of the hole is owned once.
    EXPECT_EQ(plate.body().owned_edges(0).size(), 8U);
    EXPECT_EQ(plate.body().owned_vertices(0).size(), 8U);
    EXPECT_EQ(plate.report().boundary_edges, 8U);
}

TEST(Polyhedron, CutsBentPolygonsWithCreasesAsEdges) {
    Soup soup = test::cube();
    soup.vertices[7].z() = 1.5; // bends the top; the sides stay planar
    const Polyhedron body = made_from(soup, {.triangulate = true});
    EXPECT_EQ(body.face_count(), 7U);
    EXPECT_EQ(body.source_face(5), 5U);
    EXPECT_EQ(body.source_face(6), 5U);
    EXPECT_EQ(body.report().edges, 13U);
    EXPECT_TRUE(body.report().closed);
    expect_owned_once(body);
}

/// As trimesh and manifold3d say of such a mesh: the edges of both halves of a side meet on its long edge.
TEST(Polyhedron, AFaceWithoutAreaClosesAGap) {
    Soup soup = test::cube();
    const std::vector<std::uint32_t> side = soup.faces.back();
    soup.vertices.push_back((soup.vertices[side[0]] + soup.vertices[side[1]]) / 2);
    const auto middle = static_cast<std::uint32_t>(soup.vertices.size() - 1);
    soup.faces.back().insert(soup.faces.back().begin() + 1, middle);
    const Polyhedron open = made_from(soup);
    EXPECT_FALSE(open.report().closed) << "its neighbour has the whole edge";
    soup.faces.push_back({side[0], side[1], middle});
    const Polyhedron closed = made_from(soup);
    EXPECT_TRUE(closed.report().closed);
    EXPECT_EQ(closed.report().dropped_faces, 1U);
    EXPECT_EQ(closed.report().boundary_edges, 3U) << "of the faces that are kept";
}

TEST(Polyhedron, TakesCutsExactlyWhenAsked) {
    Soup soup = test::cube();
    soup.vertices[7].z() = 1 + 1e-9;
    EXPECT_EQ(made_from(soup).face_count(), 6U) << "planar to nine digits";
    EXPECT_EQ(made_from(soup, {.triangulate = true}).face_count(), 7U);
}

TEST(Polyhedron, TakesPolygonsRoundedToSixDigits) {
    const unsigned seed = 20240508;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (int round = 0; round < 500; ++round) {
        // A regular polygon in a random plane. Its distance from the origin is up to a hundred times its size.
        const Eigen::Vector3d right = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
        const Eigen::Vector3d up = right.unitOrthogonal();
        const Eigen::Vector3d centre(normal(random), normal(random), 30 * normal(random));
        Soup soup;
        soup.faces.emplace_back();
        for (std::uint32_t i = 0; i < 7; ++i) {
            Eigen::Vector3d corner = centre + std::cos(0.9 * i) * right + std::sin(0.9 * i) * up;
            for (double& coordinate : corner) {
                std::ostringstream text; // six digits, as many writers leave it
                text << coordinate;
                coordinate = std::stod(text.str());
            }
            soup.vertices.push_back(corner);
            soup.faces.front().push_back(i);
        }
        EXPECT_NO_THROW(made_from(soup)) << "round " << round;
    }
}

TEST(Polyhedron, CopiesShareOneBody) {
    const Polyhedron body = made_from(test::cube());
    const Polyhedron copy = body; // NOLINT(performance-unnecessary-copy-initialization)
    EXPECT_EQ(body.vertices().data(), copy.vertices().data());
}

TEST(Polyhedron, IsTheSameEachTime) {
    const Soup soup = test::torus(20, 10);
    const Polyhedron first = made_from(soup);
    const Polyhedron second = made_from(soup);
    for (std::size_t f = 0; f < first.face_count(); ++f)
        EXPECT_EQ(ids(first.body().owned_vertices(f)), ids(second.body().owned_vertices(f)));
}

TEST(Polyhedron, TakesLessThan200BytesATriangle) {
    const Polyhedron torus = made_from(test::torus(100, 50));
    EXPECT_LT(torus.memory(), 110 * torus.report().triangles);
}

TEST(Polyhedron, AgreesWithTheCountsOfOthersOnRealMeshes) {
    const auto rows = test::obj_files_of_manifest();
    if (rows.empty())
        GTEST_SKIP() << "no external data";
    for (const test::ManifestRow& row : rows) {
        SCOPED_TRACE(row.file);
        // The manifest counts equal vertices separately.
        const Polyhedron body = made_from(test::read_obj(test::shared_data() / row.file));
        const MeshReport report = body.report();
        EXPECT_EQ(report.vertices, row.vertices);
        EXPECT_EQ(report.distinct_vertices, row.distinct_vertices);
        EXPECT_EQ(report.dropped_faces, row.degenerate + row.zero_area);
        EXPECT_EQ(report.faces, row.faces - report.dropped_faces);
        EXPECT_EQ(report.triangles, row.triangles - report.dropped_faces);
        if (row.zero_area == 0) {
            EXPECT_EQ(report.boundary_edges, row.boundary_edges);
            EXPECT_EQ(report.nonmanifold_edges, row.nonmanifold_edges);
        }
        expect_owned_once(body);
        EXPECT_TRUE(report.triangles < 1000 || body.memory() < 110 * report.triangles);
    }
}

} // namespace
} // namespace chasles
