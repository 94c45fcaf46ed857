// The distance of the nearest pair over a path, beside the profiles of all pairs one by one.
#include "chasles/base/limit.h"
#include "tests/robot/all_pairs.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>
#include <limits>

namespace chasles::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t step_of(const DistanceProfile& profile, double time) {
    return std::size_t(std::ranges::upper_bound(profile.times, time) - profile.times.begin()) - 1;
}

TEST(RobotProfile, IsTheLeastOfAllPairsInEachSegment) {
    Random random(4504);
    std::size_t apart = 0, without_pairs = 0, several = 0;
    for (int trial = 0; trial < 80; ++trial) {
        SCOPED_TRACE(trial);
        Robot robot(random_robot(random, random.integer(2, 6), random.chance(0.2)));
        robot.set_base(random_pose(random, 2));
        std::mt19937 shapes(unsigned(random.integer(0, 1 << 30)));
        Scene scene; // of bodies that stand still: others move during the whole path
        for (int i = random.integer(0, 12); i > 0; --i)
            scene.add({"body " + std::to_string(i), random_octahedron(shapes).polyhedron(),
                       Motion::at_rest(random_pose(random, 4))});
        std::vector<Configuration> knots{random_configuration(random, robot, 2)};
        for (int i = 0; i < 2; ++i)
            knots.emplace_back(knots.back() + random_configuration(random, robot, 1) * random.uniform(0.02, 0.3));
        const JointPath path = JointPath::straight(robot, knots);
        const ProfileOptions options{.tolerance = 0.03, .absolute_tolerance = 1e-4};
        const RobotProfile found = RobotChecker(robot, &scene).profile(path, options);
        ASSERT_TRUE(found.untested);
        EXPECT_TRUE(found.distance.certain);
        EXPECT_EQ(found.distance.times.front(), 0);
        EXPECT_EQ(found.distance.times.back(), 2);
        several += found.pairs.size() > 1;
        for (std::size_t segment = 0; segment < 2; ++segment) {
            std::vector<DistanceProfile> pairs;
            for_each_pair(robot, scene, {knots[segment], knots[segment + 1]},
                          [&](const Polyhedron& a, const Polyhedron& b, const Motion& motion) {
                              pairs.push_back(profile({a, b, motion, options}));
                          });
            without_pairs += pairs.empty();
            EXPECT_EQ(found.pairs.empty(), pairs.empty());
            for (int i = 0; i < 60; ++i) {
                const double time = (i + 0.5) / 60;
                double lower = infinity, upper = infinity;
                for (const DistanceProfile& pair : pairs) {
                    lower = std::min(lower, pair.lower[step_of(pair, time)]);
                    upper = std::min(upper, pair.upper[step_of(pair, time)]);
                }
                const std::size_t step = step_of(found.distance, double(segment) + time);
                const double below = found.distance.lower[step], above = found.distance.upper[step];
                EXPECT_LE(below, upper);
                EXPECT_GE(above, lower);
                if (below > 0 && !pairs.empty()) {
                    ++apart;
                    EXPECT_LE(above - below, std::max(options.tolerance * above, options.absolute_tolerance) + 1e-12);
                }
            }
        }
    }
    EXPECT_GT(apart, 1500U);
    EXPECT_GT(without_pairs, 0U);
    EXPECT_GT(several, 5U);
}

/// A cube of edge 1 on a slide along the x axis.
Robot sliding_cube() {
    RobotDescription description{"slide"};
    description.links = {{"base"}, {"cube", {{box({0.5, 0.5, 0.5}).polyhedron(), Pose()}}}};
    description.joints = {{"way", JointType::prismatic, "base", "cube"}};
    description.joints[0].axis = Eigen::Vector3d::UnitX();
    return Robot(description);
}

/// The distance is 0 during the whole first segment, so nothing tells how far pairs of the second one are apart.
TEST(RobotProfile, GoesOnAfterASegmentOfOverlap) {
    const Limit limit(20);
    const Robot robot = sliding_cube();
    Scene scene;
    scene.add({"post", box({0.1, 0.1, 5}).polyhedron(), Motion::at_rest(shifted(1, 0.2, 0))});
    const std::vector<Configuration> knots{Configuration::Constant(1, 0.8), Configuration::Constant(1, 1.2),
                                           Configuration::Constant(1, 8)};
    const DistanceProfile found = RobotChecker(robot, &scene).profile(JointPath::straight(robot, knots), {}).distance;
    EXPECT_TRUE(found.certain);
    EXPECT_EQ(found.upper[step_of(found, 0.5)], 0);
    EXPECT_LE(found.lower[step_of(found, 1.5)], 4.6 - 1.6);
    EXPECT_GE(found.upper[step_of(found, 1.5)], 4.6 - 1.6);
}

TEST(RobotProfile, IsFreeBesideAWallThatItDoesNotTouch) {
    const Robot robot = sliding_cube();
    Scene scene;
    scene.add({"wall", box({5, 0.1, 5}).polyhedron(), Motion::at_rest(shifted(0, 0.6 + 1e-7, 0))});
    const std::vector<Configuration> knots{Configuration::Constant(1, 0.8), Configuration::Constant(1, 1.2),
                                           Configuration::Constant(1, 0)};
    const DistanceProfile found = RobotChecker(robot, &scene).profile(JointPath::straight(robot, knots), {}).distance;
    ASSERT_EQ(found.free().size(), 1U);
    EXPECT_EQ(found.free()[0].lower, 0);
    EXPECT_EQ(found.free()[0].upper, 2);
}

/// Past two posts.
TEST(RobotProfile, NamesThePostThatIsNearestInStamps) {
    const Robot robot = sliding_cube();
    Scene scene;
    scene.add({"first", box({0.1, 0.1, 5}).polyhedron(), Motion::at_rest(shifted(2, 1.6, 0))});
    scene.add({"second", box({0.1, 0.1, 5}).polyhedron(), Motion::at_rest(shifted(6, 1.1, 0))});
    const std::vector<Configuration> knots{Configuration::Constant(1, 0), Configuration::Constant(1, 4),
                                           Configuration::Constant(1, 8)};
    const RobotProfile found = RobotChecker(robot, &scene).profile(JointPath::straight(robot, knots), {.margins = {1}});
    ASSERT_EQ(found.pairs.size(), 2U);
    EXPECT_EQ(found.pairs[0].second, "first");
    EXPECT_EQ(found.pairs[1].second, "second");
    const auto distance_to = [](double x, double post, double side) {
        return std::hypot(std::max(0.0, std::abs(x - post) - 0.6), side);
    };
    for (int i = 0; i < 200; ++i) {
        const double stamp = (i + 0.5) / 100, x = 4 * stamp;
        const double distance = std::min(distance_to(x, 2, 1), distance_to(x, 6, 0.5));
        const std::size_t step = step_of(found.distance, stamp);
        EXPECT_LE(found.distance.lower[step], distance + 1e-12);
        EXPECT_GE(found.distance.upper[step], distance - 1e-12);
    }
    // Beside the second post the distance is less than 1 where |x - 6| < 0.6 + sqrt(1 - 0.25).
    const Zones zones = found.distance.zones(1);
    ASSERT_FALSE(zones.inside.empty());
    EXPECT_NEAR(zones.inside.back().lower, (6 - 0.6 - std::sqrt(0.75)) / 4, 1e-5);
    EXPECT_NEAR(zones.inside.back().upper, (6 + 0.6 + std::sqrt(0.75)) / 4, 1e-5);
}

TEST(RobotProfile, EndsAtALimitWithFiniteBounds) {
    Random random(4505);
    const Robot robot(random_robot(random, 6, false));
    const Scene scene = random_world(random, 5);
    const std::vector<Configuration> knots{random_configuration(random, robot, 2),
                                           random_configuration(random, robot, 2),
                                           random_configuration(random, robot, 2)};
    const RobotChecker checker(robot, &scene);
    const JointPath path = JointPath::straight(robot, knots);
    const RobotProfile whole = checker.profile(path);
    const Limit limit(1e-9);
    const RobotProfile found = checker.profile(path);
    EXPECT_FALSE(found.distance.certain);
    ASSERT_FALSE(found.pairs.empty());
    for (int i = 0; i < 100; ++i) {
        const double stamp = (i + 0.5) / 50;
        const std::size_t step = step_of(found.distance, stamp);
        EXPECT_EQ(found.distance.lower[step], 0);
        EXPECT_LT(found.distance.upper[step], 1000);
        EXPECT_GE(found.distance.upper[step], whole.distance.lower[step_of(whole.distance, stamp)]);
    }
}

TEST(RobotProfile, RefusesOptionsByName) {
    Random random(4506);
    const Robot robot(random_robot(random, 2, false));
    const std::vector<Configuration> knots(2, random_configuration(random, robot, 1));
    const RobotChecker checker(robot);
    EXPECT_EQ(refusal([&] { (void)checker.profile(JointPath::straight(robot, knots), {.tolerance = 2}); }),
              "query: tolerance: must be in [1e-4, 1]");
}

} // namespace
} // namespace chasles::test
