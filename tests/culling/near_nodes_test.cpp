// The guess that stops the coarse test: bodies that nearly touch seem near, bodies that are far apart do not.
#include "chasles/culling/near_nodes.h"

#include "chasles/mesh/body.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles::culling {
namespace {

Placement at_distance(double x) {
    return {Eigen::Matrix3d::Identity(), {x, 0, 0}};
}

TEST(NearNodes, TellBodiesThatNearlyTouchFromBodiesThatAreApart) {
    std::mt19937 random(5);
    const Polyhedron body = test::random_octahedron(random).polyhedron();
    const Bvh& bvh = body.body().bvh();
    EXPECT_TRUE(have_near_nodes(bvh, bvh, at_distance(0), 0));
    EXPECT_FALSE(have_near_nodes(bvh, bvh, at_distance(4), 0));
    EXPECT_TRUE(have_near_nodes(bvh, bvh, at_distance(4), 4));
}

} // namespace
} // namespace chasles::culling
