// The scan of blocks against a loop over the vertices in double.
#include "chasles/mesh/vertex_blocks.h"

#include "chasles/mesh/body.h"
#include "chasles/mesh/primitives.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

using Eigen::Vector3d;

TEST(VertexBlocks, ReachAsFarAsTheVertices) {
    std::mt19937 random(2503);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vector3d::NullaryExpr([&] { return normal(random); }); };
    for (int trial = 0; trial < 300; ++trial) {
        test::Body shape = trial % 2 == 0 ? test::random_octahedron(random) : test::box({1, 2, 3});
        const Vector3d place = 1000 * vector(); // of the body in its frame
        for (Vector3d& vertex : shape.vertices)
            vertex += place;
        if (trial % 3 == 0) // not a multiple of eight
            test::add_box(shape, place + Vector3d(5, 0, 0), {0.5, 0.5, 0.5});
        const Polyhedron body = shape.polyhedron();
        const auto blocks = body.body().vertex_blocks();
        const Vector3d direction = vector().normalized();
        double reach = -1e300;
        for (const Vector3d& vertex : body.vertices())
            reach = std::max(reach, direction.dot(vertex - body.body().bvh().centre()));
        const float found = reach_of(blocks, direction.cast<float>());
        EXPECT_NEAR(found, reach, 16 * 0x1p-24 * body.body().bvh().radius());
        const Vector3d at = vertex_at_reach(blocks, direction.cast<float>(), found).cast<double>();
        EXPECT_NEAR(direction.dot(at), reach, 16 * 0x1p-24 * body.body().bvh().radius());
        double nearest = 1e300;
        for (const Vector3d& vertex : body.vertices())
            nearest = std::min(nearest, (vertex - body.body().bvh().centre() - at).norm());
        EXPECT_LT(nearest, 0x1p-23 * body.body().bvh().radius());
    }
}

} // namespace
} // namespace chasles
