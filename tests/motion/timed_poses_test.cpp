// Tracks of poses with time stamps.
#include "chasles/motion/timed_poses.h"

#include "chasles/base/invalid_input.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

const std::vector<double> stamps{-3, 1.5, 2, 10};

std::vector<Pose> random_track(Random& random) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < stamps.size(); ++i)
        poses.push_back(random_pose(random, 2));
    return poses;
}

TEST(TimedPoses, GoesThroughItsPosesAtTheirStamps) {
    Random random(1831);
    const std::vector<Pose> poses = random_track(random);
    for (const auto between : {TimedPoses::Between::velocity, TimedPoses::Between::twist}) {
        const TimedPoses track = TimedPoses::through(stamps, poses, between, {0.3, 0, 0});
        for (std::size_t i = 0; i < stamps.size(); ++i)
            EXPECT_TRUE(track.pose_at(track.time_of(stamps[i])).isometry().isApprox(poses[i].isometry(), 1e-13));
        const double inside = track.time_of(4); // a quarter of the last segment
        const Motion last = between == TimedPoses::Between::velocity ? Motion::velocity(poses[2], poses[3], {0.3, 0, 0})
                                                                     : Motion::twist(poses[2], poses[3]);
        EXPECT_TRUE(track.pose_at(inside).isometry().isApprox(last.pose_at(0.25).isometry(), 1e-13));
    }
}

TEST(TimedPoses, TellsStampsAndSegments) {
    Random random(1832);
    const TimedPoses track = TimedPoses::through(stamps, random_track(random));
    const Bracket stamp = track.stamp_of({0.5, 0.75});
    EXPECT_LE(stamp.lower, 3.5);
    EXPECT_GE(stamp.lower, 3.5 - 1e-14);
    EXPECT_GE(stamp.upper, 6.75);
    EXPECT_LE(stamp.upper, 6.75 + 1e-14);
    EXPECT_EQ(track.stamp_of({0, 1}).lower, -3);
    EXPECT_EQ(track.stamp_of({0, 1}).upper, 10);
    EXPECT_EQ(track.segment_of(0), 0u);
    EXPECT_EQ(track.segment_of(track.time_of(1.5)), 0u);
    EXPECT_EQ(track.segment_of(track.time_of(1.75)), 1u);
    EXPECT_EQ(track.segment_of(1), 2u);
}

TEST(TimedPoses, RefusesStampsThatCannotBeUsed) {
    const std::vector<Pose> two(2), three(3);
    EXPECT_EQ(refusal([] { (void)TimedPoses::through({0}, {Pose()}); }), "timed poses: poses: at least two are needed");
    EXPECT_EQ(refusal([&] {
                  (void)TimedPoses::through({0, 1, 2}, two);
              }),
              "timed poses: stamps: there are 3 for 2 poses");
    EXPECT_EQ(refusal([&] {
                  (void)TimedPoses::through({0, 2, 1}, three);
              }),
              "timed poses: stamps: must ascend, but stamp 2 is 1 after 2");
    EXPECT_EQ(refusal([&] {
                  (void)TimedPoses::through({0, NAN, 1}, three);
              }),
              "timed poses: stamps: stamp 1 is NaN or infinite");
    EXPECT_NE(refusal([&] { (void)TimedPoses::through({-1e308, 1e308}, two); }), "accepted");
    EXPECT_NE(refusal([&] {
                  (void)TimedPoses::through({0, 1}, two, TimedPoses::Between::velocity, {NAN, 0, 0});
              }),
              "accepted");
}

} // namespace
} // namespace chasles::test
