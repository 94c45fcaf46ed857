// Several robots as one: names, places, what is tested, and the first contact of two robots on clocks of their own.
#include "chasles/mesh/primitives.h"
#include "tests/robot/random_robot.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Robots = std::vector<std::pair<std::string, Robot>>;
using Names = std::pair<std::string, std::string>;

/// A robot of links and joints by chance, with one of each change, and a group with a state.
Robot member_of_cell(Random& random, bool has_floating = true) {
    RobotDescription description = random_robot(random, 5, has_floating);
    std::vector<std::string> names;
    for (const LinkDescription& link : description.links)
        names.push_back(link.name);
    description.disabled_pairs = {{names[0], names[4], "Never"}};
    description.enabled_pairs = {{names[0], names[1]}};
    description.warnings = {"odd"};
    description.groups = {{"all", {}, names}};
    Robot robot(std::move(description));
    robot.set_base(random_pose(random, 3));
    robot.attach({"part", names[3], make_box({0.1, 0.2, 0.3}), random_pose(random, 1), {names[2]}});
    robot.ignore("part", names[0]);
    robot.test(names[1], names[2]);
    robot.ignore_in_scene("part", "wall");
    robot.set_margin("part", names[1], 0.25);
    return robot;
}

Configuration joined(const Configuration& a, const Configuration& b) {
    Configuration both(a.size() + b.size());
    both << a, b;
    return both;
}

TEST(RobotTogether, PutsNamesInFrontAndKeepsAllChanges) {
    Random random(4201);
    for (int trial = 0; trial < 20; ++trial) {
        const Robots robots{{"left", member_of_cell(random)}, {"right", member_of_cell(random)}};
        const Robot cell = Robot::together(robots);
        const Configuration a = random_configuration(random, robots[0].second),
                            b = random_configuration(random, robots[1].second);
        EXPECT_EQ(cell.variables().size(), std::size_t(a.size() + b.size()));
        for (const auto& [name, robot] : robots) {
            const std::string front = name + '/';
            const Configuration& own = name == "left" ? a : b;
            for (const RobotVariable& variable : robot.variables()) {
                const RobotVariable& of_cell = cell.variables()[cell.variable(front + variable.name)];
                EXPECT_EQ(of_cell.is_continuous, variable.is_continuous);
                EXPECT_EQ(of_cell.lower, variable.lower);
            }
            for (const LinkDescription& link : robot.description().links) {
                const Pose alone = robot.link_pose(link.name, own);
                const Pose in_cell = cell.link_pose(front + link.name, joined(a, b));
                EXPECT_TRUE(in_cell.isometry().isApprox(alone.isometry(), 1e-13)) << link.name;
                for (const LinkDescription& other : robot.description().links)
                    if (other.name != link.name) {
                        EXPECT_EQ(cell.is_tested(front + link.name, front + other.name),
                                  robot.is_tested(link.name, other.name));
                    }
            }
            EXPECT_FALSE(cell.is_tested(front + "part", front + "link 2")) << "a touch link";
            EXPECT_FALSE(cell.is_tested(front + "part", front + "link 0")) << "ignored";
            EXPECT_FALSE(cell.is_tested_in_scene(front + "part", "wall"));
            EXPECT_TRUE(cell.is_tested_in_scene("part", "wall"));
        }
        const RobotChanges changes = cell.changes();
        ASSERT_EQ(changes.margins.size(), 2U);
        EXPECT_EQ(changes.margins[1].first, Names("right/link 1", "right/part"));
        EXPECT_EQ(cell.warnings(), (std::vector<std::string>{"left: odd", "right: odd"}));
        EXPECT_EQ(cell.description().groups[1].name, "right/all");
        EXPECT_EQ(cell.description().groups[1].links[2], "right/link 2");
        EXPECT_EQ(cell.description().disabled_pairs[1].second, "right/link 4");
    }
}

/// A hinge about z with a bar along x, from the hinge to `length`, as thick as 2 `half`.
Robot hinge(double length, double half) {
    RobotDescription robot{"hinge"};
    robot.links = {{"base", {{make_box({half, half, half})}}},
                   {"bar", {{make_box({length, 2 * half, 2 * half}), Pose({length / 2, 0, 0}, {1, 0, 0, 0})}}}};
    robot.joints = {{"turn", JointType::revolute, "base", "bar"}};
    robot.joints[0].axis = Eigen::Vector3d::UnitZ();
    robot.states = {{"home", "arm", {{"turn", {1.5}}}}};
    return Robot(robot);
}

/// A slide along x with a wall, whose face towards the origin is at the value of the slide.
Robot slide() {
    RobotDescription robot{"slide"};
    robot.links = {{"base"}, {"wall", {{make_box({1, 50, 50}), Pose({0.5, 0, 0}, {1, 0, 0, 0})}}}};
    robot.joints = {{"way", JointType::prismatic, "base", "wall"}};
    return Robot(robot);
}

/// Where a path of one variable is that goes straight from value to value at these stamps.
double value_at(const std::vector<double>& stamps, const std::vector<double>& values, double stamp) {
    if (stamp <= stamps.front())
        return values.front();
    for (std::size_t i = 1; i < stamps.size(); ++i)
        if (stamp <= stamps[i])
            return std::lerp(values[i - 1], values[i], (stamp - stamps[i - 1]) / (stamps[i] - stamps[i - 1]));
    return values.back();
}

JointPath path_through(const Robot& robot, const std::vector<double>& stamps, const std::vector<double>& values) {
    std::vector<Configuration> all;
    for (const double value : values)
        all.emplace_back(Configuration::Constant(1, value));
    return JointPath::straight(robot, all, stamps);
}

/// The front corner of the bar is at L cos a + h sin a, the wall at x; both go on clocks of their own, one begins
/// earlier, and one ends earlier.
TEST(RobotTogether, ABarMeetsAWallOnAnotherClockWhenTheEquationSaysSo) {
    Random random(4202);
    int contacts = 0, cut = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const double length = random.uniform(1, 3), half = random.uniform(0.02, 0.1);
        const Robot arm = hinge(length, half), wall = slide();
        const Robot cell = Robot::together({{"arm", arm}, {"wall", wall}});
        const std::vector<double> arm_stamps{random.uniform(-1, 1), random.uniform(1.5, 2), random.uniform(3, 4)};
        const std::vector<double> wall_stamps{random.uniform(-1, 1), random.uniform(1.2, 1.4), random.uniform(2, 5)};
        const std::vector<double> angles{1.5, random.uniform(0.8, 1.4), random.uniform(0.1, 0.7)};
        const std::vector<double> ways{1.3 * length, random.uniform(1, 1.3) * length,
                                       random.uniform(0.5, 1.2) * length};
        const JointPath path = JointPath::together(
            cell, {{"arm", path_through(arm, arm_stamps, angles)}, {"wall", path_through(wall, wall_stamps, ways)}});
        const auto gap = [&](double stamp) {
            const double angle = value_at(arm_stamps, angles, stamp);
            return value_at(wall_stamps, ways, stamp) - length * std::cos(angle) - half * std::sin(angle);
        };
        double lower = path.segments().front().begin, upper = path.segments().back().end, step = 1e-4;
        while (lower < upper && gap(lower + step) > 0) // the first root is not missed, as gaps shrink slowly
            lower += step;
        const RobotAnswer found = RobotChecker(cell).first_contact(path);
        if (lower >= upper) {
            EXPECT_EQ(found.verdict, Verdict::clear);
            continue;
        }
        for (upper = lower + step; upper - lower > 1e-13 * upper;)
            (gap((lower + upper) / 2) > 0 ? lower : upper) = (lower + upper) / 2;
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_NEAR(found.time.lower, upper, 1e-9);
        EXPECT_TRUE(found.certain);
        EXPECT_EQ(found.pair->first, "wall/wall");
        EXPECT_EQ(found.pair->second, "arm/bar");
        ++contacts;
        cut += found.segment > 1;
    }
    EXPECT_GT(contacts, 30);
    EXPECT_GT(cut, 20) << "in segments that are parts of those given";
}

/// A robot that rests changes no bit of the answer about another one.
TEST(RobotTogether, ARobotAnswersTheSameBesideOneThatIsFarAway) {
    Random random(4203);
    int contacts = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Robot robot(random_robot(random, 6, trial % 4 == 0));
        Robot far = hinge(1, 0.1);
        far.set_base(Pose({500, 300, 0}, {1, 0, 0, 0}));
        const std::vector<Configuration> way{random_configuration(random, robot), random_configuration(random, robot),
                                             random_configuration(random, robot)};
        const RobotAnswer alone = RobotChecker(robot).first_contact(JointPath::straight(robot, way));
        const std::string name = trial % 2 == 0 ? "a" : "z";
        const Robot cell =
            trial % 2 == 0 ? Robot::together({{"a", robot}, {"m", far}}) : Robot::together({{"m", far}, {"z", robot}});
        const RobotAnswer found = RobotChecker(cell).first_contact(JointPath::together(
            cell, {{name, JointPath::straight(robot, way)}, {"m", Configuration::Constant(1, 0.5)}}));
        EXPECT_EQ(found.verdict, alone.verdict);
        EXPECT_EQ(found.time.lower, alone.time.lower);
        EXPECT_EQ(found.time.upper, alone.time.upper);
        EXPECT_EQ(found.clear_until, alone.clear_until);
        EXPECT_EQ(found.segment, alone.segment);
        ASSERT_EQ(found.contact.contacts.size(), alone.contact.contacts.size());
        for (std::size_t i = 0; i < found.contact.contacts.size(); ++i)
            EXPECT_EQ(found.contact.contacts[i].point, alone.contact.contacts[i].point);
        if (alone.pair) {
            EXPECT_EQ(found.pair->first, name + '/' + alone.pair->first);
            EXPECT_EQ(found.pair->second, name + '/' + alone.pair->second);
        }
        contacts += alone.verdict == Verdict::contact;
    }
    EXPECT_GT(contacts, 10);
}

/// Elsewhere in the world the base is one more factor, which rounding does not cancel to the last bit.
TEST(RobotTogether, ARobotAnswersTheSameElsewhereUpToRounding) {
    Random random(4204);
    int contacts = 0;
    for (int trial = 0; trial < 40; ++trial) {
        Robot robot(random_robot(random, 6, trial % 4 == 0));
        const Configuration start = random_configuration(random, robot), goal = random_configuration(random, robot);
        const RobotAnswer alone = RobotChecker(robot).first_contact(start, goal);
        robot.set_base(random_pose(random, 5));
        const Robot cell = Robot::together({{"a", robot}, {"b", hinge(0.01, 0.001)}});
        const RobotAnswer found = RobotChecker(cell).first_contact(
            JointPath::together(cell, {{"a", JointPath::straight(robot, std::array{start, goal})},
                                       {"b", Configuration::Constant(1, 0.5)}}));
        if (found.pair && (found.pair->first.starts_with("b/") || found.pair->second.starts_with("b/")))
            continue; // the small one is in the way
        EXPECT_EQ(found.verdict, alone.verdict);
        EXPECT_NEAR(found.time.lower, alone.time.lower, 1e-11);
        contacts += alone.verdict == Verdict::contact;
    }
    EXPECT_GT(contacts, 5);
}

/// Bases stand still whatever joints do: they are counted, not tested. All other links of two robots are tested.
TEST(RobotTogether, LinksOfDifferentRobotsAreTestedUnlessBothStandStill) {
    Robot other = hinge(1, 0.1);
    other.set_base(Pose({0.05, 0, 0}, {1, 0, 0, 0}));
    const Robot cell = Robot::together({{"a", hinge(1, 0.1)}, {"b", other}});
    EXPECT_EQ(cell.tested_pairs(), (std::vector<Names>{{"a/base", "b/bar"}, {"a/bar", "b/base"}, {"a/bar", "b/bar"}}));
    const UntestedPairs untested = RobotChecker(cell).untested();
    EXPECT_EQ(untested.count(UntestedReason::at_rest), 1U) << "the bases, which overlap";
    EXPECT_EQ(untested.tested, 3U);
    EXPECT_EQ(cell.state("b/home")[1], 1.5);
    EXPECT_EQ(cell.state("b/home", "b/arm")[0], 0);
    const Robot nested = Robot::together({{"cell", cell}, {"c", other}});
    EXPECT_EQ(nested.variables()[1].name, "cell/b/turn");
    EXPECT_EQ(nested.description().links[1].name, "cell/world");
}

TEST(RobotTogether, RefusesNamesThatSayNothing) {
    const Robot robot = slide();
    const auto refused = [](const Robots& robots) { return refusal([&] { (void)Robot::together(robots); }); };
    EXPECT_EQ(refused({}), "robot: together: there is no robot");
    EXPECT_EQ(refused({{"a", robot}, {"", robot}}), "robot: together: robot 1 has no name");
    EXPECT_EQ(refused({{"a", robot}, {"a", robot}}), "robot: together: a: two robots have this name");
    EXPECT_EQ(refused({{"a/b", robot}}),
              "robot: together: a/b: the name of a robot has no slash: one follows it in all names");
}

} // namespace
} // namespace chasles::test
