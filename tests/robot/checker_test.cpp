// Questions about paths of robots, against every pair by itself along products of public motions.
#include "chasles/robot/robot.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "tests/robot/all_pairs.h"
#include "tests/robot/arm_beside_a_wall.h"
#include "tests/support/refusal.h"

#include <chrono>
#include <functional>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

struct Contacts {
    Bracket earliest{2, 2};
    bool is_certain = true;
    std::size_t count = 0;
    bool at_start = false;

    void add(const FirstContact& found) {
        if (found.verdict == Verdict::clear)
            return;
        ++count;
        at_start = at_start || found.verdict == Verdict::contact_at_start;
        if (found.time.lower < earliest.lower) {
            earliest = found.time;
            is_certain = found.certain;
        }
    }
};

Contacts contacts_of_all_pairs(const Robot& robot, const Scene& scene, const Configuration& start,
                               const Configuration& goal, const QueryOptions& options) {
    Contacts contacts;
    for_each_pair(robot, scene, {start, goal}, [&](const Polyhedron& a, const Polyhedron& b, const Motion& motion) {
        contacts.add(first_contact({a, b, motion, options}));
    });
    return contacts;
}

TEST(RobotChecker, AnswersAsAllPairsByThemselves) {
    Random random(2002);
    std::size_t clear = 0, at_start = 0, later = 0, uncertain = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        Robot robot(random_robot(random, random.integer(2, 8), random.chance(0.2)));
        robot.set_base(random_pose(random, 2));
        const Scene scene = random_world(random, random.chance(0.1) ? 60 : random.integer(0, 12));
        const Configuration start = random_configuration(random, robot, 3);
        Configuration goal = start + random_configuration(random, robot, 1) * random.uniform(0.02, 1);
        QueryOptions options;
        options.margin = random.chance(0.3) ? random.uniform(0, 0.1) : 0;
        const Contacts expected = contacts_of_all_pairs(robot, scene, start, goal, options);
        const RobotChecker checker(robot, &scene, {options});
        const RobotAnswer found = checker.first_contact(start, goal);
        ASSERT_EQ(found.verdict == Verdict::clear, expected.count == 0) << "trial " << trial;
        EXPECT_EQ(checker.is_clear(start, goal), expected.count == 0);
        if (expected.count == 0) {
            ++clear;
            EXPECT_EQ(found.clear_until, 1);
            EXPECT_TRUE(found.certain);
            continue;
        }
        EXPECT_EQ(found.verdict == Verdict::contact_at_start, expected.at_start) << "trial " << trial;
        at_start += expected.at_start;
        later += !expected.at_start;
        uncertain += !found.certain;
        EXPECT_LE(found.time.lower, expected.earliest.upper + 1e-12) << "trial " << trial;
        EXPECT_GE(found.time.upper, expected.earliest.lower - 1e-12) << "trial " << trial;
        EXPECT_LE(found.clear_until, found.time.lower);
    }
    std::cout << clear << " clear, " << at_start << " touch at the start, " << later << " later, " << uncertain
              << " not certain\n";
    EXPECT_GT(clear, 50U);
    EXPECT_GT(later, 60U);
}

TEST(RobotChecker, WhatIsProvenUntilALimitIsTrue) {
    Random random(2003);
    int unknown = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Robot robot(random_robot(random, 8, false));
        const Scene scene = random_world(random, 60);
        const RobotChecker checker(robot, &scene);
        std::vector<Configuration> way;
        for (int i = 0; i < 4; ++i)
            way.push_back(random_configuration(random, robot, 3));
        const JointPath path = JointPath::straight(robot, way);
        const auto start = std::chrono::steady_clock::now();
        const RobotAnswer whole = checker.first_contact(path);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        const Limit limit(random.uniform(0.01, 0.9) * took.count());
        const RobotAnswer found = checker.first_contact(path);
        if (found.verdict != Verdict::unknown)
            continue;
        ++unknown;
        EXPECT_FALSE(found.pair);
        EXPECT_LE(found.clear_until, whole.clear_until);
        EXPECT_LE(found.segment, whole.segment);
        EXPECT_EQ(found.time.lower, found.clear_until);
    }
    EXPECT_GT(unknown, 50);
    const Robot robot(random_robot(random, 8, false));
    const Scene scene = random_world(random, 200);
    const RobotChecker checker(robot, &scene);
    const Configuration a = random_configuration(random, robot, 3), b = random_configuration(random, robot, 3);
    const bool is_clear = checker.is_clear(a, b);
    const Limit limit(1e-9);
    try {
        EXPECT_EQ(checker.is_clear(a, b), is_clear);
    } catch (const Cancelled&) { // the only other answer
    }
}

/// Boxes settle every segment, and a path may have thousands.
TEST(RobotChecker, ALimitEndsAPathFarFromEverything) {
    const Robot robot = arm_beside_a_wall();
    const Scene scene = wall_at(50);
    const RobotChecker checker(robot, &scene);
    const JointPath path = JointPath::straight(robot, std::array{values(0, 0), values(0.1, 0), values(0, 0.1)});
    EXPECT_EQ(checker.first_contact(path).verdict, Verdict::clear);
    const Limit limit(1e-9);
    const RobotAnswer found = checker.first_contact(path);
    EXPECT_EQ(found.verdict, Verdict::unknown);
    EXPECT_EQ(found.segment, 1U);
    EXPECT_EQ(found.clear_until, 1);
    EXPECT_EQ(checker.least_distance(path).distance.lower, 0);
}

/// Without them nothing touches at the start, and with any of them something does.
TEST(RobotChecker, NamesAllPairsInContact) {
    Random random(2005);
    int several = 0;
    for (int trial = 0; trial < 100; ++trial) {
        Robot robot(random_robot(random, 6, false));
        const Scene scene = random_world(random, 30);
        const Configuration q = random_configuration(random, robot, 2);
        const std::vector<RobotPair> pairs = RobotChecker(robot, &scene).pairs_in_contact(q);
        several += pairs.size() > 1 ? 1 : 0;
        for (const RobotPair& pair : pairs) {
            EXPECT_EQ(RobotChecker(robot, &scene).first_contact(q, q).verdict, Verdict::contact_at_start);
            if (pair.is_with_scene)
                robot.ignore_in_scene(pair.first, pair.second);
            else
                robot.ignore(pair.first, pair.second);
        }
        EXPECT_NE(RobotChecker(robot, &scene).first_contact(q, q).verdict, Verdict::contact_at_start)
            << "bodies may move";
    }
    EXPECT_GT(several, 10);
}

TEST(RobotChecker, WhatIsRefusedNamesThePair) {
    Random random(2006);
    const Robot robot(random_robot(random, 4, false));
    const Polyhedron body = robot.shape(robot.neutral());
    Scene scene;
    scene.add({"comet", body,
               Motion::velocity(Pose({0, 0, -1e14}, Eigen::Quaterniond::Identity()),
                                Pose({1, 2, 1e14}, Eigen::Quaterniond(1, 1, 0, 0)))});
    const RobotChecker checker(robot, &scene);
    const Configuration q = robot.neutral();
    for (const auto& ask : std::vector<std::function<void()>>{[&] { (void)checker.first_contact(q, q); },
                                                              [&] { (void)checker.least_distance(q, q); }}) {
        const std::string message = refusal(ask);
        EXPECT_TRUE(message.starts_with("robot: ")) << message;
        EXPECT_NE(message.find(" and comet: motion: goes up to "), std::string::npos) << message;
    }
}

TEST(RobotChecker, ALeastDistanceThatIsCutIsABracket) {
    Random random(2004);
    int cut = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Robot robot(random_robot(random, 8, false));
        const Scene scene = random_world(random, 60);
        const RobotChecker checker(robot, &scene);
        const Configuration a = random_configuration(random, robot, 3), b = random_configuration(random, robot, 3);
        const auto start = std::chrono::steady_clock::now();
        const RobotClearance whole = checker.least_distance(a, b);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        const Limit limit(random.chance(0.5) ? 1e-9 : random.uniform(0.01, 0.9) * took.count());
        const RobotClearance found = checker.least_distance(a, b);
        EXPECT_LE(found.distance.lower, whole.distance.upper);
        EXPECT_GE(found.distance.upper, whole.distance.lower);
        cut += found.certain ? 0 : 1;
    }
    EXPECT_GT(cut, 5);
}

TEST(RobotChecker, AnswersManyEdgesTheSameForAnyNumberOfThreads) {
    Random random(2003);
    const Robot robot(random_robot(random, 6, false));
    const Scene scene = random_world(random, 20);
    const auto edges = Eigen::Index(50);
    Eigen::MatrixXd starts(edges, robot.variables().size()), goals = starts;
    for (Eigen::Index i = 0; i < edges; ++i) {
        starts.row(i) = random_configuration(random, robot, 2);
        goals.row(i) = random_configuration(random, robot, 2);
    }
    const RobotChecker checker(robot, &scene);
    const std::vector<RobotAnswer> one = checker.first_contacts(starts, goals, 1);
    const std::vector<RobotAnswer> many = checker.first_contacts(starts, goals, 3);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].verdict, many[i].verdict);
        EXPECT_EQ(one[i].time.lower, many[i].time.lower);
        EXPECT_EQ(one[i].time.upper, many[i].time.upper);
    }
    goals(7, 0) = std::nan("");
    EXPECT_NE(refusal([&] { (void)checker.first_contacts(starts, goals); }).find("edge 7: path: configuration 1: "),
              std::string::npos);
}

/// A door that opens during a path of two segments lets the robot through in the second one only.
TEST(RobotChecker, BodiesOfTheSceneMoveDuringTheWholePath) {
    RobotDescription description{"slide"};
    description.links = {{"base"}, {"cube", {{box({0.1, 0.1, 0.1}).polyhedron(), Pose()}}}};
    description.joints = {{"way", JointType::prismatic, "base", "cube"}};
    description.joints[0].axis = Eigen::Vector3d::UnitX();
    const Robot robot(description);
    Scene scene; // the face of the door is at x = 0.5 + 2 t
    scene.add({"door", box({0.1, 3, 3}).polyhedron(), Motion::velocity(shifted(0.6, 0, 0), shifted(2.6, 0, 0))});
    const auto at = [](double way) { return Configuration(Configuration::Constant(1, way)); };
    const RobotChecker checker(robot, &scene);
    const RobotAnswer clear = checker.first_contact(JointPath::straight(robot, std::array{at(0), at(0), at(1.9)}));
    EXPECT_EQ(clear.verdict, Verdict::clear);
    // The face is at 0.1 + 3 s in the second segment, the door's at 1.5 + s: they meet at s = 0.7.
    const RobotAnswer found = checker.first_contact(JointPath::straight(robot, std::array{at(0), at(0), at(3)}));
    EXPECT_EQ(found.segment, 1U);
    EXPECT_NEAR(found.contact.time.lower, 0.7, 1e-12);
}

/// Whatever Find::any names, nothing touches before its clear_until, and it names a contact.
TEST(RobotChecker, AnyContactClaimsNoTimeThatWasNotAsked) {
    Random random(2005);
    std::size_t later = 0, other = 0;
    for (int trial = 0; trial < 800; ++trial) {
        const Robot robot(random_robot(random, random.integer(3, 8), false));
        const Scene scene = random_world(random, random.integer(2, 12));
        const Configuration start = random_configuration(random, robot, 2);
        const Configuration goal = start + random_configuration(random, robot, 1);
        QueryOptions options;
        const Contacts expected = contacts_of_all_pairs(robot, scene, start, goal, options);
        options.find = Find::any;
        const RobotAnswer found = RobotChecker(robot, &scene, {options}).first_contact(start, goal);
        ASSERT_EQ(found.verdict == Verdict::clear, expected.count == 0) << "trial " << trial;
        if (expected.count == 0)
            continue;
        EXPECT_LE(found.clear_until, expected.earliest.upper + 1e-12) << "trial " << trial;
        EXPECT_GE(found.time.upper, expected.earliest.lower - 1e-12) << "trial " << trial;
        later += expected.earliest.lower > 0;
        other += found.time.lower > expected.earliest.upper;
    }
    EXPECT_GT(later, 50U);
    EXPECT_GT(other, 5U) << "another contact than the first one is named";
}

/// Three links in a row; the last joint follows the first one.
Robot mimicking_robot(double multiplier, JointType type) {
    RobotDescription robot{"follower"};
    robot.links = {{"base"}, {"a"}, {"b", {{box({1, 1, 1}).polyhedron(), Pose()}}}};
    JointDescription follower{"follower", type, "a", "b"};
    follower.mimic = MimicDescription{"leader", multiplier};
    robot.joints = {{"leader", JointType::prismatic, "base", "a"}, follower};
    return Robot(robot);
}

TEST(RobotChecker, RefusesPathsThatItCannotFollow) {
    Random random(2006);
    const Robot robot(random_robot(random, 4, false)), other(random_robot(random, 6, false));
    const Configuration zero = other.neutral();
    const JointPath path = JointPath::straight(other, std::array{zero, zero});
    ASSERT_NE(robot.variables().size(), other.variables().size());
    EXPECT_EQ(refusal([&] { (void)RobotChecker(robot).first_contact(path); }),
              "path: belongs to a robot with another number of variables");
    const auto moved = [](const Robot& follower) {
        Scene scene;
        scene.add({"body", box({1, 1, 1}).polyhedron(), Motion::at_rest(Pose())});
        const Configuration start = Configuration::Zero(1), goal = Configuration::Constant(1, 900);
        return refusal([&] { (void)RobotChecker(follower, &scene).first_contact(start, goal); });
    };
    const std::string too_far = "robot: leader: moves a joint too far: by more than 2000 radians, or 1e30";
    EXPECT_EQ(moved(mimicking_robot(3, JointType::revolute)), too_far);
    EXPECT_EQ(moved(mimicking_robot(1e28, JointType::prismatic)), too_far);
    EXPECT_EQ(moved(mimicking_robot(2, JointType::revolute)), "accepted");
}

/// The numbers of a path are those of its robot's joints, and its ways round, too.
TEST(RobotChecker, RefusesPathsOfOtherRobots) {
    const auto arm = [](const std::string& name, JointType type) {
        RobotDescription robot{"arm"};
        robot.links = {{"base"}, {"a"}, {"b"}};
        robot.joints = {{"waist", JointType::revolute, "base", "a"}, {name, type, "a", "b"}};
        return Robot(robot);
    };
    const Robot robot = arm("elbow", JointType::continuous);
    const auto refused = [&](const Robot& other) {
        const Configuration start{{0.0, 3.0}}, goal{{0.0, -3.0}};
        const JointPath path = JointPath::straight(other, std::array{start, goal});
        const std::string message = refusal([&] { (void)RobotChecker(robot).first_contact(path); });
        EXPECT_EQ(refusal([&] { (void)RobotChecker(robot).least_distance(path); }), message);
        return message;
    };
    EXPECT_EQ(refused(arm("wrist", JointType::continuous)),
              "path: belongs to another robot: variable 1 is 'wrist' in the path, and 'elbow' in the robot");
    EXPECT_EQ(
        refused(arm("elbow", JointType::revolute)),
        "path: belongs to another robot: variable 1 is 'elbow' in both, but the path goes straight, and the robot "
        "the shorter way round");
    EXPECT_EQ(refused(arm("elbow", JointType::continuous)), "accepted") << "the same robot, read once more";
    Robot changed = robot;
    changed.set_base(Pose({1, 2, 3}, Eigen::Quaterniond::Identity()));
    EXPECT_EQ(refused(changed), "accepted");
}

/// A path of several segments is asked segment by segment, and the scene goes on during it.
TEST(RobotChecker, FollowsAPathFromSegmentToSegment) {
    Random random(2004);
    std::size_t late = 0;
    for (int trial = 0; trial < 150; ++trial) {
        const Robot robot(random_robot(random, 5, false));
        const Scene scene = random_world(random, 8);
        std::vector<Configuration> way{random_configuration(random, robot, 2)};
        std::vector<double> times{random.uniform(-5, 5)};
        for (int i = 0; i < 4; ++i) {
            way.push_back(way.back() + random_configuration(random, robot, 0.3));
            times.push_back(times.back() + random.uniform(0.1, 2));
        }
        const RobotChecker checker(robot, &scene);
        const RobotAnswer found = checker.first_contact(JointPath::straight(robot, way, times));
        if (found.verdict == Verdict::clear) {
            EXPECT_EQ(found.segment, 3U);
            EXPECT_EQ(found.clear_until, times.back());
            EXPECT_LT((found.configuration - way.back()).norm(), 1e-12);
            continue;
        }
        late += found.segment > 0;
        EXPECT_GE(found.time.lower, times[found.segment]);
        EXPECT_LE(found.time.upper, times[found.segment + 1]);
        // Where no body of the scene moves, each segment may be asked by itself.
        if (std::ranges::any_of(scene.bodies(), [](const SceneBody& body) {
                return body.motion.pose_at(0).isometry().matrix() != body.motion.pose_at(1).isometry().matrix();
            }))
            continue;
        for (std::size_t i = 0; i < found.segment; ++i)
            EXPECT_TRUE(checker.is_clear(way[i], way[i + 1]));
        const RobotAnswer alone = checker.first_contact(way[found.segment], way[found.segment + 1]);
        ASSERT_NE(alone.verdict, Verdict::clear);
        const double duration = times[found.segment + 1] - times[found.segment];
        EXPECT_NEAR(times[found.segment] + alone.time.lower * duration, found.time.lower, 1e-9);
        EXPECT_EQ(alone.pair->first, found.pair->first);
        EXPECT_EQ(alone.pair->second, found.pair->second);
    }
    EXPECT_GT(late, 5U);
}

} // namespace
} // namespace chasles::test
