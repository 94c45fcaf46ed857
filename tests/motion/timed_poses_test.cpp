// Tracks of poses with time stamps.
#include "chasles/motion/timed_poses.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/smooth_trajectory.h"
#include "chasles/motion/splines.h"
#include "tests/support/long_poses.h"
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
    EXPECT_EQ(track.stamp_of({0, 0}).upper, -3) << "the ends are exact";
    EXPECT_EQ(track.stamp_of({1, 1}).lower, 10);
    EXPECT_EQ(track.stamp_of({0, 1}).upper, 10);
    EXPECT_EQ(track.segment_of(0), 0u);
    EXPECT_EQ(track.segment_of(track.time_of(1.5)), 0u);
    EXPECT_EQ(track.segment_of(track.time_of(1.75)), 1u);
    EXPECT_EQ(track.segment_of(1), 2u);
}

/// The distance of a point's place at the start of an enclosure from its true place, over the bound.
template <class S>
double ratio_to_bound(const motion::Enclosure<S>& enclosure, const Eigen::Vector3d& point, const LongVector& truth) {
    const auto digits = [](const S& number) {
        if constexpr (std::is_same_v<S, double>)
            return Digits(number);
        else
            return Digits(number.high()) + Digits(number.low());
    };
    const auto there = enclosure.cubic.orientation * motion::vector_in<S>(point) + enclosure.cubic.origin;
    const LongVector place(digits(there.x), digits(there.y), digits(there.z));
    return double((place - truth).norm()) / enclosure.bounds.deviation_of({point, 0});
}

/// How much of their bounds the enclosures of the second segment need, in double and in double-double.
std::array<double, 2> ratios_in_second_segment(Random& random, const std::vector<Pose>& poses,
                                               const std::vector<double>& times) {
    const motion::SmoothTrajectory trajectory(motion::SmoothMotion::of_one(
        motion::even_track(times, poses, TimedPoses::Between::velocity, Eigen::Vector3d::Zero())));
    const motion::SmoothPieces pieces = trajectory.pieces();
    double in_double = 0, in_wide = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const motion::SmoothPiece piece = pieces[i];
        const auto& [from, to] = piece.times();
        if (from < times[1] || to > times[2])
            continue;
        for (int k = 0; k < 50; ++k) {
            const double tau = random.uniform(0, 1);
            const Eigen::Vector3d point = random_point(random, 1);
            const Digits time = Digits(from) + Digits(tau) * (Digits(to) - Digits(from));
            const Digits share = (time - Digits(times[1])) / (Digits(times[2]) - Digits(times[1]));
            const LongVector truth = at_constant_velocity(poses[1], poses[2], Eigen::Vector3d::Zero(), point, share);
            in_double = std::max(in_double, ratio_to_bound(*piece.enclosure({tau, tau}), point, truth));
            in_wide = std::max(in_wide, ratio_to_bound(*piece.refined_enclosure({tau, tau}), point, truth));
        }
    }
    std::cout << "at most " << in_double << " of the bound in double, " << in_wide << " in double-double\n";
    return {in_double, in_wide};
}

/// Between two stamps that are next to each other the body is so fast that the rounding of a time displaces it.
TEST(TimedPoses, AFastSegmentIsEnclosedToo) {
    Random random(1833);
    std::vector<Pose> poses = random_track(random);
    const auto [in_double, in_wide] = ratios_in_second_segment(random, poses, {0, 1.0 / 3, 1.0 / 3 + 3e-10, 1});
    EXPECT_LE(in_double, 1);
    EXPECT_LE(in_wide, 1);
    EXPECT_GT(in_double, 0.01) << "the segment is not fast enough to matter";
    poses[2].rotation = poses[1].rotation;
    for (const double time : {1.0 / 3, std::nextafter(1.0 / 3, 1)}) { // the time between is rounded down or up
        const auto [jump, jump_in_wide] =
            ratios_in_second_segment(random, poses, {0, time, std::nextafter(time, 1), 1});
        EXPECT_LE(jump, 1);
        EXPECT_LE(jump_in_wide, 1);
    }
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
