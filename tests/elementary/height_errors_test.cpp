// By how much heights differ from the true ones where points are known better along an axis. Note 36.
#include "chasles/elementary/vertex_face.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::elementary {
namespace {

using algebra::Vector3;
using test::Random;

Vector3<double> random_vector(Random& random, double size) {
    const Eigen::Vector3d point = test::random_point(random, size);
    return {point.x(), point.y(), point.z()};
}

/// A displacement that the bounds allow: at most so long, and so long along the axis.
Vector3<double> displacement(Random& random, const ErrorScale& scale) {
    const Vector3<double> any = random_vector(random, 1);
    const auto axis = algebra::cast<double>(scale.axis);
    const Vector3<double> across = any - algebra::scale(axis, dot(any, axis));
    const double along = random.uniform(-1, 1) * scale.axis_deviation;
    const double rest = std::sqrt(scale.deviation * scale.deviation - along * along);
    return algebra::scale(axis, along) + algebra::scale(across, rest / length(across));
}

TEST(HeightErrors, BoundEveryDisplacement) {
    Random random(3611);
    double greatest = 0;
    for (int trial = 0; trial < 10000; ++trial) {
        ErrorScale scale;
        Vector3<double> axis = random_vector(random, 1);
        axis = algebra::scale(axis, 1 / length(axis));
        scale.axis = algebra::cast<algebra::DoubleDouble>(axis);
        scale.deviation = std::exp(random.uniform(-20, 0));
        scale.axis_deviation = scale.deviation * (random.chance(0.5) ? 0 : random.uniform(0, 1));
        Vector3<double> n = random_vector(random, 3);
        if (random.chance(0.5)) // nearly along the axis
            n = algebra::scale(axis, random.uniform(-3, 3)) + algebra::scale(n, 1e-9);
        const double height = std::abs(dot(n, displacement(random, scale)));
        const double bound = height_deviation<double>(scale, n);
        ASSERT_LE(height, bound) << trial;
        greatest = std::max(greatest, height / bound);
    }
    std::cout << "at most " << greatest << " of the bound\n";
    EXPECT_GT(greatest, 0.9) << "the bound is sharp";
}

/// Along an axis that is no double, a vector of double-doubles has nothing across it.
TEST(HeightErrors, InDoubleDoubleAVectorIsAcrossByItsOwnRoundingOnly) {
    using Wide = algebra::DoubleDouble;
    ErrorScale scale;
    const Vector3<Wide> n{1, 2, 4};
    scale.axis = algebra::scale(n, Wide(1) / length(n));
    scale.deviation = 1;
    EXPECT_LT(double(height_deviation<Wide>(scale, n)), 1e-26);
    EXPECT_GT(height_deviation<double>(scale, {1, 2, 4}), 1e-17);
    const Vector3<Wide> off = n + Vector3<Wide>{0, 2e-20, -1e-20}; // by a vector across it
    EXPECT_GE(double(height_deviation<Wide>(scale, off)), 2.2e-20);
}

TEST(HeightErrors, WithoutADeviationThereIsNone) {
    const ErrorScale scale;
    EXPECT_EQ(height_deviation<double>(scale, {1, 2, 3}), 0);
    EXPECT_EQ(height_error<double>(scale, {1, 2, 3}, 4), position_error<double>(scale) * 4);
}

} // namespace
} // namespace chasles::elementary
