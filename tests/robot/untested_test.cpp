// What a checker of a robot leaves out, against a look at each pair by itself.
#include "chasles/scene/untested_pairs.h"

#include "chasles/mesh/primitives.h"
#include "tests/robot/all_pairs.h"

#include <gtest/gtest.h>
#include <set>

namespace chasles::test {
namespace {

using Reason = UntestedReason;

/// The links that no joint moves against each other have the same pose in each other's frame.
bool is_rigid(const Robot& robot, const std::string& a, const std::string& b, Random& random) {
    const auto relative = [&](const Configuration& q) {
        return (robot.link_pose(a, q).isometry().inverse() * robot.link_pose(b, q).isometry()).matrix().eval();
    };
    const Configuration one = random_configuration(random, robot, 1.9),
                        other = random_configuration(random, robot, 1.9);
    return (relative(one) - relative(other)).norm() < 1e-9;
}

TEST(RobotUntested, EachPairIsTestedOrCountedOnce) {
    Random random(4101);
    std::array<std::size_t, UntestedPairs::reasons> seen{};
    for (int round = 0; round < 100; ++round) {
        RobotDescription description = random_robot(random, random.integer(2, 9), false);
        const std::string first = description.links[0].name, last = description.links.back().name;
        description.disabled_pairs = {{first, last, "Never"}};
        Robot robot(description);
        robot.attach({"part", last, make_box({1, 1, 1}), {}, {}});
        robot.ignore(first, "part");
        const Scene world = random_world(random, random.integer(0, 4));
        if (!world.bodies().empty())
            robot.ignore_in_scene("part", "body 0");
        robot.ignore_in_scene("part", "nowhere");
        const RobotChecker checker(robot, &world);
        const UntestedPairs& untested = checker.untested();
        std::size_t tested = 0, rigid = 0, bare = 0;
        std::set<std::set<std::string>> pairs;
        std::vector<std::pair<std::string, bool>> owners{{"part", true}};
        for (const LinkDescription& link : description.links)
            owners.emplace_back(link.name, !link.collisions.empty());
        for (std::size_t a = 0; a < owners.size(); ++a)
            for (std::size_t b = a + 1; b < owners.size(); ++b) {
                const auto link_of = [&](std::size_t i) { return i == 0 ? last : owners[i].first; };
                if (!owners[a].second || !owners[b].second)
                    ++bare;
                else if (robot.is_tested(owners[a].first, owners[b].first)) {
                    ++tested;
                    pairs.insert({owners[a].first, owners[b].first});
                } else
                    rigid += link_of(a) == link_of(b) || is_rigid(robot, link_of(a), link_of(b), random);
            }
        EXPECT_EQ(robot.tested_pairs().size(), pairs.size());
        for (const auto& [first, second] : robot.tested_pairs())
            EXPECT_TRUE(pairs.contains({first, second})) << first << ", " << second;
        for (const auto& [owner, has_shapes] : owners)
            for (const SceneBody& body : world.bodies()) {
                bare += has_shapes ? 0 : 1;
                tested += has_shapes && robot.is_tested_in_scene(owner, body.name);
            }
        EXPECT_EQ(untested.tested, tested);
        EXPECT_EQ(untested.count(Reason::no_shapes), bare);
        EXPECT_EQ(untested.count(Reason::at_rest), rigid);
        EXPECT_EQ(untested.total() + untested.tested,
                  owners.size() * (owners.size() - 1) / 2 + owners.size() * world.bodies().size());
        EXPECT_EQ(untested.named.size(), untested.total() - bare);
        for (std::size_t i = 0; i < seen.size(); ++i)
            seen[i] += untested.counts[i];
        const RobotAnswer answer = checker.first_contact(robot.neutral(), robot.neutral());
        EXPECT_EQ(answer.untested.get(), checker.least_distance(robot.neutral(), robot.neutral()).untested.get());
        EXPECT_EQ(answer.untested.get(), &untested) << "computed once";
    }
    for (const Reason reason :
         {Reason::no_shapes, Reason::at_rest, Reason::adjacent, Reason::disabled, Reason::ignored})
        EXPECT_GT(seen[std::size_t(reason)], 20U);
}

/// A door that passes through its frame, which is the next link above it.
TEST(RobotUntested, ADoorIsNotTestedAgainstItsFrame) {
    RobotDescription door{"door"};
    door.links = {{"frame", {{make_box({0.2, 0.2, 0.2}), shifted(0, 0.6, 0)}}},
                  {"door", {{make_box({1, 0.1, 0.1}), shifted(0.5, 0, 0)}}},
                  {"handle"}};
    door.joints = {{"hinge", JointType::revolute, "frame", "door"}, {"screw", JointType::fixed, "door", "handle"}};
    door.joints[0].axis = Eigen::Vector3d::UnitZ();
    Robot robot(door);
    Configuration shut(1), open(1);
    shut << 0;
    open << 1.5;
    const RobotAnswer found = RobotChecker(robot).first_contact(shut, open);
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_EQ(found.untested->tested, 0U);
    ASSERT_EQ(found.untested->named.size(), 1U);
    EXPECT_EQ(found.untested->named[0].first, "frame");
    EXPECT_EQ(found.untested->named[0].second, "door");
    EXPECT_EQ(found.untested->named[0].reason, Reason::adjacent);
    EXPECT_EQ(found.untested->without_shapes, std::vector<std::string>{"handle"});
    robot.test("frame", "door");
    EXPECT_EQ(RobotChecker(robot).first_contact(shut, open).verdict, Verdict::contact);
    EXPECT_EQ(RobotChecker(robot).untested().tested, 1U);
}

} // namespace
} // namespace chasles::test
