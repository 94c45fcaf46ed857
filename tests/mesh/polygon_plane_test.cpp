// Convexity, reversed turns, and the deviation of corners from their plane.
#include "chasles/mesh/polygon_plane.h"

#include "tests/mesh/shapes.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

using test::Outline;

TEST(Convex, AllowsCornersOnSides) {
    EXPECT_TRUE(is_convex(Outline{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}));
    EXPECT_FALSE(is_convex(Outline{{0, 0}, {1, 1e-17}, {2, 0}, {2, 2}, {0, 2}}));
    EXPECT_FALSE(is_convex(Outline{{0, 0}, {0, 1}, {1, 1}, {1, 0}})) << "turns to the right";
}

TEST(Convex, DemandsOneTurn) {
    const Outline once = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    Outline twice = once;
    twice.insert(twice.end(), once.begin(), once.end());
    EXPECT_TRUE(is_convex(once));
    EXPECT_FALSE(is_convex(twice));
}

TEST(TurningBack, IsFoundAtItsTip) {
    EXPECT_EQ(find_turning_back(Outline{{0, 0}, {2, 0}, {2, 2}, {0, 2}}), 4U);
    EXPECT_EQ(find_turning_back(Outline{{0, 0}, {2, 0}, {3, 0}, {2, 0}, {2, 2}}), 2U);
    EXPECT_EQ(find_turning_back(Outline{{0, 0}, {3, 0}, {2, 0}, {2, 2}}), 1U);
    EXPECT_EQ(find_turning_back(Outline{{0, 0}, {1, 0}, {2, 0}, {2, 2}}), 4U);
}

TEST(PolygonView, TurnsToTheLeftAlongEveryAxis) {
    const test::Soup cube = test::cube();
    for (std::vector<std::uint32_t> face : cube.faces)
        for (int side = 0; side < 2; ++side) {
            EXPECT_EQ(test::signed_area(project_polygon(cube.vertices, face).corners), 1.0);
            std::ranges::reverse(face);
        }
}

TEST(PolygonView, MeasuresTheDeviationFromTheMiddlePlane) {
    std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::vector<std::uint32_t> outline = {0, 1, 2, 3};
    EXPECT_EQ(project_polygon(corners, outline).deviation, 0.0);
    EXPECT_DOUBLE_EQ(project_polygon(corners, outline).size, std::sqrt(2.0));
    corners[2].z() = 0.01;
    // The corners of a warped quad are alternately above and below its plane by a quarter of the warp.
    EXPECT_NEAR(project_polygon(corners, outline).deviation, 0.0025, 1e-6);
    corners[3].x() = -7;
    EXPECT_EQ(project_polygon(corners, outline).magnitude, 7.0);
}

} // namespace
} // namespace chasles
