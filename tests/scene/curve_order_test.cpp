// The order of points along a curve: every point once, and neighbours near each other.
#include "chasles/scene/curve_order.h"

#include "tests/support/random_poses.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace chasles::scene {
namespace {

using Eigen::Vector3d;
using test::Random;

/// How far it is from point to point.
double way_along(const std::vector<Vector3d>& points, const std::vector<std::uint32_t>& order) {
    double way = 0;
    for (std::size_t i = 1; i < order.size(); ++i)
        way += (points[order[i]] - points[order[i - 1]]).norm();
    return way;
}

void expect_each_once(std::vector<std::uint32_t> order, std::size_t count) {
    std::ranges::sort(order);
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(order, all);
}

TEST(CurveOrder, KeepsNeighboursTogetherHoweverFarAnotherPointIs) {
    Random random(2731);
    for (const double far : {1.0, 1e4, 1e9, 1e30, std::numeric_limits<double>::infinity()}) {
        std::vector<Vector3d> points(5000);
        for (Vector3d& point : points)
            point = test::random_point(random, 1) + Vector3d(3, -2, 1);
        const double by_chance = way_along(points, curve_order(std::span(points).first(30), 1)) / 30 * 5000;
        points.push_back({0, far, 0});
        const std::vector<std::uint32_t> order = curve_order(points, 1);
        expect_each_once(order, points.size());
        EXPECT_EQ(order, curve_order(points, 3));
        std::vector<std::uint32_t> near;
        std::ranges::copy_if(order, std::back_inserter(near), [](std::uint32_t i) { return i < 5000; });
        EXPECT_LT(way_along(points, near), 0.15 * by_chance) << far;
    }
}

TEST(CurveOrder, TakesAnyPoints) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double x : {0.0, 1e308, 5e-324, infinite, -infinite, std::numeric_limits<double>::quiet_NaN()}) {
        std::vector<Vector3d> points(100, Vector3d(x, 0, 0));
        expect_each_once(curve_order(points, 1), 100);
        points[7] = Vector3d(-x, x, 1);
        expect_each_once(curve_order(points, 1), 100);
    }
    EXPECT_TRUE(curve_order({}, 1).empty());
}

} // namespace
} // namespace chasles::scene
