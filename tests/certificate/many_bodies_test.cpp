// Certificates of scenes and robots are verified by the checker, which puts motions of pairs together by itself.
#include "chasles/base/invalid_input.h"
#include "chasles/motion/timed_poses.h"
#include "tests/certificate/checked.h"
#include "tests/robot/random_robot.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

/// Through the middle of the scene, so that some touch.
Motion random_motion_in_world(Random& random) {
    const Pose start = random_pose(random, 2.5);
    const Pose goal = random_goal(random, start, random.uniform(0, 2), random.uniform(0, 3));
    switch (random.integer(0, 5)) {
    case 0:
        return Motion::at_rest(start);
    case 1:
        return Motion::twist(start, goal);
    case 2:
        return Motion::at_rest(start) * Motion::hinge(Vector3d::Zero(), random_point(random, 1), {0, 2});
    case 3:
        return Motion::polynomial({start.translation, random_point(random, 2)}) * Motion::at_rest(Pose());
    default:
        return Motion::velocity(start, goal, random_point(random, 0.5));
    }
}

Motion random_track(Random& random) {
    const Pose start = random_pose(random, 2.5);
    if (random.chance(0.3))
        return Motion::at_rest(start);
    const Pose middle = random_goal(random, start, random.uniform(0, 2), 2);
    return TimedPoses::through({0, 0.25, 1}, {start, middle, random_goal(random, middle, 1, 2)},
                               random.chance(0.5) ? TimedPoses::Between::velocity : TimedPoses::Between::twist);
}

/// Bodies share shapes now and then, and not all pairs are tested.
Scene random_scene(Random& random, bool has_tracks) {
    RandomBodies bodies;
    std::vector<Polyhedron> shapes;
    for (int i = 0; i < 3; ++i)
        shapes.push_back(bodies(random));
    Scene scene;
    const int count = random.integer(2, 6);
    for (int i = 0; i < count; ++i)
        scene.add({std::to_string(i), shapes[std::size_t(random.integer(0, 2))],
                   has_tracks ? random_track(random) : random_motion_in_world(random)});
    if (count > 3)
        scene.ignore("1", "2");
    scene.set_margin("0", "1", 0.125);
    return scene;
}

std::string pair_words(std::size_t a, std::size_t b) {
    return " " + std::to_string(std::min(a, b)) + " " + std::to_string(std::max(a, b)) + "\n";
}

TEST(CertifiedScenes, AreVerified) {
    Random random(4749);
    std::map<Verdict, int> count;
    for (int round = 0; round < 150; ++round) {
        const Scene scene = random_scene(random, round % 3 == 0);
        SceneQuery query;
        query.options.margin = random.chance(0.3) ? 0.0625 : 0;
        const SceneAnswer answer = scene.first_contact(query);
        const Certificate proof = certify(scene, query);
        ASSERT_EQ(proof.missing, "") << round;
        const ::certificate::Verified verified = checked(proof);
        ASSERT_TRUE(verified.holds) << round << ": " << verified.message;
        EXPECT_TRUE(is_about(proof.text, scene, query));
        std::string verdict = word_of(answer.verdict);
        verdict.pop_back();
        const std::size_t place = proof.text.find(verdict);
        ASSERT_NE(place, std::string::npos) << round;
        if (answer.verdict != Verdict::clear) {
            const std::string line = proof.text.substr(place, proof.text.find('\n', place) - place) + "\n";
            EXPECT_TRUE(line.ends_with(pair_words(answer.contacts[0].moving, answer.contacts[0].fixed))) << line;
        }
        ++count[answer.verdict];
    }
    EXPECT_GT(count[Verdict::clear], 20);
    EXPECT_GT(count[Verdict::contact], 10);
    EXPECT_GT(count[Verdict::contact_at_start], 10);
}

TEST(CertifiedScenes, AreAboutTheirBodiesMotionsPairsAndMargins) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    Scene scene;
    scene.add({"a", cube, Motion::velocity(shifted(0, 0, 0), shifted(1, 0, 0))});
    scene.add({"b", cube, Motion::at_rest(shifted(0, 3, 0))});
    scene.add({"c", box({0.5, 0.5, 0.25}).polyhedron(), Motion::at_rest(shifted(0, -3, 0))});
    const Certificate proof = certify(scene, {});
    EXPECT_TRUE(checked(proof).holds);
    EXPECT_EQ(proof.bodies.size(), 2);
    EXPECT_NE(proof.text.find("untested 1 2\n"), std::string::npos); // both stand still
    SceneQuery other;
    other.options.margin = 0.25;
    EXPECT_FALSE(is_about(proof.text, scene, other));
    Scene changed = scene;
    changed.ignore("a", "b");
    EXPECT_FALSE(is_about(proof.text, changed, {}));
    changed = scene;
    changed.move(1, Motion::at_rest(shifted(0, 3, 0x1p-40)));
    EXPECT_FALSE(is_about(proof.text, changed, {}));
    EXPECT_TRUE(is_about(proof.text, scene, {}));
}

TEST(CertifiedScenes, TakeAnglesWhoseEndIsNoDouble) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    Scene scene;
    scene.add({"door", cube, Motion::hinge({0.1, 0, 0}, Vector3d::UnitZ(), {0.3, 1})});
    scene.add({"drawer", cube, Motion::at_rest(shifted(5, 0, 0)) * Motion::slider(Vector3d::UnitX(), {0.1, 0.2})});
    EXPECT_TRUE(checked(certify(scene, {})).holds);
}

TEST(CertifiedScenes, AskNothingOfBodiesWithoutATestedPair) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    Body two = box({0.5, 0.5, 0.5}); // with a face twice: closed, but no edge has exactly two faces
    two.faces.push_back(two.faces.front());
    two.faces.push_back({two.faces.front().rbegin(), two.faces.front().rend()});
    const Polyhedron odd = Polyhedron::from_polygons(two.vertices, two.faces);
    Scene scene;
    scene.add({"a", cube, Motion::velocity(shifted(0, 0, 0), shifted(1, 0, 0))});
    scene.add({"b", cube, Motion::at_rest(shifted(0, 3, 0))});
    scene.add({"odd", odd, Motion::at_rest(shifted(0, 6, 0))});
    EXPECT_THROW(static_cast<void>(certify(scene, {})), InvalidInput);
    scene.ignore("a", "odd");
    EXPECT_TRUE(checked(certify(scene, {})).holds);
}

TEST(CertifiedScenes, RefuseWhatTheyDoNotProve) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const auto refusal = [&](const Motion& first, const Motion& second, const SceneQuery& query) {
        Scene scene;
        scene.add({"a", cube, first});
        scene.add({"b", cube, second});
        try {
            static_cast<void>(certify(scene, query));
        } catch (const InvalidInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const Motion away = Motion::velocity(shifted(3, 0, 0), shifted(4, 0, 0)), rest = Motion::at_rest(Pose());
    const auto track = [](double middle) {
        return TimedPoses::through({0, middle, 1}, {shifted(3, 0, 0), shifted(4, 0, 0), shifted(4, 1, 0)});
    };
    SceneQuery until, hold;
    until.until = 0.5;
    hold.options.margin = 0.5;
    hold.options.hold = 0.25;
    EXPECT_EQ(refusal(away, rest, {}), "");
    EXPECT_EQ(refusal(away, rest, until), "certificate: answers with `until` are not certified");
    EXPECT_EQ(refusal(away, rest, hold), "certificate: answers with `hold` are not certified");
    EXPECT_EQ(refusal(track(0.25), track(0.5), {}),
              "certificate: a and b move by motions with stamps at different times");
    EXPECT_NE(refusal(Motion::hinge(Vector3d::Zero(), Vector3d::UnitZ(), {0, 1, 1}), rest, {}).find("certificate: a: "),
              std::string::npos);
}

/// A box on an arm that turns about z, and another arm on the first one.
Robot two_arms() {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    RobotDescription robot{"arms"};
    robot.links = {{"base"}, {"upper", {{cube, shifted(2, 0, 0)}}}, {"lower", {{cube, shifted(2, 0, 0)}}}};
    robot.joints = {{"turn", JointType::continuous, "base", "upper"}, {"bend", JointType::revolute, "upper", "lower"}};
    robot.joints[1].origin = shifted(3, 0, 1);
    for (JointDescription& joint : robot.joints)
        joint.axis = Vector3d::UnitZ();
    robot.joints[1].lower = -3;
    robot.joints[1].upper = 3;
    return Robot(robot);
}

TEST(CertifiedRobots, GoOnWhereAContinuousJointWinds) {
    const Robot robot = two_arms();
    Scene scene;
    scene.add({"post", box({0.1, 0.1, 2}).polyhedron(), Motion::at_rest(shifted(0, 9, 0))});
    const RobotChecker checker(robot, &scene);
    const std::vector<Configuration> knots{Eigen::Vector2d(2.5, 0), Eigen::Vector2d(-2.5, 0.5),
                                           Eigen::Vector2d(-0.5, 1)};
    const JointPath path = JointPath::straight(robot, knots);
    const Certificate proof = certify(checker, path);
    EXPECT_EQ(proof.missing, "");
    EXPECT_TRUE(checked(proof).holds) << checked(proof).message;
    EXPECT_TRUE(is_about(proof.text, checker, path));
    EXPECT_FALSE(is_about(proof.text, checker, JointPath::straight(robot, std::span(knots).first(2))));
}

TEST(CertifiedRobots, RefuseWhatTheyDoNotProve) {
    const Robot robot = two_arms();
    const auto refusal = [&](const JointPath& path, const Motion& motion, const QueryOptions& options) {
        Scene world;
        world.add({"post", box({0.1, 0.1, 2}).polyhedron(), motion});
        try {
            static_cast<void>(certify(RobotChecker(robot, &world, {options}), path));
        } catch (const InvalidInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::vector<Configuration> knots{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0.5), Eigen::Vector2d(0, 1)};
    const JointPath edge = JointPath::straight(robot, std::span(knots).first(2)),
                    path = JointPath::straight(robot, knots);
    const Motion rest = Motion::at_rest(shifted(0, 9, 0)), moves = Motion::twist(shifted(0, 9, 0), shifted(1, 9, 0));
    EXPECT_EQ(refusal(path, rest, {}), "");
    EXPECT_EQ(refusal(edge, moves, {}), "");
    EXPECT_EQ(refusal(path, moves, {}), "certificate: post: moves, while the path or the motion has several segments");
    EXPECT_EQ(refusal(path, rest, {.margin = 0.5, .hold = 0.25}), "certificate: answers with `hold` are not certified");
    EXPECT_NE(refusal(path, rest, {.find = Find::any}).find("certificate: answers of yes or no"), std::string::npos);
    const std::vector<double> times{0, 1};
    const JointPath cubic = JointPath::cubic(robot, times, std::span(knots).first(2), std::span(knots).last(2));
    EXPECT_EQ(refusal(cubic, rest, {}), "certificate: the path is not straight in joint space");
}

TEST(CertifiedRobots, AreVerified) {
    Random random(4750);
    std::map<Verdict, int> count;
    for (int round = 0; round < 90; ++round) {
        Robot robot(random_robot(random, random.integer(2, 6), false));
        robot.set_base(random_pose(random, 1));
        RandomBodies bodies;
        Scene scene;
        for (int i = 0; i < random.integer(0, 3); ++i)
            scene.add({"body " + std::to_string(i), bodies(random), Motion::at_rest(random_pose(random, 4))});
        const std::size_t segments = round % 3 == 0 ? 3 : 1;
        const RobotChecker checker(robot, &scene);
        std::vector<Configuration> path{random_configuration(random, robot)};
        for (int i = 0; i < 10 && !checker.is_clear(path.front()); ++i)
            path.front() = random_configuration(random, robot);
        while (path.size() <= segments)
            path.push_back(path.back() + 0.5 * random_configuration(random, robot));
        const JointPath joint_path = JointPath::straight(robot, path);
        const RobotAnswer answer = checker.first_contact(joint_path);
        if (bodies_of(checker).size() < 2)
            continue;
        const Certificate proof = certify(checker, joint_path);
        ASSERT_EQ(proof.missing, "") << round;
        const ::certificate::Verified verified = checked(proof);
        ASSERT_TRUE(verified.holds) << round << ": " << verified.message << proof.text;
        EXPECT_TRUE(is_about(proof.text, checker, joint_path));
        EXPECT_EQ(proof.text.find("verdict clear\n") != std::string::npos, answer.verdict == Verdict::clear);
        ++count[answer.verdict];
    }
    EXPECT_GT(count[Verdict::clear], 10);
    EXPECT_GT(count[Verdict::contact], 5);
    EXPECT_GT(count[Verdict::contact_at_start], 2);
}

} // namespace
} // namespace chasles::test
