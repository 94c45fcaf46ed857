// The poses of a track are few, and the interpolation of the page between them looks like the motion.
#include "view/sampled_track.h"

#include "tests/query/bodies.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>

namespace chasles {
namespace {

const Eigen::AlignedBox3d unit_box(Eigen::Vector3d(-0.5, -0.5, -0.5), Eigen::Vector3d(0.5, 0.5, 0.5));

// The interpolation of the page, written independently: a linear step and a slerp.
Eigen::Isometry3d interpolated(const view::SampledTrack& track, double time) {
    std::size_t i = 0;
    while (i + 2 < track.times.size() && track.times[i + 1] <= time)
        ++i;
    const double part = (time - track.times[i]) / (track.times[i + 1] - track.times[i]);
    const auto rotation = [](const view::PoseRow& r) { return Eigen::Quaterniond(r[3], r[4], r[5], r[6]); };
    const view::PoseRow &a = track.poses[i], &b = track.poses[i + 1];
    const double cosine = std::min(1.0, rotation(a).dot(rotation(b))), angle = std::acos(cosine);
    Eigen::Quaterniond q = rotation(a);
    if (angle > 1e-9)
        q.coeffs() =
            (std::sin((1 - part) * angle) * rotation(a).coeffs() + std::sin(part * angle) * rotation(b).coeffs()) /
            std::sin(angle);
    Eigen::Isometry3d pose(q);
    for (int k = 0; k < 3; ++k)
        pose.translation()[k] = (1 - part) * a[static_cast<std::size_t>(k)] + part * b[static_cast<std::size_t>(k)];
    return pose;
}

double largest_deviation(const Motion& motion, const view::SampledTrack& track) {
    double largest = 0;
    for (int i = 0; i <= 5000; ++i) {
        const double time = i / 5000.;
        const Eigen::Isometry3d there = motion.pose_at(time).isometry(), shown = interpolated(track, time);
        for (int corner = 0; corner < 8; ++corner) {
            const Eigen::Vector3d at = unit_box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
            largest = std::max(largest, (there * at - shown * at).norm());
        }
    }
    return largest;
}

TEST(SampledTrack, AnEvenMotionNeedsItsEndsOnly) {
    const Motion motion = Motion::velocity(test::shifted(3, 0, 0), test::turned({-1, 2, 0}, {1, 2, 3}, 1.5));
    const view::SampledTrack track = view::sampled_track(motion, unit_box, {});
    EXPECT_EQ(track.times, (std::vector<double>{0, 1}));
    EXPECT_LE(largest_deviation(motion, track), 1e-12);
}

TEST(SampledTrack, ARestingBodyNeedsOnePose) {
    const Motion motion = Motion::at_rest(test::shifted(1, 2, 3));
    const view::SampledTrack track = view::sampled_track(motion, unit_box, {0.25, 0.5});
    EXPECT_TRUE(track.times.empty());
    ASSERT_EQ(track.poses.size(), 1U);
    EXPECT_EQ(track.poses[0], (view::PoseRow{1, 2, 3, 1, 0, 0, 0}));
}

TEST(SampledTrack, FollowsCurvesAndCorners) {
    const Motion twist = Motion::twist(test::shifted(3, 0, 0), test::turned({-3, 0, 2}, {0, 0, 1}, 3));
    const Motion corners = TimedPoses::through({0, 0.1, 0.13, 0.7, 1},
                                               {test::shifted(0, 0, 0), test::shifted(1, 0, 0), test::shifted(1, 1, 0),
                                                test::shifted(0, 1, 2), test::turned({0, 0, 0}, {1, 0, 0}, 2)});
    for (const Motion& motion : {twist, corners}) {
        const view::SampledTrack track = view::sampled_track(motion, unit_box, {});
        EXPECT_LE(largest_deviation(motion, track), 2.5e-3);
        EXPECT_GT(track.times.size(), 5U);
        EXPECT_LT(track.times.size(), 100U);
    }
}

/// At a half turn the page and this file would choose the way round by the last bit.
TEST(SampledTrack, NoStepTurnsByMoreThanAQuarterTurn) {
    for (const int half_turns : {1, 2, 4, 16, 32, 64, 300}) {
        const Motion motion = Motion::hinge({1, 0, 0}, {1, 2, 3}, {0, half_turns * std::numbers::pi});
        const view::SampledTrack track = view::sampled_track(motion, unit_box, {});
        for (std::size_t i = 1; i < track.poses.size(); ++i) {
            double product = 0;
            for (std::size_t k = 3; k < 7; ++k)
                product += track.poses[i - 1][k] * track.poses[i][k];
            EXPECT_GE(product, std::cos(0.8)) << half_turns;
        }
        EXPECT_GE(track.poses.size(), std::size_t(2 * half_turns + 1));
        EXPECT_LE(largest_deviation(motion, track), 2.5e-3) << half_turns;
    }
}

TEST(SampledTrack, LeavesOutStopsBetweenEqualPoses) {
    const Motion motion = TimedPoses::through({0, 0.25, 0.5, 0.75, 1},
                                              {test::shifted(0, 0, 0), test::shifted(0, 0, 0), test::shifted(0, 0, 0),
                                               test::shifted(0, 0, 0), test::shifted(1, 0, 0)});
    EXPECT_EQ(view::sampled_track(motion, unit_box, {0.25, 0.5, 0.75}).times, (std::vector<double>{0, 0.75, 1}));
}

/// Each body gets the poses that it needs, as if it were alone.
TEST(SampledTrack, BodiesThatArePosedTogetherHaveTracksOfTheirOwn) {
    const std::vector<Motion> motions{Motion::hinge({1, 0, 0}, {1, 2, 3}, {0, 7}),
                                      Motion::at_rest(test::shifted(1, 2, 3)),
                                      Motion::velocity(test::shifted(3, 0, 0), test::shifted(0, 1, 0))};
    const auto poses_at = [&](double time) {
        std::vector<Pose> poses;
        for (const Motion& motion : motions)
            poses.push_back(motion.pose_at(time));
        return poses;
    };
    std::vector<std::size_t> done;
    const std::vector<view::SampledTrack> tracks = view::sampled_tracks(
        {poses_at, std::vector(3, unit_box)}, {0, 0.5, 1}, [&](std::size_t intervals) { done.push_back(intervals); });
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const view::SampledTrack alone = view::sampled_track(motions[i], unit_box, {0.5});
        EXPECT_EQ(tracks[i].times, alone.times);
        EXPECT_EQ(tracks[i].poses, alone.poses);
    }
    EXPECT_EQ(done, (std::vector<std::size_t>{1, 2}));
}

/// From one place, for a stroke of 100 that lasts a share of the motion, and back again.
TimedPoses stroke(double time, double share) {
    const Pose rest = test::shifted(0, 0, 60), tip = test::shifted(0, 0, -40);
    return TimedPoses::through({0, time - share / 2, time, time + share / 2, 1}, {rest, rest, tip, rest, rest});
}

/// The height at which a page shows the body.
double height(const view::SampledTrack& track, double time) {
    return track.times.empty() ? track.poses[0][2] : interpolated(track, time).translation().z();
}

TEST(SampledTrack, AShortStrokeReachesItsEnd) {
    for (const double share : {0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-7})
        for (int i = 1; i < 40; ++i) {
            const double time = i / 41.;
            if (share > 2 * std::min(time, 1 - time))
                continue;
            const Motion motion = stroke(time, share);
            const view::SampledTrack track = view::sampled_track(motion, unit_box, {});
            ASSERT_FALSE(track.times.empty()) << time << " " << share;
            EXPECT_NEAR(height(track, time), -40, 2e-3) << time << " " << share;
            for (const double beside : {time - share / 2, time + share / 2})
                EXPECT_NEAR(height(track, beside), 60, 2e-3) << time << " " << share;
            EXPECT_LE(largest_deviation(motion, track), 2.5e-3) << time << " " << share;
        }
}

/// Cuts reach the pages through all ways to make motions of motions.
TEST(SampledTrack, AShortStrokeWithinAMotionReachesItsEnd) {
    const double time = 0.445, share = 0.01;
    const Motion alone = stroke(time, share);
    OwnTrajectory own;
    own.pose_at = [&](double at) { return alone.pose_at(at); };
    own.bounds = [](double, double) { return MotionBounds{0, 0, 2e4, 0}; };
    own.knots = {time - share / 2, time, time + share / 2};
    const Pose rest = test::shifted(0, 0, 60), tip = test::shifted(0, 0, -40);
    const Motion spline = Motion::spline({0, time - share, time - share / 2, time, time + share / 2, time + share, 1},
                                         {rest, rest, rest, tip, rest, rest, rest});
    const std::vector<std::pair<Motion, double>> cases{{alone * Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, 1}), time},
                                                       {Motion::slider({1, 0, 0}, {0, 5}) * alone, time},
                                                       {alone.reversed(), 1 - time},
                                                       {rest_of(alone, 0.2), (time - 0.2) / 0.8},
                                                       {relative(alone, Motion::at_rest(test::shifted(0, 0, 0))), time},
                                                       {relative(alone, Motion::slider({1, 0, 0}, {0, 1})), time},
                                                       {Motion::along(own), time},
                                                       {spline, time}};
    for (std::size_t i = 0; i < cases.size(); ++i)
        EXPECT_NEAR(height(view::sampled_track(cases[i].first, unit_box, {}), cases[i].second), -40, 5e-3) << i;
}

TEST(SampledTrack, StampsOfAStraightWayAreLeftOut) {
    std::vector<double> stamps;
    std::vector<Pose> poses;
    for (int i = 0; i <= 5000; ++i) {
        stamps.push_back(i / 5000.);
        poses.push_back(test::shifted(i / 5000., 0, i < 2500 ? 0 : (i - 2500) / 500.));
    }
    const view::SampledTrack track = view::sampled_track(TimedPoses::through(stamps, poses), unit_box, {});
    EXPECT_LE(track.times.size(), 16U) << "halves around one corner";
    EXPECT_NEAR(interpolated(track, 0.5).translation().z(), 0, 2e-3);
}

TEST(SampledTrack, HoldsTheExactTimesInOrder) {
    const Motion motion = Motion::velocity(test::shifted(3, 0, 0), test::shifted(0, 1, 0));
    const view::SampledTrack track = view::sampled_track(motion, unit_box, {0.7, 0.3, 0.7, 0});
    EXPECT_EQ(track.times, (std::vector<double>{0, 0.3, 0.7, 1}));
    EXPECT_EQ(track.poses[1][0], motion.pose_at(0.3).translation.x());
}

} // namespace
} // namespace chasles
