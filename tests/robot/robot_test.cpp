// Robots by themselves: kinematics, names, parts, and what is refused.
#include "chasles/robot/robot.h"

#include "tests/robot/random_robot.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

TEST(Robot, PlacesItsLinksAsEigenDoes) {
    Random random(2001);
    for (int trial = 0; trial < 200; ++trial) {
        Robot robot(random_robot(random, random.integer(1, 12), true));
        const Configuration values = random_configuration(random, robot);
        const Pose base = random_pose(random, 3);
        robot.set_base(base);
        const std::vector<Pose> poses = robot.link_poses(values);
        const PlainKinematics plain(robot, values);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const std::string& name = robot.description().links[i].name;
            const Eigen::Isometry3d expected = base.isometry() * plain.pose(name);
            EXPECT_LT((poses[i].isometry().matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-13) << name;
            EXPECT_EQ(robot.link_pose(name, values).isometry().matrix(), poses[i].isometry().matrix());
        }
    }
}

/// The shortest turn from z to its opposite is not unique. It is about x, as it was by Eigen's singular values.
TEST(Robot, PlanarJointsAlongMinusZTurnAboutX) {
    RobotDescription description{"table"};
    description.links = {{"base"}, {"plate"}};
    JointDescription joint{"joint", JointType::planar, "base", "plate"};
    joint.axis = {0, 0, -2};
    description.joints = {joint};
    const Robot robot(description);
    Configuration place(3);
    place << 3, 4, 0;
    EXPECT_LE((robot.link_pose("plate", place).translation - Eigen::Vector3d(3, -4, 0)).norm(), 1e-12);
}

/// Three bars of length 1 in a row, each turning about z at its end.
RobotDescription planar_arm() {
    RobotDescription arm{"arm"};
    arm.links.push_back({"base"});
    for (const std::string number : {"1", "2", "3"}) {
        const double height = number == "3" ? 0.03 : 0.05;
        arm.links.push_back({"bar" + number, {{box({0.45, 0.05, height}).polyhedron(), shifted(0.5, 0, 0)}}});
        JointDescription joint{"joint" + number, JointType::revolute,
                               number == "1" ? "base" : arm.links.rbegin()[1].name, "bar" + number};
        joint.origin = number == "1" ? shifted(0, 0, 0) : shifted(1, 0, 0);
        joint.axis = {0, 0, 1};
        joint.lower = -3;
        joint.upper = 3;
        arm.joints.push_back(joint);
    }
    return arm;
}

Configuration values(std::initializer_list<double> given) {
    Configuration all(Eigen::Index(given.size()));
    std::ranges::copy(given, all.data());
    return all;
}

TEST(Robot, HasVariablesAndNeutralValues) {
    RobotDescription description = planar_arm();
    description.joints[1].lower = 0.5;
    description.joints[2].upper = -0.25;
    description.states = {{"up", "", {{"joint2", {1.5}}}}};
    const Robot robot(description);
    ASSERT_EQ(robot.variables().size(), 3U);
    EXPECT_EQ(robot.variable("joint2"), 1U);
    EXPECT_EQ(robot.neutral(), values({0, 0.5, -0.25}));
    EXPECT_EQ(robot.state("up"), values({0, 1.5, -0.25}));
    EXPECT_EQ(refusal([&] { (void)robot.variable("elbow"); }), "robot: elbow: there is no such variable of a joint");
    description.joints[1].mimic = MimicDescription{"joint1"};
    description.joints[2].type = JointType::fixed;
    const Robot follower(description);
    EXPECT_EQ(refusal([&] { (void)follower.variable("joint2"); }),
              "robot: joint2: there is no such variable of a joint: it follows joint1");
    EXPECT_EQ(refusal([&] { (void)follower.variable("joint3"); }),
              "robot: joint3: there is no such variable of a joint: it is fixed");
    EXPECT_EQ(refusal([&] { (void)robot.state("down"); }), "robot: down: there is no such state");
}

TEST(Robot, AStateOfSeveralGroupsNeedsItsGroup) {
    RobotDescription description = planar_arm();
    description.states = {{"home", "left", {{"joint1", {0.5}}}}, {"home", "right", {{"joint3", {0.25}}}}};
    const Robot robot(description);
    EXPECT_EQ(robot.state("home", "left"), values({0.5, 0, 0}));
    EXPECT_EQ(robot.state("home", "right"), values({0, 0, 0.25}));
    EXPECT_EQ(refusal([&] { (void)robot.state("home"); }),
              "robot: home: the groups left and right have such a state; name one of them");
    EXPECT_EQ(refusal([&] { (void)robot.state("home", "head"); }), "robot: home: the group head has no such state");
}

/// The tip of the third bar comes back to the first one: at angles a, a the bars make a triangle-like figure.
TEST(Robot, FindsThatItTouchesItself) {
    const Robot robot(planar_arm());
    const RobotAnswer found = RobotChecker(robot).first_contact(values({0, 0, 0}), values({0, 2.9, 2.8}));
    EXPECT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    ASSERT_TRUE(found.pair);
    EXPECT_EQ(found.pair->first, "bar3");
    EXPECT_EQ(found.pair->second, "bar1");
    EXPECT_FALSE(found.pair->is_with_scene);
    EXPECT_LT(found.time.upper - found.time.lower, 1e-11);
    EXPECT_LE(found.clear_until, found.time.lower);
    EXPECT_NEAR(found.configuration[2], 2.8 * found.time.lower, 1e-15);
    EXPECT_NEAR(found.configuration[1], 2.9 * found.time.lower, 1e-15);
}

/// A bar of half width 0.05 turns to a wall whose face is at y = 1: the corner (0.95, 0.05) of the first bar is at
/// y = 0.95 sin a + 0.05 cos a, that of the outstretched arm at 2.95 sin a + 0.05 cos a.
TEST(Robot, TouchesAWallWhereGeometrySays) {
    const Robot robot(planar_arm());
    Scene scene;
    scene.add({"wall", box({9, 1, 9}).polyhedron(), Motion::at_rest(shifted(0, 2, 0))});
    const RobotAnswer found = RobotChecker(robot, &scene).first_contact(values({0, 0, 0}), values({1.5, 0, 0}));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_EQ(found.pair->first, "bar3");
    EXPECT_EQ(found.pair->second, "wall");
    EXPECT_TRUE(found.pair->is_with_scene);
    const double radius = std::hypot(2.95, 0.05), ahead = std::atan2(0.05, 2.95);
    EXPECT_NEAR(found.configuration[0], std::asin(1 / radius) - ahead, 1e-11);
    EXPECT_NEAR(found.contact.contacts.at(0).point.y(), 1, 1e-11);
}

/// A pair of names could mean a body or a link. A link without shapes is in no pair.
TEST(Robot, RefusesBodiesWithNamesOfItsOwn) {
    RobotDescription description = planar_arm();
    description.links.push_back({"frame"});
    description.joints.push_back({.name = "fixed", .parent = "bar3", .child = "frame"});
    Robot robot(description);
    robot.attach({"rod", "bar3", box({1, 0.02, 0.02}).polyhedron(), shifted(2, 0, 0)});
    for (const char* const name : {"bar3", "rod"}) {
        Scene scene;
        scene.add({name, box({1, 1, 1}).polyhedron(), Motion::at_rest(shifted(0, 9, 0))});
        EXPECT_EQ(refusal([&] { (void)RobotChecker(robot, &scene); }),
                  "scene: '" + std::string(name) +
                      "' is a body of the scene and a link or part of the robot; rename the body");
    }
    for (const char* const name : {"frame", "bar4"}) {
        Scene scene;
        scene.add({name, box({1, 1, 1}).polyhedron(), Motion::at_rest(shifted(0, 9, 0))});
        EXPECT_NO_THROW((void)RobotChecker(robot, &scene)) << name;
    }
}

TEST(Robot, CarriesPartsAndIgnoresPairs) {
    Robot robot(planar_arm());
    Scene scene;
    scene.add({"wall", box({9, 1, 9}).polyhedron(), Motion::at_rest(shifted(0, 2, 0))});
    const Configuration start = values({0, 0, 0}), goal = values({0.25, 0, 0});
    EXPECT_TRUE(RobotChecker(robot, &scene).is_clear(start, goal));
    robot.attach({"rod", "bar3", box({1, 0.02, 0.02}).polyhedron(), shifted(2, 0, 0)});
    const RobotAnswer found = RobotChecker(robot, &scene).first_contact(start, goal);
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_EQ(found.pair->first, "rod");
    robot.ignore_in_scene("rod", "wall");
    EXPECT_TRUE(RobotChecker(robot, &scene).is_clear(start, goal));
    EXPECT_FALSE(RobotChecker(robot).is_clear(start, values({0, 2.9, 2.9})));
    robot.ignore("bar1", "bar3");
    robot.ignore("rod", "bar1");
    robot.ignore("rod", "bar2");
    EXPECT_TRUE(RobotChecker(robot).is_clear(start, values({0, 2.9, 2.9})));
    robot.detach("rod");
    EXPECT_FALSE(robot.is_tested("bar1", "bar3"));
    robot.test("bar3", "bar1");
    EXPECT_TRUE(robot.is_tested("bar1", "bar3"));
    EXPECT_FALSE(robot.is_tested("bar1", "bar2")) << "a joint connects them";
    EXPECT_EQ(refusal([&] { robot.detach("rod"); }), "robot: rod: there is no such part");
    EXPECT_EQ(refusal([&] {
                  robot.attach({"bar1", "bar3", box({1, 1, 1}).polyhedron()});
              }),
              "robot: bar1: the name is taken");
    EXPECT_EQ(refusal([&] { robot.ignore("bar1", "bar1"); }), "robot: bar1: is named twice");
}

TEST(Robot, HasMarginsOfPairs) {
    Robot robot(planar_arm());
    const Configuration start = values({0, 0, 0}), goal = values({0, 2.9, 2.9});
    const RobotAnswer bare = RobotChecker(robot).first_contact(start, goal);
    robot.set_margin("bar1", "bar3", 0.2);
    const RobotAnswer wide = RobotChecker(robot).first_contact(start, goal);
    const RobotAnswer all = RobotChecker(robot, nullptr, {.options = {.margin = 0.2}}).first_contact(start, goal);
    ASSERT_EQ(wide.verdict, Verdict::contact);
    EXPECT_LT(wide.time.upper, bare.time.lower);
    EXPECT_EQ(wide.time.lower, all.time.lower);
}

/// A cube on a long arm turns by `angle`. What is just below its highest point is within the arc, above all chords.
TEST(Robot, TouchesWhatOnlyItsArcReaches) {
    const double arm = 5, half = 0.05;
    RobotDescription description{"crane"};
    description.links = {{"base"}, {"jib", {{box({half, half, half}).polyhedron(), shifted(0, arm, 0)}}}};
    description.joints = {{"turn", JointType::continuous, "base", "jib"}};
    const Robot robot(description);
    for (const double angle : {0.05, 0.2, 0.6, 1.5, 2.5})
        for (const double gap : {-1e-9, 1e-9}) {
            Scene scene; // the corners are highest just before and after the middle
            const double top = std::hypot(arm + half, half);
            scene.add({"lid", box({9, 1, 9}).polyhedron(), Motion::at_rest(shifted(0, top + 1 + gap, 0))});
            const Configuration start = values({-angle / 2}), goal = values({angle / 2});
            EXPECT_EQ(RobotChecker(robot, &scene).is_clear(start, goal), gap > 0) << angle;
        }
}

/// A slide beside a wall, so near that only the margin reaches it.
TEST(Robot, KeepsItsMarginFromTheWorld) {
    RobotDescription description{"slide"};
    description.links = {{"base"}, {"cube", {{box({1, 1, 1}).polyhedron(), Pose()}}}};
    description.joints = {{"way", JointType::prismatic, "base", "cube"}};
    const Robot robot(description);
    for (const int bodies : {1, 40}) { // one by one, and in a tree
        Scene scene;
        for (int i = 0; i < bodies; ++i)
            scene.add(
                {std::to_string(i), box({5, 1, 5}).polyhedron(), Motion::at_rest(shifted(0, 2.0625 + 9.0 * i, 0))});
        for (const double margin : {0.0624, 0.0626})
            EXPECT_EQ(RobotChecker(robot, &scene, {.options = {.margin = margin}}).is_clear(values({0}), values({1})),
                      margin < 0.0625);
    }
}

template <class Change>
std::string refusal_of(const Change& change) {
    RobotDescription arm = planar_arm();
    change(arm);
    return refusal([&] { (void)Robot(arm); });
}

TEST(Robot, RefusesWhatIsNoTree) {
    using D = RobotDescription;
    EXPECT_EQ(refusal_of([](D& d) { d.joints[2].parent = "nobody"; }), "robot: nobody: there is no such link");
    EXPECT_EQ(refusal_of([](D& d) { d.joints[2].child = "bar2"; }),
              "robot: bar2: is the child of two joints, joint2 and joint3");
    EXPECT_EQ(refusal_of([](D& d) { d.joints.pop_back(); }),
              "robot: bar3: is the child of no joint, and neither is base");
    EXPECT_EQ(refusal_of([](D& d) { d.joints[0].parent = "bar3"; }), "robot: bar1: is not connected with the root");
    EXPECT_EQ(refusal_of([](D& d) { d.links[1].name = "base"; }), "robot: base: there is another link of this name");
    EXPECT_EQ(refusal_of([](D& d) {
                  d.joints[1].axis = {0, 0, 0};
              }),
              "robot: joint2: axis: must be finite and not zero");
    EXPECT_EQ(refusal_of([](D& d) { d.joints[1].lower = 4; }),
              "robot: joint2: limits: the lower one must not be above the upper one");
    EXPECT_EQ(refusal_of([](D& d) { d.joints[1].mimic = MimicDescription{"joint9"}; }),
              "robot: joint2: mimic: there is no joint joint9");
    EXPECT_EQ(refusal_of([](D& d) {
                  d.joints[1].mimic = MimicDescription{"joint3"};
                  d.joints[2].mimic = MimicDescription{"joint2"};
              }),
              "robot: joint2: mimic: follows itself");
    EXPECT_EQ(refusal_of([](D& d) {
                  d.disabled_pairs.push_back({"bar1", "bar7"});
              }),
              "robot: bar7: there is no such link or part");
    EXPECT_EQ(refusal_of([](D& d) {
                  d.links.clear();
                  d.joints.clear();
              }),
              "robot: arm: has no link");
}

TEST(Robot, RefusesGroupsStatesAndShapesThatAreWrong) {
    using D = RobotDescription;
    const auto with_state = [](const std::string& joint, const std::vector<double>& values) {
        return refusal_of([&](D& d) { d.states = {{"up", "", {{joint, values}}}}; });
    };
    EXPECT_EQ(refusal_of([](D& d) {
                  d.groups = {{"all", {"joint1", "joint9"}}};
              }),
              "robot: all: there is no joint joint9");
    EXPECT_EQ(refusal_of([](D& d) { d.groups = {{"all", {}, {"bar9"}}}; }), "robot: all: there is no link bar9");
    EXPECT_EQ(with_state("joint9", {1}), "robot: up: there is no joint joint9");
    EXPECT_EQ(with_state("joint1", {1, 2}), "robot: up: joint1: needs 1 values, and has 2");
    EXPECT_EQ(with_state("joint1", {std::numeric_limits<double>::infinity()}), "robot: up: joint1: must be finite");
    EXPECT_EQ(refusal_of([](D& d) { d.links[1].collisions.at(0).deviation = -1; }),
              "robot: bar1: deviation: must be at least 0, and finite");
    EXPECT_EQ(refusal([] { (void)Robot(RobotDescription()); }), "robot: has no link");
}

TEST(Robot, RefusesChainsOfMoreThanAThousandJoints) {
    const auto chain = [](int joints) {
        RobotDescription robot{"chain"};
        robot.links = {{"0"}};
        for (int i = 1; i <= joints; ++i) {
            robot.links.push_back({std::to_string(i)});
            robot.joints.push_back(
                {"to " + std::to_string(i), JointType::prismatic, std::to_string(i - 1), std::to_string(i)});
        }
        return robot;
    };
    EXPECT_EQ(refusal([&] { (void)Robot(chain(1000)); }), "accepted");
    EXPECT_EQ(refusal([&] { (void)Robot(chain(1001)); }), "robot: to 1001: there are more than 1000 joints above it");
}

/// Frames without shapes, as exporters write them: each one costs the same, however many there are.
TEST(Robot, HasTwentyThousandFixedLinks) {
    constexpr int last = 20'000;
    RobotDescription robot{"frames"};
    robot.links.push_back({"0", {{box({0.1, 0.1, 0.1}).polyhedron()}}});
    for (int i = 1; i <= last; ++i) {
        JointDescription joint{"to " + std::to_string(i), i == 1 ? JointType::revolute : JointType::fixed,
                               std::to_string(i - 1), std::to_string(i)};
        joint.axis = {0, 0, 1};
        joint.origin = shifted(0.001, 0, 0);
        robot.links.push_back({std::to_string(i)});
        robot.joints.push_back(joint);
    }
    robot.links.back().collisions = {{box({0.1, 0.1, 0.1}).polyhedron()}};
    robot.links[7].collisions = {{box({0.1, 0.1, 0.1}).polyhedron()}};
    const Robot made(robot);
    EXPECT_NEAR(made.link_pose(std::to_string(last), Configuration::Zero(1)).translation.x(), 0.001 * last, 1e-9);
    EXPECT_FALSE(made.is_tested("0", "7")); // neighbours
    EXPECT_TRUE(made.is_tested("0", std::to_string(last)));
}

} // namespace
} // namespace chasles::test
