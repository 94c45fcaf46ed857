// How near a robot comes, against every pair by itself.
#include "chasles/base/invalid_input.h"
#include "tests/robot/all_pairs.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// The least distance of all pairs. The time of a contact is that of the first one.
LeastDistance least_of_all_pairs(const Robot& robot, const Scene& scene, const std::array<Configuration, 2>& ends,
                                 const LeastDistanceOptions& options) {
    LeastDistance least;
    least.distance = {INFINITY, INFINITY};
    for_each_pair(robot, scene, ends, [&](const Polyhedron& a, const Polyhedron& b, const Motion& motion) {
        const LeastDistance found = least_distance({a, b, motion, options});
        const bool is_earlier =
            found.distance.upper == 0 && least.distance.upper == 0 && found.time.lower < least.time.lower;
        const double lower = std::min(least.distance.lower, found.distance.lower);
        if (found.distance.upper < least.distance.upper || is_earlier)
            least = found;
        least.distance.lower = lower;
    });
    return least;
}

TEST(RobotClearance, IsTheLeastOfAllPairs) {
    Random random(2601);
    std::size_t touching = 0, apart = 0, without_pairs = 0;
    for (int trial = 0; trial < 250; ++trial) {
        SCOPED_TRACE(trial);
        Robot robot(random_robot(random, random.integer(2, 6), random.chance(0.2)));
        robot.set_base(random_pose(random, 2));
        const Scene scene = random_world(random, random.integer(0, 6));
        const Configuration start = random_configuration(random, robot, 2);
        const Configuration goal = start + random_configuration(random, robot, 1) * random.uniform(0.02, 0.4);
        const LeastDistanceOptions options{.tolerance = random.chance(0.5) ? 1e-6 : 1e-3};
        const LeastDistance expected = least_of_all_pairs(robot, scene, {start, goal}, options);
        const RobotClearance found = RobotChecker(robot, &scene).least_distance(start, goal, options);
        if (std::isinf(expected.distance.upper)) {
            ++without_pairs;
            EXPECT_FALSE(found.pair);
            EXPECT_TRUE(found.certain);
            EXPECT_EQ(found.distance.lower, expected.distance.lower);
            continue;
        }
        ASSERT_TRUE(found.pair);
        EXPECT_TRUE(found.certain);
        EXPECT_LE(found.distance.lower, expected.distance.upper);
        EXPECT_GE(found.distance.upper, expected.distance.lower);
        EXPECT_LE(found.distance.upper - found.distance.lower, options.tolerance * found.distance.upper);
        EXPECT_EQ(found.distance.upper == 0, expected.distance.upper == 0);
        (found.distance.upper == 0 ? touching : apart)++;
        if (found.distance.upper == 0) {
            EXPECT_NEAR(found.time.lower, expected.time.lower, 1e-9);
            continue;
        }
        // At that time the nearest points are as far apart as stated.
        EXPECT_NEAR(found.nearest.contacts.at(0).gap, found.distance.upper, 1e-9);
        EXPECT_LT(
            (found.configuration - JointPath::straight(robot, std::array{start, goal}).at(found.time.lower)).norm(),
            1e-15);
    }
    EXPECT_GT(touching, 20U);
    EXPECT_GT(apart, 60U);
    EXPECT_GT(without_pairs, 0U);
}

/// A cube slides along the x axis past two posts: the nearer one stands beside the last segment.
TEST(RobotClearance, NamesTheSegmentAndTheStamp) {
    RobotDescription description{"slide"};
    description.links = {{"base"}, {"cube", {{box({0.5, 0.5, 0.5}).polyhedron(), Pose()}}}};
    description.joints = {{"way", JointType::prismatic, "base", "cube"}};
    description.joints[0].axis = Eigen::Vector3d::UnitX();
    const Robot robot(description);
    Scene scene;
    scene.add({"far", box({0.1, 0.1, 5}).polyhedron(), Motion::at_rest(shifted(2, 1.6, 0))});
    scene.add({"near", box({0.1, 0.1, 5}).polyhedron(), Motion::at_rest(shifted(6, 1.1, 0))});
    const auto at = [](double way) { return Configuration(Configuration::Constant(1, way)); };
    const JointPath path =
        JointPath::straight(robot, std::array{at(0), at(4), at(5), at(9)}, std::array{10.0, 11.0, 12.0, 20.0});
    const RobotChecker checker(robot, &scene, {.options = {.margin = 3}});
    const RobotClearance found = checker.least_distance(path);
    EXPECT_NEAR(found.distance.upper, 0.5, 1e-10);
    EXPECT_NEAR(found.distance.lower, 0.5, 1e-6);
    EXPECT_EQ(found.segment, 2U);
    EXPECT_EQ(found.pair->first, "cube");
    EXPECT_EQ(found.pair->second, "near");
    EXPECT_GE(found.configuration[0], 5.4 - 1e-9);
    EXPECT_LE(found.configuration[0], 6.6 + 1e-9);
    EXPECT_NEAR(found.time.lower, 12 + 2 * (found.configuration[0] - 5), 1e-9);
    EXPECT_NEAR(found.nearest.contacts.at(0).normal.y(), -1, 1e-12);
    EXPECT_EQ(refusal([&] { (void)checker.least_distance(path, {.tolerance = 2}); }),
              "query: tolerance: must be in [1e-12, 1]");
    EXPECT_EQ(refusal([&] { (void)checker.least_distance(path, {.find = Find::any}); }),
              "query: find: a least distance has no use for `any`");
}

} // namespace
} // namespace chasles::test
