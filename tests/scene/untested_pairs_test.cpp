// What a scene leaves out, against a look at each pair by itself.
#include "chasles/scene/untested_pairs.h"

#include "chasles/mesh/primitives.h"
#include "chasles/motion/timed_poses.h"
#include "chasles/scene/scene.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <set>

namespace chasles::test {
namespace {

using NamePair = std::pair<std::string, std::string>;
using Reason = UntestedReason;

Motion standing(double x) {
    return Motion::at_rest(Pose({x, 0, 0}, Eigen::Quaterniond::Identity()));
}

Motion going(double x, double to) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    return Motion::velocity(Pose({x, 0, 0}, turn), Pose({to, 0, 0}, turn));
}

/// Cubes in a row, and what the test knows about them.
struct KnownScene {
    Scene scene;
    std::vector<std::string> names, groups;
    std::vector<bool> at_rest;
    std::set<NamePair> ignored, ignored_groups;

    void add(Random& random, int index) {
        static const std::array<std::string, 4> all{"", "left", "right", "floor"};
        names.push_back("body " + std::to_string((index * 7919) % 1000));
        groups.push_back(all[std::size_t(random.integer(0, 3))]);
        at_rest.push_back(random.chance(0.5));
        scene.add({names.back(), make_box({1, 1, 1}), at_rest.back() ? standing(3 * index) : going(3 * index, -1),
                   groups.back()});
    }
    void ignore(std::size_t a, std::size_t b) {
        scene.ignore(names[a], names[b]);
        ignored.insert(std::minmax(names[a], names[b]));
    }
    [[nodiscard]] std::optional<Reason> reason_of(std::size_t a, std::size_t b, bool asks_at_rest) const {
        if (ignored.contains(std::minmax(names[a], names[b])) ||
            ignored_groups.contains(std::minmax(groups[a], groups[b])))
            return Reason::ignored;
        return at_rest[a] && at_rest[b] && !asks_at_rest ? std::optional(Reason::at_rest) : std::nullopt;
    }
};

KnownScene random_scene(Random& random, int count) {
    KnownScene known;
    for (int i = 0; i < count; ++i)
        known.add(random, i);
    for (int i = 0; i < count / 2; ++i)
        if (const auto a = std::size_t(random.integer(0, count - 1)), b = std::size_t(random.integer(0, count - 1));
            a != b)
            known.ignore(a, b);
    for (const NamePair& pair : {NamePair("left", "right"), NamePair("floor", "floor"), NamePair("", "floor")})
        if (random.chance(0.4)) {
            known.scene.ignore_groups(pair.second, pair.first);
            known.ignored_groups.insert(pair);
        }
    return known;
}

TEST(UntestedPairs, EachPairIsTestedOrCountedOnceAndNamed) {
    Random random(4101);
    int ignored = 0, at_rest = 0;
    for (int round = 0; round < 200; ++round) {
        const int count = random.integer(0, 14);
        const KnownScene known = random_scene(random, count);
        const double until = random.chance(0.3) ? 0 : 1;
        const UntestedPairs untested = known.scene.untested({.until = until});
        std::map<Reason, std::set<NamePair>> expected;
        std::size_t tested = 0;
        for (std::size_t a = 0; a < known.names.size(); ++a)
            for (std::size_t b = a + 1; b < known.names.size(); ++b)
                if (const auto reason = known.reason_of(a, b, until == 0))
                    expected[*reason].insert(std::minmax(known.names[a], known.names[b]));
                else
                    ++tested;
        EXPECT_EQ(untested.tested, tested);
        std::map<Reason, std::set<NamePair>> named;
        for (const UntestedPair& pair : untested.named)
            EXPECT_TRUE(named[pair.reason].emplace(pair.first, pair.second).second) << "named twice";
        EXPECT_EQ(named, expected);
        for (const Reason reason : {Reason::ignored, Reason::at_rest})
            EXPECT_EQ(untested.count(reason), expected[reason].size());
        ignored += int(untested.count(Reason::ignored));
        at_rest += int(untested.count(Reason::at_rest));
    }
    EXPECT_GT(ignored, 1000);
    EXPECT_GT(at_rest, 800);
}

TEST(UntestedPairs, AreCountedInLargeScenesAndNamedUpToABound) {
    Scene scene;
    const Polyhedron cube = make_box({1, 1, 1});
    constexpr std::size_t count = 3000;
    for (std::size_t i = 0; i < count; ++i)
        scene.add({std::to_string(i), cube, standing(2 * double(i)), i % 2 == 0 ? "even" : "odd"});
    scene.add({"moving", cube, going(-2, -3)});
    scene.ignore_groups("even", "even");
    const SceneAnswer answer = scene.first_contact();
    const std::size_t half = count / 2, evens = half * (half - 1) / 2;
    EXPECT_EQ(answer.untested.count(Reason::ignored), evens);
    EXPECT_EQ(answer.untested.count(Reason::at_rest), count * (count - 1) / 2 - evens);
    EXPECT_EQ(answer.untested.tested, count);
    EXPECT_EQ(scene.untested().counts, answer.untested.counts);
    EXPECT_EQ(scene.untested().named.size(), 2 * UntestedPairs::most_named);
    EXPECT_EQ(scene.all_contacts().untested.tested, count);
}

/// Tiles lie side by side, and a body slides along above them.
TEST(UntestedPairs, BodiesThatStandStillAreNoQuestionAboutMotion) {
    Scene scene;
    const Polyhedron cube = make_box({1, 1, 1});
    for (int i = 0; i < 5; ++i)
        scene.add({"tile " + std::to_string(i), cube, standing(i)});
    scene.add({"body", cube, going(9, 4.5)});
    const SceneAnswer found = scene.first_contact();
    ASSERT_EQ(found.contacts.size(), 1U);
    EXPECT_EQ(found.verdict, Verdict::contact);
    EXPECT_EQ(scene.bodies()[found.contacts[0].fixed].name, "tile 4");
    EXPECT_EQ(found.untested.count(Reason::at_rest), 10U);
    EXPECT_EQ(scene.all_contacts().contacts.size(), 1U);
    EXPECT_EQ(scene.clear_until()[0], 1) << "of a tile far away";
    const SceneAnswer start = scene.all_contacts({.until = 0});
    EXPECT_EQ(start.contacts.size(), 4U) << "a question about the start";
    EXPECT_EQ(start.untested.total(), 0U);
    scene.move(1, going(1, 1.1));
    EXPECT_EQ(scene.first_contact().verdict, Verdict::contact_at_start) << "this tile moves";
    EXPECT_EQ(scene.untested().count(Reason::at_rest), 6U);
}

/// A body may stand still by any motion.
TEST(UntestedPairs, BodiesThatStandStillByTheirPosesAreAtRest) {
    const Pose place({0.5, 0.25, 0}, Eigen::Quaterniond(0.8, 0, 0.6, 0));
    const std::vector<Pose> poses(3, place);
    const std::vector<Motion> still = {Motion::velocity(place, place),
                                       Motion::twist(place, place),
                                       TimedPoses::through({0, 0.3, 1}, poses),
                                       TimedPoses::through({0, 0.3, 1}, poses, TimedPoses::Between::twist),
                                       Motion::spline({0, 0.3, 1}, poses),
                                       Motion::slider({1, 0, 0}, {0.5}),
                                       Motion::polynomial({{1, 2, 3}, {0, 0, 0}}),
                                       Motion::hinge({1, 2, 3}, {0, 0, 1}, {0.3})};
    for (std::size_t i = 0; i < still.size(); ++i) {
        Scene scene;
        scene.add({"still", make_box({1, 1, 1}), still[i]});
        scene.add({"tile", make_box({1, 1, 1}), Motion::at_rest(still[i].pose_at(0))});
        EXPECT_EQ(scene.untested().count(Reason::at_rest), 1U) << i;
        EXPECT_EQ(scene.first_contact().verdict, Verdict::clear) << i;
    }
    Scene scene;
    scene.add({"going and coming", make_box({1, 1, 1}),
               TimedPoses::through({0, 0.5, 1}, {Pose(), Pose({0, 0, 1}, Eigen::Quaterniond::Identity()), Pose()})});
    scene.add({"tile", make_box({1, 1, 1}), standing(0)});
    EXPECT_EQ(scene.untested().count(Reason::at_rest), 0U);
}

TEST(UntestedPairs, WhatTouchesAtTheStartIsIgnoredAndNamed) {
    Scene scene;
    const Polyhedron cube = make_box({1, 1, 1});
    scene.add({"plate", cube, standing(0)});
    scene.add({"screw", cube, going(0.9, 1.5)});
    scene.add({"nut", cube, standing(2.05)});
    scene.add({"washer", cube, standing(3.05)});
    using Pairs = std::vector<NamePair>;
    EXPECT_EQ(scene.ignore_touching_at_start(), Pairs({{"nut", "washer"}, {"plate", "screw"}}));
    EXPECT_EQ(scene.untested().count(Reason::touching_at_start), 2U);
    EXPECT_EQ(scene.untested().count(Reason::at_rest), 2U) << "the plate with nut and washer";
    EXPECT_EQ(scene.first_contact().verdict, Verdict::contact) << "the screw goes on to the nut";
    EXPECT_EQ(scene.ignore_touching_at_start(0.2), Pairs({{"nut", "screw"}}));
    EXPECT_EQ(scene.first_contact().verdict, Verdict::clear);
    scene.move(3, going(3.05, 2.3));
    EXPECT_EQ(scene.first_contact().verdict, Verdict::contact) << "the washer comes to the screw";
    EXPECT_TRUE(scene.is_ignored(2, 3));
    scene.remove("nut");
    EXPECT_EQ(scene.untested().count(Reason::touching_at_start), 1U);
    EXPECT_EQ(refusal([&] { (void)scene.ignore_touching_at_start(-1); }), "query: margin: must be in [0, 1e30]");
}

} // namespace
} // namespace chasles::test
