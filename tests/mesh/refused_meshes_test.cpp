// All reasons to refuse a mesh, with their exact messages, because users read these lines.
#include "chasles/mesh/polyhedron.h"

#include "tests/mesh/shapes.h"
#include "tests/support/refusal.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace chasles {
namespace {

using test::Soup;

std::string refusal(const Soup& soup, const PolyhedronOptions& options = {}) {
    return test::refusal([&] { (void)Polyhedron::from_polygons(soup.vertices, soup.faces, options); });
}

/// The option that the message names accepts the mesh.
void expect_refused_unless_cut(const Soup& soup, const std::string& why) {
    EXPECT_EQ(refusal(soup), why + "; the option triangulate accepts it");
    EXPECT_EQ(refusal(soup, {.triangulate = true}), "accepted");
}

TEST(RefusedMeshes, WithoutFaces) {
    EXPECT_EQ(refusal({}), "mesh: has no faces");
}

TEST(RefusedMeshes, IndexOutOfRange) {
    Soup soup = test::cube();
    soup.faces[3][2] = 8;
    EXPECT_EQ(refusal(soup), "face 3: vertex index 8 is out of range (the mesh has 8 vertices)");
    EXPECT_EQ(refusal({{}, {{0, 1, 2}}}), "face 0: vertex index 0 is out of range (the mesh has 0 vertices)");
}

TEST(RefusedMeshes, CoordinatesThatAreNoNumbers) {
    Soup soup = test::cube();
    soup.vertices[5].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal(soup), "vertex 5: y is not a finite number");
    soup.vertices[5].y() = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(refusal(soup), "vertex 5: y is not a finite number");
}

TEST(RefusedMeshes, CoordinatesBeyondArithmetic) {
    Soup soup = test::cube();
    soup.vertices[1].z() = -2e30;
    EXPECT_EQ(refusal(soup), "vertex 1: z = -2e+30 is out of range (-1e+30 to 1e+30)");
    soup = test::cube();
    for (Eigen::Vector3d& vertex : soup.vertices)
        vertex *= 1e-31;
    EXPECT_EQ(refusal(soup), "mesh: all vertices lie within 1e-31 of each other, which is too small to compute with "
                             "(at least 1e-30)");
    for (Eigen::Vector3d& vertex : soup.vertices)
        vertex = {1, 2, 3};
    EXPECT_EQ(refusal(soup), "mesh: all vertices lie within 0 of each other, which is too small to compute with "
                             "(at least 1e-30); a point needs a radius above 0");
}

TEST(RefusedMeshes, TooFewVerticesInAFace) {
    Soup soup = test::cube();
    soup.faces[2] = {0, 1};
    EXPECT_EQ(refusal(soup), "face 2: a face needs at least three vertices and this one has 2");
}

TEST(RefusedMeshes, NothingButCollapsedFaces) {
    const Soup soup{{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}};
    EXPECT_EQ(refusal(soup),
              "mesh: no face has an area, so the mesh has no surface; points and segments need a radius above 0");
}

TEST(RefusedMeshes, PolygonsThatAreNotPlanar) {
    Soup soup = test::cube();
    soup.vertices[7].z() = 1.01;
    expect_refused_unless_cut(soup,
                              "face 5: is not planar (its vertices leave a plane by 0.0025, and 1.41e-05 is allowed)");
}

TEST(RefusedMeshes, OutlinesThatCrossThemselves) {
    expect_refused_unless_cut(test::sheet({{0, 0}, {3, 0}, {3, 3}, {1, -1}}), "face 0: its outline crosses itself");
    // Lobes of equal area and opposite orientation have no normal.
    expect_refused_unless_cut(test::sheet({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),
                              "face 0: has no area beyond rounding (its outline crosses itself or turns back)");
}

/// A star that would take minutes to cut, and an outline that goes round and round; a convex polygon is read.
TEST(RefusedMeshes, PolygonsWithTooManyCorners) {
    const auto ring = [](int count, double inner) {
        std::vector<Eigen::Vector2d> corners;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * i / count;
            corners.emplace_back((i % 2 == 0 ? 1 : inner) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
        }
        return corners;
    };
    const std::string why =
        " corners and is not convex; of such faces at most 20000 are read: cut it into smaller ones";
    Soup round{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{}}};
    for (std::uint32_t i = 0; i < 60'000; ++i)
        round.faces[0].push_back(i % 3);
    for (const bool triangulate : {false, true}) {
        EXPECT_EQ(refusal(test::sheet(ring(200'000, 0.5)), {.triangulate = triangulate}), "face 0: has 200000" + why);
        EXPECT_EQ(refusal(round, {.triangulate = triangulate}), "face 0: has 60000" + why);
    }
    EXPECT_EQ(Polyhedron::from_polygons(test::sheet(ring(2'000, 0.5)).vertices, test::sheet(ring(2'000, 0.5)).faces)
                  .face_count(),
              1U);
}

TEST(RefusedMeshes, OutlinesThatTurnBack) {
    expect_refused_unless_cut(test::sheet({{0, 0}, {3, 0}, {2, 0}, {2, 2}}),
                              "face 0: its outline turns back onto itself at vertex 1");
    // Opposite corners of a quad that coincide leave two segments.
    expect_refused_unless_cut(test::sheet({{0, 0}, {1, 0}, {0, 0}, {0, 1}}),
                              "face 0: has no area beyond rounding (its outline crosses itself or turns back)");
}

TEST(RefusedMeshes, BentPolygonsThatTouchThemselves) {
    Soup soup = test::sheet({{0, 0}, {2, 1}, {4, 0}, {4, 2}, {2, 1}, {0, 2}});
    soup.vertices[0].z() = 0.5;
    expect_refused_unless_cut(soup,
                              "face 0: is not planar (its vertices leave a plane by 0.124, and 4.5e-05 is allowed)");
}

} // namespace
} // namespace chasles
