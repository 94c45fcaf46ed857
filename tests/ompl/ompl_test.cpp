// OMPL's validators: its contract to the letter, and planners whose paths are proven again and sampled densely.
#include "chasles/ompl.h"

#include "tests/query/bodies.h"
#include "tests/support/refusal.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <gtest/gtest.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/pdst/PDST.h>
#include <ompl/geometric/planners/rlrt/RLRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <thread>

namespace chasles::test {
namespace {

namespace ob = ::ompl::base;
namespace og = ::ompl::geometric;

/// Two bars of length 1 in a plane, the second joint without limits, and a wall.
Robot two_bars() {
    RobotDescription robot{"bars"};
    robot.links = {{"base"},
                   {"first", {{box({0.45, 0.05, 0.05}).polyhedron(), shifted(0.5, 0, 0)}}},
                   {"second", {{box({0.45, 0.05, 0.04}).polyhedron(), shifted(0.5, 0, 0)}}}};
    JointDescription shoulder{"shoulder", JointType::revolute, "base", "first"};
    shoulder.axis = {0, 0, 1};
    shoulder.lower = -3;
    shoulder.upper = 3;
    JointDescription elbow{"elbow", JointType::continuous, "first", "second"};
    elbow.axis = {0, 0, 1};
    elbow.origin = shifted(1, 0, 0);
    robot.joints = {shoulder, elbow};
    return Robot(robot);
}

struct Bars {
    Bars() {
        ::ompl::msg::setLogLevel(::ompl::msg::LOG_ERROR);
        scene.add({"wall", box({0.3, 0.02, 1}).polyhedron(), Motion::at_rest(shifted(1.5, 0.6, 0))});
        auto shoulder = std::make_shared<ob::RealVectorStateSpace>(1);
        shoulder->setBounds(-3, 3);
        auto compound = std::make_shared<ob::CompoundStateSpace>();
        compound->addSubspace(shoulder, 1);
        compound->addSubspace(std::make_shared<ob::SO2StateSpace>(), 1);
        space = compound;
        information = std::make_shared<ob::SpaceInformation>(space);
        checker = std::make_unique<RobotChecker>(robot, &scene);
        information->setStateValidityChecker(std::make_shared<ompl::RobotValidityChecker>(information, *checker));
        validator = std::make_shared<ompl::RobotMotionValidator>(information, *checker);
        information->setMotionValidator(validator);
        information->setup();
    }
    [[nodiscard]] ob::ScopedState<> state(double a, double b) const {
        ob::ScopedState<> made(space);
        space->copyFromReals(made.get(), {a, b});
        return made;
    }
    [[nodiscard]] std::vector<double> reals(const ob::State* state) const {
        std::vector<double> numbers;
        space->copyToReals(numbers, state);
        return numbers;
    }

    Robot robot = two_bars();
    Scene scene;
    ob::StateSpacePtr space;
    ob::SpaceInformationPtr information;
    std::unique_ptr<RobotChecker> checker;
    std::shared_ptr<ompl::RobotMotionValidator> validator;
};

TEST(Ompl, TouchesNeitherPartOfLastValidOnSuccess) {
    const Bars bars;
    const auto s1 = bars.state(0, 0), s2 = bars.state(-1, 0.5), kept = bars.state(0.125, 0.25);
    ob::ScopedState<> last(kept);
    std::pair<ob::State*, double> pair{last.get(), 0.375};
    EXPECT_TRUE(bars.validator->checkMotion(s1.get(), s2.get(), pair));
    EXPECT_TRUE(bars.validator->checkMotion(s1.get(), s2.get()));
    EXPECT_EQ(pair.second, 0.375);
    EXPECT_EQ(bars.reals(last.get()), bars.reals(kept.get()));
    EXPECT_EQ(bars.validator->getValidMotionCount(), 2U);
    EXPECT_EQ(bars.validator->getInvalidMotionCount(), 0U);
}

TEST(Ompl, GivesAValidStateAndAProvenFractionOnFailure) {
    const Bars bars;
    const auto s1 = bars.state(0, 0), s2 = bars.state(1, 0);
    EXPECT_FALSE(bars.validator->checkMotion(s1.get(), s2.get()));
    const RobotAnswer found = bars.checker->first_contact(Configuration{{0, 0}}, Configuration{{1, 0}});
    for (const int alias : {0, 1, 2, 3}) { // another state, s1, s2, null
        ob::ScopedState<> start(s1), goal(s2), other(s2);
        ob::State* const target = alias == 0   ? other.get()
                                  : alias == 1 ? start.get()
                                  : alias == 2 ? goal.get()
                                               : nullptr;
        std::pair<ob::State*, double> last{target, -1};
        EXPECT_FALSE(bars.validator->checkMotion(start.get(), goal.get(), last));
        EXPECT_GT(last.second, found.clear_until - 1e-6);
        EXPECT_LE(last.second, found.clear_until);
        if (!target)
            continue;
        EXPECT_TRUE(bars.information->isValid(target));
        EXPECT_NEAR(bars.reals(target)[0], last.second, 1e-15);
        EXPECT_TRUE(bars.checker->is_clear(Configuration{{0, 0}}, Configuration{{bars.reals(target)[0], 0}}));
    }
    EXPECT_EQ(bars.validator->getInvalidMotionCount(), 5U);
}

/// Planners such as LBKPIECE1 grow trees from the goal: they use the motion to the last valid state backwards.
TEST(Ompl, TheMotionToTheLastValidStateIsProvenBothWays) {
    const Bars bars;
    ::ompl::RNG random(5);
    int touching = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto s1 = bars.state(random.uniformReal(-0.5, 0.3), random.uniformReal(-1, 1)),
                   s2 = bars.state(random.uniformReal(0.3, 1.5), random.uniformReal(-1, 1));
        ob::ScopedState<> last(s1);
        std::pair<ob::State*, double> pair{last.get(), 1};
        if (!bars.information->isValid(s1.get()) || bars.validator->checkMotion(s1.get(), s2.get(), pair) ||
            pair.second == 0)
            continue;
        ++touching;
        EXPECT_TRUE(bars.validator->checkMotion(s1.get(), last.get()));
        EXPECT_TRUE(bars.validator->checkMotion(last.get(), s1.get()));
    }
    EXPECT_GT(touching, 500);
}

TEST(Ompl, AMotionThatLeavesTheBoundsIsNotValid) {
    const Bars bars;
    const auto s1 = bars.state(-2, 0), s2 = bars.state(-4, 0);
    ob::ScopedState<> last(s1);
    std::pair<ob::State*, double> pair{last.get(), -1};
    EXPECT_FALSE(bars.validator->checkMotion(s1.get(), s2.get(), pair));
    EXPECT_FALSE(bars.validator->checkMotion(s1.get(), s2.get()));
    EXPECT_TRUE(bars.information->isValid(last.get()));
    EXPECT_GE(pair.second, 0);
    EXPECT_LE(pair.second, 0.5);
}

/// The validator tries states first where many motions touched, and answers as the checker does all the same.
TEST(Ompl, AnswersDoNotDependOnTheMotionsBefore) {
    const Bars bars;
    ::ompl::RNG random(3);
    int touching = 0, missed_by_states = 0;
    for (int i = 0; i < 4000; ++i) {
        const bool is_far = i / 1000 % 2 == 0; // from the wall: motions touch seldom
        const double middle = is_far ? -2 : 0.4;
        const Configuration from{{middle + random.uniformReal(-0.9, 0.9), random.uniformReal(-3, 3)}},
            to{{middle + random.uniformReal(-0.9, 0.9), random.uniformReal(-3, 3)}};
        const auto s1 = bars.state(from[0], from[1]), s2 = bars.state(to[0], to[1]);
        const bool expected = bars.checker->is_clear(to) && bars.checker->is_clear(from, to);
        EXPECT_EQ(bars.validator->checkMotion(s1.get(), s2.get()), expected) << "motion " << i;
        if (expected || !bars.checker->is_clear(to))
            continue;
        ++touching;
        const JointPath path = JointPath::straight(bars.robot, std::array<Configuration, 2>{from, to});
        missed_by_states += std::ranges::all_of(std::array{0.25, 0.5, 0.75},
                                                [&](double t) { return bars.checker->is_clear(path.at(t)); });
    }
    EXPECT_GT(touching, 200);
    EXPECT_GT(missed_by_states, 20);
}

TEST(Ompl, AStartThatTouchesIsKept) {
    const Bars bars;
    const auto s1 = bars.state(std::atan2(0.6, 1.5), 0), s2 = bars.state(0, 0);
    ob::ScopedState<> last(s2);
    std::pair<ob::State*, double> pair{last.get(), -1};
    EXPECT_FALSE(bars.validator->checkMotion(s1.get(), s2.get(), pair));
    EXPECT_EQ(pair.second, 0);
    EXPECT_EQ(bars.reals(last.get()), bars.reals(s1.get()));
}

TEST(Ompl, GoesRoundTheShorterWayAsOmplDoes) {
    const Bars bars;
    const auto s1 = bars.state(-1, 3), s2 = bars.state(-1, -3);
    ob::ScopedState<> middle(bars.space);
    for (double t = 0; t <= 1; t += 0.0625) {
        bars.space->interpolate(s1.get(), s2.get(), t, middle.get());
        const Configuration ours =
            JointPath::straight(bars.robot, std::array{Configuration{{-1, 3}}, Configuration{{-1, -3}}}).at(t);
        EXPECT_NEAR(std::remainder(ours[1] - bars.reals(middle.get())[1], 2 * std::numbers::pi), 0, 1e-14);
    }
}

/// From 3 to -3 a RealVectorStateSpace goes through 0, and a continuous joint through pi.
TEST(Ompl, SpacesThatGoAnotherWayAreRefused) {
    const Robot robot = two_bars();
    const RobotChecker checker(robot);
    const Robot body = ompl::free_body(box({1, 1, 1}).polyhedron());
    const RobotChecker of_body(body);
    const auto why = [](const ob::StateSpacePtr& space, const RobotChecker& asked, const ompl::StateMap& map) {
        const auto information = std::make_shared<ob::SpaceInformation>(space);
        const std::string refused = refusal([&] { ompl::RobotMotionValidator(information, asked, map); });
        EXPECT_EQ(refusal([&] { ompl::RobotValidityChecker(information, asked, map); }), refused);
        return refused;
    };
    const ompl::StateMap all(robot);
    EXPECT_EQ(why(std::make_shared<ob::RealVectorStateSpace>(2), checker, all),
              "space: number 1: elbow goes the shorter way round, as in an SO2StateSpace");
    EXPECT_EQ(why(std::make_shared<ob::SO2StateSpace>(), checker, ompl::StateMap(robot, {"shoulder"})),
              "space: number 0: shoulder goes straight, as in a RealVectorStateSpace");
    EXPECT_EQ(why(std::make_shared<ob::SE3StateSpace>(), checker, all),
              "state: has 7 numbers, and 2 variables are named");
    EXPECT_EQ(why(std::make_shared<ob::RealVectorStateSpace>(7), of_body, ompl::StateMap(body)),
              "space: number 3: free/rot_x is part of a quaternion, as in an SO3StateSpace");
}

TEST(Ompl, MayBeAskedFromSeveralThreads) {
    const Bars bars;
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    for (int k = 0; k < 3; ++k)
        threads.emplace_back([&] {
            for (int i = 0; i < 200; ++i) {
                const auto s1 = bars.state(0, 0), s2 = bars.state(1, 0), s3 = bars.state(-1, 0);
                wrong += bars.information->getMotionValidator()->checkMotion(s1.get(), s2.get());
                wrong += !bars.information->getMotionValidator()->checkMotion(s1.get(), s3.get());
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(wrong, 0);
}

/// Every edge is proven again, and no sample touches.
template <class Clear>
void expect_proven(const og::PathGeometric& path, const RobotChecker& checker, const ompl::StateMap& map,
                   const Clear& sample_is_clear) {
    const ob::StateSpace& space = *path.getSpaceInformation()->getStateSpace();
    ob::ScopedState<> between(path.getSpaceInformation());
    for (std::size_t i = 0; i + 1 < path.getStateCount(); ++i) {
        const ob::State *a = path.getState(unsigned(i)), *b = path.getState(unsigned(i) + 1);
        EXPECT_TRUE(checker.is_clear(map(space, a), map(space, b)));
        for (double t = 0; t <= 1; t += 0.02) {
            space.interpolate(a, b, t, between.get());
            EXPECT_TRUE(sample_is_clear(map(space, between.get())));
        }
    }
}

template <class Planner>
void plan_for_bars(const char* name) {
    ::ompl::RNG::setSeed(1); // the same random numbers in every run
    Bars bars;
    og::SimpleSetup setup(bars.information);
    setup.setStartAndGoalStates(bars.state(0, 0), bars.state(1.2, 0));
    bars.space->registerDefaultProjection([&] {
        struct Projection : ob::ProjectionEvaluator {
            using ProjectionEvaluator::ProjectionEvaluator;
            [[nodiscard]] unsigned getDimension() const override { return 2; }
            void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> to) const override {
                std::vector<double> numbers;
                space_->copyToReals(numbers, state);
                to << numbers[0], numbers[1];
            }
            void defaultCellSizes() override { cellSizes_ = {0.2, 0.2}; }
        };
        return std::make_shared<Projection>(bars.space);
    }());
    setup.setPlanner(std::make_shared<Planner>(bars.information));
    ASSERT_EQ(setup.solve(10), ob::PlannerStatus::EXACT_SOLUTION) << name;
    EXPECT_GT(setup.getSolutionPath().getStateCount(), 2U) << name << ": the wall is in the way";
    expect_proven(setup.getSolutionPath(), *bars.checker, ompl::StateMap(bars.robot),
                  [&](const Configuration& q) { return bars.checker->is_clear(q); });
}

TEST(Ompl, PlannersFindProvenPathsInJointSpace) {
    plan_for_bars<og::RRTConnect>("RRTConnect");
    plan_for_bars<og::LBKPIECE1>("LBKPIECE1");
    plan_for_bars<og::PDST>("PDST");
    plan_for_bars<og::RLRT>("RLRT");
}

/// A wall at x = 0 with a window of 1 by 1 around the x axis.
Scene wall_with_window() {
    Scene scene;
    for (const double side : {-1.0, 1.0}) {
        scene.add(
            {side < 0 ? "left" : "right", box({0.1, 1, 3}).polyhedron(), Motion::at_rest(shifted(0, side * 1.5, 0))});
        scene.add(
            {side < 0 ? "below" : "above", box({0.1, 3, 1}).polyhedron(), Motion::at_rest(shifted(0, 0, side * 1.5))});
    }
    return scene;
}

TEST(Ompl, AFreeBodyFindsTheWindow) {
    ::ompl::msg::setLogLevel(::ompl::msg::LOG_ERROR);
    const Scene scene = wall_with_window();
    const Robot robot = ompl::free_body(box({0.6, 0.2, 0.2}).polyhedron());
    const RobotChecker checker(robot, &scene);
    auto space = std::make_shared<ob::SE3StateSpace>();
    ob::RealVectorBounds bounds(3);
    bounds.setLow(-2);
    bounds.setHigh(2);
    space->setBounds(bounds);
    og::SimpleSetup setup(space);
    setup.getSpaceInformation()->setMotionValidator(
        std::make_shared<ompl::RobotMotionValidator>(setup.getSpaceInformation(), checker));
    setup.setStateValidityChecker(std::make_shared<ompl::RobotValidityChecker>(setup.getSpaceInformation(), checker));
    ob::ScopedState<ob::SE3StateSpace> start(space), goal(space);
    start->setXYZ(-1.5, 1, 0);
    start->rotation().setAxisAngle(0, 0, 1, 1.5707963); // across
    goal->setXYZ(1.5, -1, 0);
    goal->rotation().setIdentity();
    setup.setStartAndGoalStates(start, goal);
    setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
    ASSERT_EQ(setup.solve(20), ob::PlannerStatus::EXACT_SOLUTION);
    // Each sample by the query for two bodies, which knows no robots.
    expect_proven(setup.getSolutionPath(), checker, ompl::StateMap(robot), [&](const Configuration& q) {
        const Pose pose({q[0], q[1], q[2]}, Eigen::Quaterniond(q[6], q[3], q[4], q[5]));
        return std::ranges::all_of(scene.bodies(), [&](const SceneBody& body) {
            const Motion rest = relative(Motion::at_rest(pose), body.motion);
            return first_contact({box({0.6, 0.2, 0.2}).polyhedron(), body.shape, rest}).verdict == Verdict::clear;
        });
    });
}

} // namespace
} // namespace chasles::test
