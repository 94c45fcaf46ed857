// Pairs of links that can or cannot touch, against geometry and against dense sampling.
#include "chasles/robot/pair_proof.h"

#include "chasles/mesh/primitives.h"
#include "tests/robot/random_robot.h"
#include "tests/support/refusal.h"

#include <chrono>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

JointDescription joint(const std::string& name, JointType type, const std::string& parent, const std::string& child,
                       const Pose& origin, double lower, double upper, const Vector3d& axis = Vector3d::UnitZ()) {
    JointDescription made{name, type, parent, child};
    made.origin = origin;
    made.axis = axis;
    made.lower = lower;
    made.upper = upper;
    return made;
}

/// A ball on a stick of length 1 turns twice about parallel axes; a wall stands at x = 2 + gap from the first axis,
/// where the outstretched stick would have the ball at most at x = 2. The links are slabs, so all is plane geometry.
RobotDescription two_sticks(double gap) {
    const double side = 0.2;
    RobotDescription robot{"sticks"};
    robot.links = {{"wall", {{make_box({1, 6, 1}), shifted(2.5 + side / 2 + gap, 0, 0)}}},
                   {"stick"},
                   {"end", {{make_box({side, side, side}), shifted(1, 0, 0)}}}};
    robot.joints = {joint("first", JointType::revolute, "wall", "stick", Pose(), -3, 3),
                    joint("second", JointType::revolute, "stick", "end", shifted(1, 0, 0), -3, 3)};
    return robot;
}

PairProof proof_of(const RobotDescription& robot, const std::string& first, const std::string& second,
                   const PairProofOptions& options = {}) {
    for (const PairProof& proof : prove_pairs(Robot(robot), options))
        if (proof.first == first && proof.second == second)
            return proof;
    ADD_FAILURE() << first << " and " << second << " are missing";
    return {};
}

/// The corners of the end are at most sqrt(1.1^2 + 0.1^2) from the second axis, and that at 1 from the first one.
TEST(PairProof, IsRightOnBothSidesOfAClosedForm) {
    const double reach = 1 + std::hypot(1.1, 0.1);
    const double touch = reach - 2.1; // the gap at which the corner just reaches the wall
    const auto unlocked = [](double gap) {
        RobotDescription robot = two_sticks(gap);
        robot.links[1].collisions.push_back(
            {make_box({0.01, 0.01, 0.01}), shifted(0, 0, 5)}); // no neighbours through it
        return robot;
    };
    EXPECT_EQ(proof_of(unlocked(touch + 1e-3), "wall", "end").reason, PairReason::never);
    const PairProof sometimes = proof_of(unlocked(touch - 1e-3), "wall", "end");
    EXPECT_EQ(sometimes.reason, PairReason::sometimes);
    ASSERT_TRUE(sometimes.witness);
    const Robot robot(unlocked(touch - 1e-3));
    EXPECT_FALSE(RobotChecker(robot).is_clear(*sometimes.witness));
    EXPECT_EQ(proof_of(two_sticks(0), "wall", "end").reason, PairReason::adjacent)
        << "only a link without a shape is between them";
}

/// Three joints carry a small cube. It meets another one only near the upper limits of all three. Few random lines
/// along one joint go there: one in some thousand.
RobotDescription rare_contact(JointType type, double gap) {
    const double side = 0.02;
    RobotDescription robot{"rare"};
    const bool turns = type == JointType::revolute;
    const Polyhedron speck = make_box({1e-3, 1e-3, 1e-3}), cube = make_box({side, side, side});
    robot.links = {{"base"}, {"1", {{speck, shifted(0, 0, -7)}}}, {"2", {{speck, shifted(0, 0, -8)}}}, {"3", {{cube}}}};
    const double last = 1 - gap;
    // Turns about z, then about y, then about z bring the cube from (2.5, 0, 0) to limits where it is alone.
    robot.joints = {joint("j1", type, "base", "1", Pose(), 0, last, turns ? Vector3d::UnitZ() : Vector3d::UnitX()),
                    joint("j2", type, "1", "2", Pose(), 0, last, Vector3d::UnitY()),
                    joint("j3", type, "2", "3", turns ? shifted(1.5, 0, 0) : Pose(), 0, last, Vector3d::UnitZ())};
    if (turns)
        robot.links[3].collisions[0].origin = shifted(1, 0, 0);
    RobotDescription whole = robot;
    for (JointDescription& j : whole.joints)
        j.upper = 1;
    robot.links[0].collisions = {{cube, Robot(whole).link_pose("3", Configuration::Ones(3))}};
    if (turns) {
        const Pose last_link = robot.links[0].collisions[0].origin;
        robot.links[0].collisions[0].origin = Pose(last_link.isometry() * Vector3d(1, 0, 0), last_link.rotation);
    }
    return robot;
}

TEST(PairProof, FindsContactsThatRandomLinesMiss) {
    for (const JointType type : {JointType::prismatic, JointType::revolute}) {
        const PairProof near = proof_of(rare_contact(type, 0.004), "base", "3");
        EXPECT_EQ(near.reason, PairReason::sometimes);
        EXPECT_GT(near.cells, 0U) << "no random line found it";
        EXPECT_EQ(proof_of(rare_contact(type, 0.1), "base", "3").reason, PairReason::never);
    }
}

/// What a file enables is looked at, and stays enabled in the file that is written.
TEST(PairProof, ExaminesAdjacentLinksThatAreTested) {
    Robot robot(two_sticks(-0.1));
    robot.test("wall", "end");
    const std::vector<PairProof> proofs = prove_pairs(robot);
    const auto found = std::ranges::find_if(
        proofs, [](const PairProof& proof) { return proof.first == "wall" && proof.second == "end"; });
    ASSERT_NE(found, proofs.end());
    EXPECT_EQ(found->reason, PairReason::sometimes);
}

TEST(PairProof, SeesLinksThatNoJointMoves) {
    RobotDescription robot{"fixed"};
    const Polyhedron cube = make_box({1, 1, 1});
    robot.links = {{"a", {{cube}}}, {"b", {{cube, shifted(0.5, 0, 0)}}}, {"c", {{cube, shifted(3, 0, 0)}}}};
    robot.joints = {joint("ab", JointType::fixed, "a", "b", Pose(), 0, 0),
                    joint("bc", JointType::fixed, "b", "c", Pose(), 0, 0)};
    EXPECT_EQ(proof_of(robot, "a", "b").reason, PairReason::adjacent);
    EXPECT_EQ(proof_of(robot, "a", "c").reason, PairReason::never);
    robot.links[2].collisions[0].origin = shifted(0.25, 0, 0);
    EXPECT_EQ(proof_of(robot, "a", "c").reason, PairReason::always);
}

TEST(PairProof, LeavesOpenWhatHasNoLimitsOrNoTime) {
    RobotDescription robot = two_sticks(1);
    robot.links[1].collisions.push_back({make_box({0.01, 0.01, 0.01}), shifted(0, 0, 5)});
    robot.joints[0].type = JointType::prismatic;
    robot.joints[0].lower = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(proof_of(robot, "wall", "end").reason, PairReason::open);
    EXPECT_EQ(refusal([&] { (void)prove_pairs(Robot(robot), {.seconds = 0}); }), "query: seconds: must be positive");
    std::size_t calls = 0;
    const PairProofOptions stopped{.progress = [&](std::size_t, std::size_t) { return ++calls > 100; }};
    EXPECT_EQ(proof_of(two_sticks(1), "wall", "end", stopped).reason, PairReason::adjacent);
}

/// A rack follows a wheel. Within one turn it does not reach the wall at 5; within two turns it does.
TEST(PairProof, LooksAtOneTurnOnlyWhereAllJointsBetweenTheLinksRepeat) {
    const double infinity = std::numeric_limits<double>::infinity();
    const Polyhedron cube = make_box({1, 1, 1});
    RobotDescription robot{"rack"};
    robot.links = {{"base"}, {"wheel", {{cube}}}, {"rack", {{cube}}}, {"wall", {{cube, shifted(5, 0, 0)}}}};
    robot.joints = {
        joint("spin", JointType::continuous, "base", "wheel", shifted(0, 0, 9), -infinity, infinity),
        joint("slide", JointType::prismatic, "base", "rack", Pose(), -infinity, infinity, Vector3d::UnitX()),
        joint("wall", JointType::fixed, "base", "wall", Pose(), 0, 0)};
    robot.joints[1].mimic = MimicDescription{"spin", 1, 0};
    EXPECT_EQ(proof_of(robot, "rack", "wall").reason, PairReason::open);
    EXPECT_EQ(proof_of(robot, "wheel", "wall").reason, PairReason::never) << "the rack is not between them";
    robot.joints[1].type = JointType::revolute;
    robot.joints[1].mimic->multiplier = -1;
    EXPECT_EQ(proof_of(robot, "rack", "wall").reason, PairReason::never);
    robot.joints[1].mimic->multiplier = 0.5;
    EXPECT_EQ(proof_of(robot, "rack", "wall").reason, PairReason::open);
}

/// No sample may deny what is proven, and each witness touches.
TEST(PairProof, AgreesWithSamplesOfRandomRobots) {
    Random random(2301);
    std::size_t never = 0, sometimes = 0;
    for (int trial = 0; trial < 80; ++trial) {
        RobotDescription description = random_robot(random, random.integer(3, 5), false);
        for (JointDescription& j : description.joints) {
            if (j.type == JointType::planar || j.type == JointType::continuous)
                j.type = JointType::revolute;
            j.mimic.reset();
            j.origin.translation *= 0.6;
            j.lower = random.uniform(-1, 0);
            j.upper = random.uniform(0, 1);
        }
        const Robot robot(description);
        const std::vector<PairProof> proofs = prove_pairs(robot, {.seconds = 3});
        std::vector<Configuration> samples;
        for (int i = 0; i < 200; ++i) {
            Configuration values(Eigen::Index(robot.variables().size()));
            for (std::size_t k = 0; k < robot.variables().size(); ++k)
                values[Eigen::Index(k)] = random.uniform(robot.variables()[k].lower, robot.variables()[k].upper);
            samples.push_back(values);
        }
        for (const PairProof& proof : proofs) {
            Robot alone = robot; // only this pair is tested
            for (const PairProof& other : proofs)
                if (&other != &proof)
                    alone.ignore(other.first, other.second);
            alone.test(proof.first, proof.second);
            const RobotChecker checker(alone);
            const auto touches = [&](const Configuration& q) { return !checker.is_clear(q); };
            if (proof.reason == PairReason::never) {
                ++never;
                EXPECT_TRUE(std::ranges::none_of(samples, touches)) << "trial " << trial << ": " << proof.first;
            }
            if (proof.reason == PairReason::sometimes) {
                ++sometimes;
                EXPECT_TRUE(touches(*proof.witness)) << "trial " << trial << ": " << proof.first;
            }
        }
    }
    std::cout << never << " never, " << sometimes << " sometimes\n";
    EXPECT_GT(never, 10U);
    EXPECT_GT(sometimes, 10U);
}

/// They touch at the lower limit of the elbow, where all sweeps begin, and are far apart in the middle.
TEST(PairProof, AContactWhereTheSweepBeginsAndAClearPoseElsewhereAreSometimes) {
    RobotDescription arm{"arm"};
    const Polyhedron bar = make_box({0.05, 0.05, 0.9});
    arm.links = {{"base", {{make_box({0.2, 0.2, 0.2})}}},
                 {"upper", {{make_box({0.05, 0.05, 0.6}), shifted(0, 0, 0.5)}}},
                 {"fore", {{bar, shifted(0, 0, 0.5)}}}};
    constexpr double half_turn = 3.14159265;
    arm.joints = {joint("lift", JointType::revolute, "base", "upper", Pose(), -1, 1),
                  joint("elbow", JointType::revolute, "upper", "fore", shifted(0, 0.09, 0.85), -half_turn, half_turn,
                        Vector3d::UnitY())};
    const PairProof proof = proof_of(arm, "base", "fore");
    EXPECT_EQ(proof.reason, PairReason::sometimes);
    ASSERT_TRUE(proof.witness);
    EXPECT_FALSE(RobotChecker(Robot(arm)).is_clear(*proof.witness));
}

/// A rod slides and turns in a block: it sticks out on both sides, in all configurations or only in most.
RobotDescription rod_in_block(double slide) {
    RobotDescription robot{"rod"};
    const Polyhedron speck = make_box({1e-3, 1e-3, 1e-3});
    robot.links = {{"block", {{make_box({1, 1, 1})}}},
                   {"carriage", {{speck, shifted(0, 0, 7)}}},
                   {"rod", {{make_box({4, 0.2, 0.2})}}}};
    robot.joints = {joint("slide", JointType::prismatic, "block", "carriage", Pose(), -slide, slide, Vector3d::UnitX()),
                    joint("turn", JointType::revolute, "carriage", "rod", Pose(), -0.5, 0.5)};
    return robot;
}

TEST(PairProof, WhatOverlapsEverywhereIsAlways) {
    const PairProof always = proof_of(rod_in_block(0.4), "block", "rod");
    EXPECT_EQ(always.reason, PairReason::always);
    ASSERT_TRUE(always.witness);
    EXPECT_GT(always.cells, 1U);
    EXPECT_EQ(always.touching, always.tried);
    EXPECT_EQ(proof_of(rod_in_block(2.9), "block", "rod").reason, PairReason::sometimes)
        << "the rod ends 2 from its middle, and the block 0.5: from 2.5 on they are apart";
    const PairProof open = proof_of(rod_in_block(0.4), "block", "rod", {.seconds = 1e-9});
    EXPECT_EQ(open.reason, PairReason::open);
    // What is inside of a solid touches it.
    RobotDescription nested = rod_in_block(0.1);
    nested.links[2].collisions[0].shape = make_box({0.2, 0.2, 0.2});
    EXPECT_EQ(proof_of(nested, "block", "rod").reason, PairReason::always);
}

TEST(PairProof, KeepsItsTimeAndTellsItsProgress) {
    Random random(4104);
    RobotDescription description = random_robot(random, 24, false);
    for (JointDescription& joint : description.joints)
        if (joint.type == JointType::planar) {
            joint.type = JointType::revolute; // what has no limits is not examined
            joint.lower = -1;
            joint.upper = 1;
        }
    const Robot robot(description);
    std::size_t calls = 0, last = 0, pairs = 0;
    const auto start = std::chrono::steady_clock::now();
    (void)prove_pairs(robot, {.seconds = 0.2, .progress = [&](std::size_t done, std::size_t all) {
                                  ++calls;
                                  EXPECT_LE(done, all);
                                  last = done;
                                  pairs = all;
                                  return true;
                              }});
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 0.2 * 1.1 + 0.5);
    EXPECT_GT(calls, pairs) << "also while a pair is examined";
    EXPECT_EQ(last, pairs);
}

} // namespace
} // namespace chasles::test
