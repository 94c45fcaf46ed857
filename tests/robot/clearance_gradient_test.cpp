// Gradients of the clearance of robots by the knots of their paths: against differences of proven brackets.
#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "chasles/mesh/primitives.h"
#include "chasles/robot/knot_weights.h"
#include "chasles/robot/model.h"
#include "tests/robot/all_pairs.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test::of_gradients { // names of its own in a batch of sources
namespace {

using Knots = JointPath::Knots;

/// A path of some kind through knots, with fixed times and rates.
struct PathThrough {
    Knots kind = Knots::straight;
    std::vector<double> times = {};
    std::vector<Configuration> velocities = {}, accelerations = {};

    [[nodiscard]] JointPath path(const Robot& robot, const Eigen::MatrixXd& knots) const {
        std::vector<Configuration> positions;
        for (Eigen::Index k = 0; k < knots.rows(); ++k)
            positions.emplace_back(knots.row(k).transpose());
        switch (kind) {
        case Knots::cubic:
            return JointPath::cubic(robot, times, positions, velocities);
        case Knots::quintic:
            return JointPath::quintic(robot, times, positions, velocities, accelerations);
        case Knots::natural_spline:
            return JointPath::natural_spline(robot, times, positions);
        default:
            return JointPath::straight(robot, positions, times);
        }
    }
};

PathThrough random_path(Random& random, const Robot& robot, Eigen::Index knots, bool has_quaternion) {
    PathThrough through;
    const int last = has_quaternion ? 0 : 3;
    through.kind = std::array{Knots::straight, Knots::cubic, Knots::quintic,
                              Knots::natural_spline}[std::size_t(random.integer(0, last))];
    through.times = {random.uniform(-1, 1)};
    for (Eigen::Index k = 0; k < knots; ++k) {
        if (k > 0)
            through.times.push_back(through.times.back() + random.uniform(0.5, 2));
        through.velocities.push_back(random_configuration(random, robot, 0.3));
        through.accelerations.push_back(random_configuration(random, robot, 0.3));
    }
    return through;
}

/// Knots that are not far from each other.
Eigen::MatrixXd random_knots(Random& random, const Robot& robot, Eigen::Index count) {
    Eigen::MatrixXd knots(count, Eigen::Index(robot.variables().size()));
    knots.row(0) = random_configuration(random, robot, 2).transpose();
    for (Eigen::Index k = 1; k < count; ++k)
        knots.row(k) =
            knots.row(k - 1) + random.uniform(0.05, 0.4) * random_configuration(random, robot, 1).transpose();
    return knots;
}

/// Along a direction of all knots, from brackets that are proven to a part of 1e-9.
double difference(const RobotChecker& checker, const PathThrough& through, const Eigen::MatrixXd& knots,
                  const Eigen::MatrixXd& direction, double step) {
    const auto distance = [&](double signed_step) {
        const JointPath path = through.path(checker.robot(), knots + signed_step * direction);
        const RobotClearance found = checker.least_distance(path, {.tolerance = 1e-9});
        EXPECT_LE(found.distance.upper - found.distance.lower, 1e-9 * found.distance.upper + 1e-10);
        return found.distance.upper;
    };
    return (distance(step) - distance(-step)) / (2 * step);
}

TEST(RobotGradient, AgreesWithDifferencesOfBrackets) {
    Random random(4103);
    int asked = 0, isolated = 0, large = 0, with_quaternion = 0, at_inner_knots = 0;
    std::set<Knots> kinds;
    double worst = 0;
    while (asked < 250) {
        SCOPED_TRACE(asked);
        Robot robot(random_robot(random, random.integer(2, 6), random.chance(0.4)));
        robot.set_base(random_pose(random, 2));
        const Scene scene = random_world(random, random.integer(0, 6));
        const auto count = Eigen::Index(random.integer(2, 4));
        const Eigen::MatrixXd knots = random_knots(random, robot, count);
        const bool has_quaternion = !robot.model().quaternions.empty();
        const PathThrough through = random_path(random, robot, count, has_quaternion);
        const RobotChecker checker(robot, &scene);
        const JointPath path = through.path(robot, knots);
        const RobotClearance clearance = checker.least_distance(path);
        if (!clearance.pair || clearance.distance.upper < 0.01)
            continue;
        ++asked;
        const RobotGradient found = checker.least_distance_gradient(path, clearance);
        ASSERT_EQ(found.by_knots.rows(), knots.rows());
        ASSERT_EQ(found.by_knots.cols(), knots.cols());
        EXPECT_TRUE(found.by_knots.allFinite());
        if (!found.isolated)
            continue;
        ++isolated;
        kinds.insert(through.kind);
        with_quaternion += has_quaternion;
        const Bracket& time = clearance.nearest.time;
        at_inner_knots += (time.lower == 0 && clearance.segment > 0) ||
                          (time.upper == 1 && clearance.segment + 2 < std::size_t(count));
        const double size = found.by_knots.norm();
        if (size < 1e-3)
            continue;
        ++large;
        std::vector<Eigen::MatrixXd> directions{found.by_knots / size};
        for (int i = 0; i < 3; ++i)
            directions.emplace_back(random_knots(random, robot, count).normalized());
        for (const Eigen::MatrixXd& direction : directions) {
            const double expected = found.by_knots.cwiseProduct(direction).sum();
            double error = std::abs(difference(checker, through, knots, direction, 0x1p-15) - expected);
            if (error > 1e-6 * size)
                error = std::min(error, std::abs(difference(checker, through, knots, direction, 0x1p-19) - expected));
            worst = std::max(worst, error / size);
            EXPECT_LE(error, 1e-5 * size);
        }
    }
    std::cout << isolated << " of " << asked << " isolated, " << large << " not near 0, " << with_quaternion
              << " with a floating joint, " << at_inner_knots << " at inner knots, worst relative error " << worst
              << "\n";
    EXPECT_GT(isolated, 0.85 * asked);
    EXPECT_GT(large, 0.5 * asked);
    EXPECT_GT(with_quaternion, 10);
    EXPECT_GT(at_inner_knots, 0);
    EXPECT_EQ(kinds.size(), 4U);
}

/// A ball on an arm of length 2 that turns in the plane above a floor.
Robot ball_on_an_arm() {
    RobotDescription robot{"arm"};
    robot.links = {{"base"}, {"ball", {{make_sphere(0.25), shifted(2, 0, 0)}}}};
    robot.joints = {{"turn", JointType::revolute, "base", "ball"}};
    robot.joints[0].axis = -Eigen::Vector3d::UnitY(); // upwards for positive angles
    return Robot(robot);
}

Eigen::MatrixXd column(std::initializer_list<double> values) {
    Eigen::MatrixXd result(Eigen::Index(values.size()), 1);
    std::ranges::copy(values, result.data());
    return result;
}

/// The height is 2 sin q, which is least at the end of the path; at an inner knot both segments meet.
TEST(RobotGradient, OfABallOnAnArm) {
    Scene scene;
    scene.add({"floor", box({9, 9, 1}).polyhedron(), Motion::at_rest(shifted(0, 0, -3))});
    const RobotChecker checker(ball_on_an_arm(), &scene);
    const auto gradient = [&](const Eigen::MatrixXd& knots) {
        PathThrough through;
        for (Eigen::Index k = 0; k < knots.rows(); ++k)
            through.times.push_back(double(k));
        const JointPath path = through.path(checker.robot(), knots);
        return checker.least_distance_gradient(path, checker.least_distance(path));
    };
    const RobotGradient edge = gradient(column({0.9, 0.3}));
    EXPECT_TRUE(edge.isolated);
    EXPECT_NEAR(edge.by_knots(0, 0), 0, 1e-12);
    EXPECT_NEAR(edge.by_knots(1, 0), 2 * std::cos(0.3), 1e-9);
    const RobotGradient inner = gradient(column({0.9, 0.3, 0.8}));
    EXPECT_TRUE(inner.isolated);
    EXPECT_NEAR((inner.by_knots - column({0, 2 * std::cos(0.3), 0})).norm(), 0, 1e-9);
    EXPECT_FALSE(gradient(column({0.3, 0.9, 0.3})).isolated) << "two ends are as near";
    EXPECT_FALSE(gradient(column({0.3, 0.3})).isolated) << "it is as near all the time";
    const RobotGradient touching = gradient(column({0.3, -1.5}));
    EXPECT_EQ(touching.by_knots.size(), 0);
    EXPECT_FALSE(touching.isolated);
}

/// Two balls on one slide are as near to two walls.
TEST(RobotGradient, OfTwoPairsIsNotIsolated) {
    RobotDescription robot{"slide"};
    robot.links = {{"base"}, {"ball", {{make_sphere(0.25), Pose()}}}};
    robot.joints = {{"way", JointType::prismatic, "base", "ball"}};
    robot.joints[0].axis = Eigen::Vector3d::UnitX();
    Scene scene;
    scene.add({"left", box({0.1, 9, 9}).polyhedron(), Motion::at_rest(shifted(-3, 0, 0))});
    scene.add({"right", box({0.1, 9, 9}).polyhedron(), Motion::at_rest(shifted(3, 0, 0))});
    const RobotChecker checker(Robot(robot), &scene);
    for (const double goal : {1.5, 1.5 + 1e-6}) {
        const JointPath path = PathThrough{.times = {0, 1}}.path(checker.robot(), column({-1.5, goal}));
        const RobotGradient found =
            checker.least_distance_gradient(path, checker.least_distance(path, {.tolerance = 1e-9}));
        EXPECT_EQ(found.isolated, goal > 1.5);
        EXPECT_NEAR(found.by_knots.norm(), 1, 1e-9);
    }
}

TEST(RobotGradient, RefusesPathsWithoutKnotsAndOtherAnswers) {
    Scene scene;
    scene.add({"floor", box({9, 9, 1}).polyhedron(), Motion::at_rest(shifted(0, 0, -3))});
    const RobotChecker checker(ball_on_an_arm(), &scene);
    const JointPath path = PathThrough{.times = {0, 1}}.path(checker.robot(), column({0.9, 0.3}));
    const RobotClearance found = checker.least_distance(path);
    const JointPath polynomial = JointPath::polynomials(checker.robot(), path.segments());
    EXPECT_EQ(refusal([&] { (void)checker.least_distance_gradient(polynomial, found); }),
              "gradient: a path of polynomials has no knots to change; paths through configurations have");
    RobotClearance other = found;
    other.segment = 1;
    EXPECT_EQ(refusal([&] { (void)checker.least_distance_gradient(path, other); }),
              "gradient: clearance: is no answer about this path, which has fewer segments");
    other = found;
    other.pair->second = "ceiling";
    EXPECT_EQ(refusal([&] { (void)checker.least_distance_gradient(path, other); }),
              "gradient: clearance: is no answer of this checker: it tests no such pair");
    const Limit limit(1e-9);
    EXPECT_FALSE(checker.least_distance_gradient(path, found).isolated);
}

/// The weights are the differences of the path itself, also where a spline has many knots.
TEST(KnotWeights, AreTheDerivativesOfThePath) {
    Random random(4104);
    const Robot robot = ball_on_an_arm();
    for (int trial = 0; trial < 400; ++trial) {
        const auto count = Eigen::Index(trial % 40 == 0 ? 300 : random.integer(2, 9));
        Eigen::MatrixXd knots(count, 1);
        for (Eigen::Index k = 0; k < count; ++k)
            knots(k, 0) = random.uniform(-1, 1);
        const PathThrough through = random_path(random, robot, count, false);
        const JointPath path = through.path(robot, knots);
        EXPECT_EQ(path.knots(), through.kind);
        const auto segment = std::size_t(random.integer(0, int(count) - 2));
        const double time = random.chance(0.1) ? 1 : random.uniform(0, 1);
        const JointPath::Segment& part = path.segments()[segment];
        Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(count, 1);
        for (const auto& [knot, weight] : robot::knot_weights(path, segment, time))
            weights(Eigen::Index(knot), 0) = weight;
        for (int i = 0; i < 5; ++i) { // the configuration is linear in the knots
            const auto knot = Eigen::Index(random.integer(0, int(count) - 1));
            Eigen::MatrixXd changed = knots;
            changed(knot, 0) += 1;
            const double stamp = part.begin + time * (part.end - part.begin);
            const double expected = through.path(robot, changed).at(stamp)[0] - path.at(stamp)[0];
            EXPECT_NEAR(weights(knot, 0), expected, 1e-13);
        }
    }
}

} // namespace
} // namespace chasles::test::of_gradients
