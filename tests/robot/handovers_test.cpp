// Parts that change hands on a path: they keep their places, and what carries them is not tested against them.
#include "chasles/mesh/primitives.h"
#include "chasles/robot/handovers.h"
#include "tests/robot/random_robot.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// A hand of side 0.2 that slides along x; its centre is at the value of the slide, and at a height.
Robot slider(double height) {
    RobotDescription robot{"slider"};
    robot.links = {{"rail"}, {"hand", {{make_box({0.2, 0.2, 0.2})}}}};
    robot.joints = {{"x", JointType::prismatic, "rail", "hand", Pose({0, 0, height}, {1, 0, 0, 0})}};
    return Robot(robot);
}

/// A cube of side 0.2 between two sliders, which the lower one brings and the upper one takes.
struct Exchange {
    Robot lower = slider(0), upper = slider(0.4);
    Robot cell = together();
    JointPath path = JointPath::together(
        cell, {{"lower", JointPath::straight(lower, std::array{at(0), at(1), at(-1)}, std::array{0.0, 1.0, 3.0})},
               {"upper", JointPath::straight(upper, std::array{at(1), at(5)}, std::array{1.0, 2.0})}});
    Handover taken{1, "cube", "upper/hand"};

    static Configuration at(double x) { return Configuration::Constant(1, x); }
    Robot together() {
        Robot both = Robot::together({{"lower", lower}, {"upper", upper}});
        both.attach({"cube", "lower/hand", make_box({0.2, 0.2, 0.2}), Pose({0, 0, 0.2}, {1, 0, 0, 0})});
        return both;
    }
};

/// A wall whose face is at this x.
Scene wall_at(double x, double side) {
    Scene scene;
    scene.add({"wall", make_box({1, 4, 4}), Motion::at_rest(Pose({x + side * 0.5, 0, 0}, {1, 0, 0, 0}))});
    return scene;
}

/// The cube goes with the lower hand up to stamp 1 and with the upper one from then on.
TEST(Handovers, APartGoesWithTheHandThatHasIt) {
    const Exchange e;
    const RobotChecker alone(e.cell);
    EXPECT_EQ(alone.first_contact(e.path, std::array{e.taken}).verdict, Verdict::clear);
    EXPECT_EQ(alone.first_contact(e.path).verdict, Verdict::contact) << "without the handover the hands touch";
    // the upper hand goes from 1 to 5 between the stamps 1 and 2; the wall's face is at 3
    const Scene far = wall_at(3, 1);
    const RobotAnswer taken = RobotChecker(e.cell, &far).first_contact(e.path, std::array{e.taken});
    EXPECT_EQ(taken.verdict, Verdict::contact);
    EXPECT_NEAR(taken.time.lower, 1 + (3 - 0.1 - 1) / 4.0, 1e-9);
    const Scene left = wall_at(-0.5, -1); // the lower hand is there without the cube, on its way from 1 to -1
    const RobotAnswer back = RobotChecker(e.cell, &left).first_contact(e.path, std::array{e.taken});
    EXPECT_EQ(back.pair->first, "lower/hand");
    EXPECT_NEAR(back.time.lower, 1 + (1 - (-0.5 + 0.1)) / 2 * 2, 1e-9);
    EXPECT_EQ(back.segment, 2U);
}

/// The nearest pair along the path is the cube and the wall, or both hands.
TEST(Handovers, DistancesFollowTheHandThatHasThePart) {
    const Exchange e;
    Robot cell = e.cell;
    for (const char* const link : {"lower/hand", "upper/hand"})
        cell.ignore_in_scene(link, "wall"); // the cube alone is tested
    const Scene wall = wall_at(5.2, 1);     // the hands are never nearer to each other than 0.2
    const RobotChecker checker(cell, &wall);
    const RobotClearance with = checker.least_distance(e.path, {}, std::array{e.taken});
    EXPECT_NEAR(with.distance.lower, 0.1, 1e-5);
    EXPECT_EQ(with.pair->first, "cube");
    EXPECT_EQ(with.segment, 1U);
    cell.ignore("cube", "upper/hand"); // without the handover it stays with the lower hand
    cell.ignore("lower/hand", "upper/hand");
    EXPECT_NEAR(RobotChecker(cell, &wall).least_distance(e.path).distance.lower, 5.2 - 1 - 0.1, 1e-5);
    const RobotProfile profile = checker.profile(e.path, {.tolerance = 1e-3}, std::array{e.taken});
    const auto& [times, lower, upper] =
        std::tie(profile.distance.times, profile.distance.lower, profile.distance.upper);
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        const double middle = (times[i] + times[i + 1]) / 2;
        const double x = middle < 1 ? middle : std::min(1 + 4 * (middle - 1), 5.0);
        const double apart = middle < 1 ? 1 - x : x - (2 - middle); // of the hands, along x
        const double hands = std::hypot(std::max(0.0, apart - 0.2), 0.2);
        const double distance = std::min(5.2 - x - 0.1, hands);
        EXPECT_LE(lower[i], distance * (1 + 1e-9)) << middle;
        EXPECT_GE(upper[i], distance * (1 - 1e-9)) << middle;
    }
}

/// Whatever robots do, a part has the same place before and after it changes hands.
TEST(Handovers, APartKeepsItsPlace) {
    Random random(4221);
    for (int trial = 0; trial < 60; ++trial) {
        Robot robot(random_robot(random, 6, true));
        robot.set_base(random_pose(random, 3));
        robot.attach({"part", "link 5", make_box({0.1, 0.1, 0.1}), random_pose(random, 1)});
        const JointPath path = JointPath::straight(
            robot, std::vector{random_configuration(random, robot), random_configuration(random, robot),
                               random_configuration(random, robot), random_configuration(random, robot)});
        const RobotChecker::Prepared prepared(robot, nullptr, {});
        const std::array handovers{Handover{1, "part", "link 3"}, Handover{2, "part", "link 0"}};
        const robot::Stretches stretches(prepared, path, handovers);
        for (const std::size_t segment : {1U, 2U}) {
            const auto place = [&](std::size_t s, double time) {
                const robot::Model& model = stretches.at(s).model();
                const robot::SegmentMotion motion = model.motion_of(path.segments()[s]);
                const std::size_t owner = model.owner("part");
                return model.place_of(motion, model.owners[owner].group, model.owners[owner].place, time).refined;
            };
            const auto before = place(segment - 1, 1), after = place(segment, 0);
            EXPECT_LE(double(length(after.translation - before.translation)), 0x1p-92);
            EXPECT_LE(double(length((before.rotation.conjugate() * after.rotation).v)), 0x1p-92);
        }
        EXPECT_EQ(stretches.at(1).model().parts[0].link, "link 3");
        EXPECT_EQ(stretches.at(2).model().parts[0].link, "link 0");
        // the pose in doubles that a description would have: off by a rounding
        const robot::Model& last = stretches.at(2).model();
        Robot again = robot;
        again.detach("part");
        again.attach(last.parts[0]);
        const Pose expected = last.pose_of(last.motion_of(path.segments()[2]), last.owner("part"), 0);
        const Pose found = again.model().pose_of(again.model().motion_of(path.segments()[2]), last.owner("part"), 0);
        EXPECT_TRUE(found.isometry().isApprox(expected.isometry(), 1e-14));
    }
}

/// A part on the root link is picked up there, and put down again.
TEST(Handovers, TheRootLinkGivesAndTakes) {
    Robot crane = slider(0);
    crane.attach({"cube", "rail", make_box({0.2, 0.2, 0.2}), Pose({1, 0, -0.2}, {1, 0, 0, 0})});
    const auto at = [](double x) { return Configuration(Configuration::Constant(1, x)); };
    const JointPath path = JointPath::straight(crane, std::vector{at(0), at(1), at(3), at(2)});
    const std::vector<Handover> handovers{{1, "cube", "hand"}, {2, "cube", "rail"}};
    const RobotChecker checker(crane);
    EXPECT_EQ(checker.first_contact(path).pair->second, "cube") << "the hand touches it";
    const RobotAnswer clear = checker.first_contact(path, handovers);
    EXPECT_EQ(clear.verdict, Verdict::clear);
    const Scene wall = wall_at(2, 1);
    Robot held = crane;
    held.ignore_in_scene("hand", "wall");
    const RobotAnswer found = RobotChecker(held, &wall).first_contact(path, handovers);
    EXPECT_NEAR(found.time.lower, 1 + (2 - 0.1 - 1) / 2, 1e-9);
    EXPECT_EQ(found.pair->first, "cube");
}

/// A pair counts as at rest if it is so in some stretch. Carriers are ignored throughout.
TEST(Handovers, CountWhatIsNotTested) {
    const Exchange e;
    const UntestedPairs before = RobotChecker(e.cell).untested();
    const RobotAnswer answer = RobotChecker(e.cell).first_contact(e.path, std::array{e.taken});
    EXPECT_EQ(before.tested, 2U) << "both hands, and the cube with the upper one";
    EXPECT_EQ(answer.untested->tested, 1U);
    EXPECT_EQ(answer.untested->count(UntestedReason::at_rest), 1U);
    EXPECT_EQ(answer.untested->count(UntestedReason::ignored), 1U);
    EXPECT_EQ(before.total() + before.tested, answer.untested->total() + answer.untested->tested);
    // a palm above the upper hand: it moves against the cube at first, and with it later
    RobotDescription with_palm = e.upper.description();
    with_palm.links.push_back({"palm", {{make_box({0.2, 0.2, 0.2})}}});
    with_palm.joints.push_back({"fixed", JointType::fixed, "hand", "palm", Pose({0, 0, 0.5}, {1, 0, 0, 0})});
    Robot cell = Robot::together({{"lower", e.lower}, {"upper", Robot(with_palm)}});
    cell.attach(e.cell.attached()[0]);
    const RobotAnswer palm = RobotChecker(cell).first_contact(e.path, std::array{e.taken});
    EXPECT_EQ(RobotChecker(cell).untested().tested, 4U) << "the lower hand and the cube with the hand and the palm";
    EXPECT_EQ(palm.untested->tested, 2U) << "both hands, and the palm with the lower hand";
    EXPECT_EQ(palm.untested->count(UntestedReason::at_rest), 3U);
    EXPECT_EQ(std::ranges::count(palm.untested->named, "cube", &UntestedPair::second), 3);
}

TEST(Handovers, RefuseWhatDoesNotFit) {
    const Exchange e;
    const RobotChecker checker(e.cell);
    const auto refused = [&](const std::vector<Handover>& handovers) {
        return refusal([&] { (void)checker.first_contact(e.path, handovers); });
    };
    EXPECT_EQ(refused({{1.5, "cube", "upper/hand"}}),
              "handover 0: no segment of the path ends at the stamp 1.5, or it is the last one; segments end at 1, 2");
    EXPECT_EQ(refused({{3, "cube", "upper/hand"}}),
              "handover 0: no segment of the path ends at the stamp 3, or it is the last one; segments end at 1, 2");
    EXPECT_EQ(refused({{1, "ball", "upper/hand"}}), "handover 0: there is no part ball");
    EXPECT_EQ(refused({{1, "lower/hand", "upper/hand"}}), "handover 0: there is no part lower/hand");
    EXPECT_EQ(refused({e.taken, {1, "cube", "cube"}}), "handover 1: there is no link cube");
    EXPECT_EQ(refused({{1, "cube", "upper/hand", {"thumb"}}}), "handover 0: thumb is no other link or part");
    EXPECT_EQ(refused({{2, "cube", "upper/hand"}, {1, "cube", "lower/hand"}}),
              "handover 1: its stamp is earlier than that of the one before");
    const JointPath of_other = JointPath::straight(e.lower, std::array{Exchange::at(0), Exchange::at(1)});
    EXPECT_EQ(refusal([&] { (void)checker.first_contact(of_other, std::array{e.taken}); }),
              "path: belongs to a robot with another number of variables");
    const JointPath edge = JointPath::straight(e.cell, std::array{e.cell.neutral(), e.cell.neutral()});
    EXPECT_EQ(
        refusal([&] { (void)checker.profile(edge, {}, std::array{e.taken}); }),
        "handover 0: no segment of the path ends at the stamp 1, or it is the last one; the path has one segment");
}

} // namespace
} // namespace chasles::test
