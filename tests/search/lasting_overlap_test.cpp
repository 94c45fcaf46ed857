// Segments that pass through polygons while both move: dense samples with random errors within the slack refute, and
// closed forms say when one leaves.
#include "chasles/search/lasting_overlap.h"

#include "tests/support/random_poses.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using search::ChordPoint;

double volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    return (b - a).dot((c - a).cross(d - a));
}

/// By the signs of volumes, for the triangle a b c.
bool passes(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const double first = volume(p, q, a, b), second = volume(p, q, b, c), third = volume(p, q, c, a);
    const bool is_inside = (first > 0) == (second > 0) && (second > 0) == (third > 0);
    return is_inside && (volume(a, b, c, p) > 0) != (volume(a, b, c, q) > 0);
}

TEST(LastingOverlap, NoSampleRefutesIt) {
    Random random(4601);
    int lasting = 0;
    for (int trial = 0; trial < 20'000; ++trial) {
        const double step = random.uniform(0, 0.6), slack = random.chance(0.5) ? 0 : random.uniform(0, 0.02);
        const auto moving = [&](const Vector3d& at) { return ChordPoint{at, at + random_point(random, step)}; };
        const ChordPoint p = moving(Vector3d(0, 0, -1) + random_point(random, 0.3));
        const ChordPoint q = moving(Vector3d(0, 0, 1) + random_point(random, 0.3));
        const std::array triangle{moving(Vector3d(1, 0, 0) + random_point(random, 0.3)),
                                  moving(Vector3d(-0.5, 0.9, 0) + random_point(random, 0.3)),
                                  moving(Vector3d(-0.5, -0.9, 0) + random_point(random, 0.3))};
        if (!search::passes_all_along(p, q, triangle, slack))
            continue;
        ++lasting;
        for (int i = 0; i <= 40; ++i) {
            const auto at = [&](const ChordPoint& point) -> Vector3d {
                const Vector3d error = random_point(random, 1).normalized() * slack;
                return point.start + i / 40.0 * (point.end - point.start) + error;
            };
            ASSERT_TRUE(passes(at(p), at(q), at(triangle[0]), at(triangle[1]), at(triangle[2]))) << trial;
        }
    }
    EXPECT_GT(lasting, 2000);
}

/// A needle moves across a square of side 2 and leaves it at 1.
TEST(LastingOverlap, EndsAtTheRimAndAtTheEndsOfTheSegment) {
    const auto at_rest = [](double x, double y) { return ChordPoint{Vector3d(x, y, 0), Vector3d(x, y, 0)}; };
    const std::vector<ChordPoint> square{at_rest(-1, -1), at_rest(1, -1), at_rest(1, 1), at_rest(-1, 1)};
    const auto lasts = [&](const Vector3d& way, double slack = 0) {
        const Vector3d below(0, 0, -1), above(0, 0, 1);
        return search::passes_all_along({below, below + way}, {above, above + way}, square, slack);
    };
    EXPECT_TRUE(lasts({0.999, 0, 0}));
    EXPECT_FALSE(lasts({1.001, 0, 0}));
    EXPECT_TRUE(lasts({0, -0.999, 0}));
    EXPECT_FALSE(lasts({0, -1.001, 0}));
    EXPECT_TRUE(lasts({0, 0, 0.999}));
    EXPECT_FALSE(lasts({0, 0, 1.001}));
    EXPECT_TRUE(lasts({0.5, 0.5, 0.5}, 0.05));
    EXPECT_FALSE(lasts({0.99, 0, 0}, 0.05));
}

/// The other way round the outline, and the segment the other way.
TEST(LastingOverlap, NoOrderMatters) {
    const auto at = [](double x, double y, double z) { return ChordPoint{Vector3d(x, y, z), Vector3d(x, y + 0.1, z)}; };
    std::vector<ChordPoint> polygon{at(2, 0, 0), at(1, 2, 0), at(-1, 2, 0), at(-2, 0, 0), at(0, -2, 0)};
    for (int i = 0; i < 2; ++i) {
        EXPECT_TRUE(search::passes_all_along(at(0, 0, 1), at(0, 0, -2), polygon, 0.02));
        EXPECT_TRUE(search::passes_all_along(at(0, 0, -2), at(0, 0, 1), polygon, 0.02));
        EXPECT_FALSE(search::passes_all_along(at(0, 0, 1), at(0, 0, 2), polygon, 0));
        EXPECT_FALSE(search::passes_all_along(at(3, 0, 1), at(3, 0, -2), polygon, 0));
        std::ranges::reverse(polygon);
    }
}

} // namespace
} // namespace chasles::test
