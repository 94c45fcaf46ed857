// Triangles cover the faces, lines are the visible edges, and vertices are in single precision relative to the body.
#include "view/drawn_mesh.h"

#include "chasles/mesh/primitives.h"
#include "tests/mesh/shapes.h"
#include "view/round_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace chasles {
namespace {

view::DrawnMesh drawn(const test::Soup& soup) {
    return view::drawn_mesh(Polyhedron::from_polygons(soup.vertices, soup.faces));
}

Eigen::Vector3d corner(const view::DrawnMesh& mesh, std::uint32_t vertex) {
    const auto& [x, y, z] = mesh.vertices[vertex];
    return Eigen::Vector3d(x, y, z) + mesh.origin;
}

Eigen::Vector3d area(const view::DrawnMesh& mesh) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [a, b, c] : mesh.triangles)
        sum += (corner(mesh, b) - corner(mesh, a)).cross(corner(mesh, c) - corner(mesh, a)) / 2;
    return sum;
}

// Two triangles that share the edge 0-1. The second triangle is turned about this edge from the plane of the first.
test::Soup hinge(double turn, bool is_second_backwards) {
    test::Soup soup;
    soup.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -std::cos(turn), std::sin(turn)}};
    soup.faces = {{0, 1, 2}, {1, 0, 3}};
    if (is_second_backwards)
        soup.faces[1] = {0, 1, 3};
    return soup;
}

TEST(DrawnMesh, OfACubeHasItsEdgesButNoDiagonals) {
    const view::DrawnMesh mesh = drawn(test::cube());
    EXPECT_EQ(mesh.triangles.size(), 12U);
    EXPECT_EQ(mesh.creases.size(), 12U);
    for (const auto& [from, to] : mesh.creases)
        EXPECT_EQ((corner(mesh, from) - corner(mesh, to)).norm(), 1) << from << "-" << to;
}

TEST(DrawnMesh, CoversFacesThatAreNotConvex) {
    const test::Outline outline = test::square_with_bridged_hole();
    const view::DrawnMesh mesh = drawn(test::sheet(outline));
    EXPECT_NEAR(area(mesh).z(), test::signed_area(outline), 1e-6);
    EXPECT_EQ(mesh.creases.size(), 8U) << "a bridge to a hole is not drawn";
}

TEST(DrawnMesh, HidesEdgesWhereTheSurfaceIsSmooth) {
    EXPECT_EQ(drawn(test::torus(60, 40)).creases.size(), 0U);
    EXPECT_EQ(drawn(test::torus(60, 8)).creases.size(), 8U * 60) << "eight facets around are corners";
}

TEST(DrawnMesh, ShowsBendsWhicheverWayFacesAreWound) {
    for (const bool is_backwards : {false, true}) {
        EXPECT_EQ(drawn(hinge(0.5 * view::least_crease, is_backwards)).creases.size(), 4U) << "the rim alone";
        EXPECT_EQ(drawn(hinge(1.5 * view::least_crease, is_backwards)).creases.size(), 5U);
        EXPECT_EQ(drawn(hinge(3.1, is_backwards)).creases.size(), 5U) << "the edge of a blade";
    }
}

TEST(DrawnMesh, KeepsTheShapeOfABodyFarFromItsOrigin) {
    test::Soup soup = test::cube();
    for (Eigen::Vector3d& vertex : soup.vertices)
        vertex = vertex * 1e-3 + Eigen::Vector3d(1e6, -1e6, 1e6);
    const view::DrawnMesh mesh = drawn(soup);
    for (std::size_t i = 0; i < soup.vertices.size(); ++i)
        EXPECT_LE((corner(mesh, static_cast<std::uint32_t>(i)) - soup.vertices[i]).norm(), 1e-9);
}

/// A sixth of the sum of the volumes over all triangles: positive if they turn outwards.
double volume(const view::DrawnMesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += corner(mesh, a).dot(corner(mesh, b).cross(corner(mesh, c))) / 6;
    return sum;
}

TEST(DrawnMesh, ShowsRoundBodiesRound) {
    const view::DrawnMesh ball = view::drawn_mesh(make_sphere(2));
    for (const auto& triangle : ball.triangles)
        for (const std::uint32_t vertex : triangle)
            EXPECT_NEAR(corner(ball, vertex).norm(), 2, 1e-6);
    const double of_ball = 4.0 / 3 * std::numbers::pi * 8;
    EXPECT_NEAR(volume(ball), of_ball, 0.05 * of_ball);
    const view::DrawnMesh capsule = view::drawn_mesh(make_capsule(2, 3)); // both ends are whole balls
    for (const auto& triangle : capsule.triangles)
        for (const std::uint32_t vertex : triangle) {
            const Eigen::Vector3d place = corner(capsule, vertex);
            EXPECT_LE((place - Eigen::Vector3d(0, 0, std::clamp(place.z(), -1.5, 1.5))).norm(), 2 + 1e-6);
        }
    EXPECT_GT(volume(capsule), 2 * 0.95 * of_ball);
    Eigen::AlignedBox3d box;
    const view::DrawnMesh round = view::drawn_mesh(make_box({1, 2, 3}).with_radius(0.5));
    for (std::size_t i = 0; i < round.vertices.size(); ++i)
        box.extend(corner(round, std::uint32_t(i)));
    EXPECT_TRUE(box.sizes().isApprox(Eigen::Vector3d(2, 3, 4), 1e-2)) << box.sizes().transpose();
    std::vector<Eigen::Vector3d> cloud(30'000, Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < cloud.size(); ++i)
        cloud[i].x() = double(i);
    EXPECT_LT(view::drawn_mesh(make_points(cloud, 0.5)).triangles.size(), 1'000'000U);
}

/// A page holds every body, and a body of some hundred faces must not take megabytes.
TEST(DrawnMesh, RoundBodiesAreCoarserTheMoreTheyHave) {
    for (const std::uint32_t around : {3U, 12U, 24U, 48U}) {
        const Polyhedron body = test::made_from(test::torus(around, 16), {.radius = 0.02});
        const std::size_t triangles = view::drawn_mesh(body).triangles.size();
        EXPECT_GT(triangles, 20 * body.face_count()) << "round to the eye";
        EXPECT_LT(triangles, 40'000 + 2 * body.face_count());
    }
}

/// Every second or third point of a grid would be stripes, with gaps between them that are wider than the points.
TEST(DrawnMesh, ShowsAPartOfALargeCloudWithoutAPattern) {
    constexpr int side = 300; // 90,000 points; 20,000 are drawn
    std::vector<Eigen::Vector3d> grid;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            grid.emplace_back(row, column, 0);
    const Polyhedron cloud = make_points(grid, 0.25);
    const view::DrawnMesh mesh = view::drawn_mesh(cloud);
    std::set<std::pair<int, int>> drawn;
    for (const auto& triangle : mesh.triangles) {
        const Eigen::Vector3d place = corner(mesh, triangle[0]);
        drawn.emplace(int(std::lround(place.x())), int(std::lround(place.y())));
    }
    EXPECT_EQ(drawn.size(), 20'000U);
    EXPECT_EQ(view::drawn_in_part(cloud), "20000 of 90000 points");
    EXPECT_EQ(view::drawn_in_part(make_sphere(1)), "");
    EXPECT_EQ(view::drawn_in_part(make_box({1, 1, 1})), "");
    for (int line = 0; line < side; ++line)
        for (const auto& [row, column, down, across] :
             {std::array{line, 0, 0, 1}, std::array{0, line, 1, 0}, std::array{0, line, 1, 1}}) {
            int count = 0;
            for (int i = 0; i < side; ++i)
                count += drawn.contains({(row + i * down) % side, (column + i * across) % side}) ? 1 : 0;
            EXPECT_NEAR(count, 20'000 / side, 36) << "five standard deviations";
        }
    for (int modulus = 2; modulus <= 9; ++modulus)
        for (int rest = 0; rest < modulus; ++rest) {
            const auto count = std::ranges::count_if(
                drawn, [&](const auto& at) { return (at.first * side + at.second) % modulus == rest; });
            EXPECT_NEAR(double(count), 20'000.0 / modulus, 350) << modulus;
        }
}

} // namespace
} // namespace chasles
