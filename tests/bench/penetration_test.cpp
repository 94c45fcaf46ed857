// Depths and crossings of bodies of which they are known.
#include "bench/penetration.h"

#include "bench/generated_bodies.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace chasles::bench {
namespace {

using Eigen::Vector3d;

/// A box with the corners (+-1, 0), (0, +-1) and z from 0 to 1.
Polyhedron box() {
    return peg({4, 1, 1});
}

Pose at(double x, double y, double z) {
    return {Vector3d(x, y, z), Eigen::Quaterniond::Identity()};
}

TEST(Penetration, IsTheDepthOfTheDeepestVertex) {
    const Polyhedron small = box(), large = peg({4, 5, 1});
    const Surface small_surface(small), large_surface(large);
    const auto depth = [&](const Pose& pose) { return penetration(small, small_surface, large, large_surface, pose); };
    EXPECT_EQ(depth(at(0.01, 0.02, 1.001)), 0);
    EXPECT_NEAR(depth(at(0.01, 0.02, 0.75)), 0.25, 1e-12);
    EXPECT_NEAR(depth(at(0.01, 0.02, 0.5)), 0.5, 1e-12);
    EXPECT_EQ(depth(at(9, 0, 0)), 0);
}

TEST(Penetration, SeesVerticesOfTheFixedBodyToo) {
    const Polyhedron small = box(), large = peg({4, 5, 1});
    const Surface small_surface(small), large_surface(large);
    EXPECT_NEAR(penetration(large, large_surface, small, small_surface, at(0.01, 0.02, 0.75)), 0.25, 1e-12);
}

TEST(Penetration, AHoleIsOutside) {
    const Surface plate(plate_with_hole({64, 3, 2}, 1));
    EXPECT_EQ(plate.depth({0.3, 0.2, 1}), 0);
    EXPECT_NEAR(plate.depth({2, 0.01, 0.5}), 0.5, 1e-12);
}

TEST(Penetration, CountsWhatASegmentCrosses) {
    const Surface surface(box());
    EXPECT_EQ(surface.crossings({0.1, 0.2, 2}, {0.15, 0.1, 0.5}), 1);
    EXPECT_EQ(surface.crossings({0.1, 0.2, 2}, {0.15, 0.1, -1}), 2);
    EXPECT_EQ(surface.crossings({0.1, 0.2, 2}, {0.15, 0.1, 1.01}), 0);
    EXPECT_EQ(surface.crossings({2, 2, 2}, {2, 2, -1}), 0);
}

} // namespace
} // namespace chasles::bench
