// The errors of the control maps in double-double, for any rounding of each operation from the caller's poses on. They
// are within the share of the bound that docs/derivations/10-error-bounds.md reserves for the maps.
#include "chasles/elementary/error_scale.h"
#include "tests/support/error_ratios.h"
#include "tests/support/posed_motions.h"
#include "tests/support/tracked.h"

namespace chasles::elementary {
namespace {

using namespace test;

motion::GeneralPose<Tracked> tracked(const Pose& pose) {
    return motion::pose_in<Tracked>(pose);
}

/// A motion of the family with error bounds on its numbers. Tiny turns are excluded: the direction of a tiny turn is
/// inaccurate, and its errors along and across the axis cancel. Bounds that only add up errors cannot represent this
/// cancellation.
RationalMotion<Tracked> random_tracked_motion(Random& random, double size) {
    const bool sweeps = random.chance(0.3);
    const double angle =
        random.chance(0.3) ? std::numbers::pi - 2.1e-3 * random.uniform(1, 10) : random.uniform(0.1, 3);
    const auto [start, goal] = random_pose_pair(random, {size, angle});
    motion::GeneralPose<Tracked> from = tracked(start);
    motion::GeneralPose<Tracked> to = tracked(goal);
    if (random.chance(0.5)) {
        const FourPoses poses = random_four_poses(random, start, goal, size);
        from = seen_from(tracked(poses.fixed_start), tracked(poses.moving_start));
        to = seen_from(tracked(poses.fixed_goal), tracked(poses.moving_goal));
    }
    if (!sweeps)
        return motion::screw_between(from, to);
    motion::Quaternion<Tracked> turn = motion::turn_between(from, to);
    const Tracked inverse = Tracked(1) / sqrt(turn.squared_norm());
    turn = {turn.w * inverse, scale(turn.v, inverse)};
    const Vector3<double> centre = random.vector(size * (random.chance(0.3) ? std::abs(random.scaled(0, 12)) : 1));
    return motion::sweep_between(from, to, turn, {centre.x, centre.y, centre.z});
}

/// The largest errors of the entries of one lane, summed along rows and columns like the values in the error scale.
struct LaneErrors {
    double turn = 0;
    double shift = 0;
    double inverse = 0;
    double moment = 0;
    double weight = 0;

    template <class AnyTracked>
    LaneErrors(const motion::ControlMaps<AnyTracked>& maps, int lane) : weight(maps.weight[lane].error()) {
        for (int i = 0; i < 3; ++i) {
            double row = 0, column = 0;
            for (int j = 0; j < 3; ++j) {
                row += maps.rotation.row[i][j][lane].error();
                column += maps.rotation.row[j][i][lane].error();
                moment = std::max(moment, maps.moment.row[i][j][lane].error());
            }
            turn = std::max({turn, row, column});
            shift = std::max(shift, maps.translation[i][lane].error());
            inverse = std::max(inverse, maps.inverse_translation[i][lane].error());
        }
    }
};

TEST(ErrorScale, LeavesRoomForEveryRoundingOfTheMaps) {
    Random random(731);
    ErrorRatios ratios;
    for (int trial = 0; trial < 2000 * times_if_long(100); ++trial) {
        const double size = std::abs(random.scaled(-6, 6));
        const RationalMotion<Tracked> motion = random_tracked_motion(random, size);
        const auto maps = motion::control_maps(motion);
        const auto in_doubles = motion::transformed<double>(
            maps, [](const Bernstein<3, Tracked>& p) { return algebra::converted<double>(p); });
        const double moving = std::max(motion.reference_extent, size * std::abs(random.scaled(-6, 2)));
        const double fixed = size * std::abs(random.scaled(-6, 2));
        const ErrorScale scale = error_scale(in_doubles, moving, fixed);
        const double bound = relative_error<DoubleDouble>(scale);
        for (int lane = 0; lane <= 3; ++lane) {
            const LaneErrors e(maps, lane);
            const double length = bound * scale.length * in_doubles.weight[lane];
            ratios.note("turn", e.turn / (bound * scale.norm_bound * in_doubles.weight[lane]));
            ratios.note("arms from the fixed body", (e.turn * moving + e.shift + e.weight * fixed) / length);
            ratios.note("arms from the moving body", (e.turn * fixed + e.inverse + e.weight * moving) / length);
            ratios.note("moments", (e.turn * (moving + fixed) + e.moment) / length);
        }
    }
    ratios.expect_sound(0.01);
}

/// The same for maps that a query computes in double precision from a rounded motion.
TEST(ErrorScale, LeavesRoomForEveryRoundingOfMapsInDouble) {
    Random random(733);
    ErrorRatios ratios;
    const auto tracked_vector = [](const Vector3<DoubleDouble>& v) {
        return Vector3<TrackedDouble>{TrackedDouble::rounded(v.x), TrackedDouble::rounded(v.y),
                                      TrackedDouble::rounded(v.z)};
    };
    int made = 0;
    for (int trial = 0; trial < 4000 * times_if_long(100); ++trial) {
        const double size = std::abs(random.scaled(-6, 6));
        const RationalMotion<DoubleDouble> motion = random_posed_motion(random, size).made;
        if (!motion::is_small_rotation(motion))
            continue;
        ++made;
        RationalMotion<TrackedDouble> rounded{
            TrackedDouble::rounded(motion.end_cosine), tracked_vector(motion.axis),   tracked_vector(motion.moment),
            tracked_vector(motion.displacement),       tracked_vector(motion.origin), {}};
        for (int i = 0; i < 3; ++i)
            rounded.orientation.row[i] = tracked_vector(motion.orientation.row[i]);
        const auto maps = motion::control_maps(rounded);
        const auto in_doubles = motion::double_maps(motion);
        const double moving = std::max(motion.reference_extent, size * std::abs(random.scaled(-6, 2)));
        const double fixed = size * std::abs(random.scaled(-6, 2));
        const ErrorScale scale = error_scale(in_doubles, moving + motion::rounding_extent(motion), fixed);
        const double bound = 71 * 0x1p-53; // what 88 leave of 160 units, and 1 that they count for the maps
        for (int lane = 0; lane <= 3; ++lane) {
            const LaneErrors e(maps, lane);
            const double weight = in_doubles.weight[lane];
            ratios.note("turn", e.turn / (bound * scale.norm_bound * weight));
            ratios.note("arms from the fixed body",
                        (e.turn * moving + e.shift + e.weight * fixed) / (bound * scale.length * weight));
            ratios.note("arms from the moving body",
                        (e.turn * fixed + e.inverse + e.weight * moving) / (bound * scale.length * weight));
            ratios.note("moments", (e.turn * (moving + fixed) + e.moment) / (bound * scale.length * weight));
        }
    }
    EXPECT_GT(made, 1000);
    ratios.expect_sound(0.01);
}

/// A tiny turn about a distant point: the numbers of the motion are as large as the coordinates of this point, but the
/// body's path is short.
TEST(ErrorScale, CountsTheCentreOfASweepAsAPointOfTheBody) {
    Random random(732);
    ErrorRatios ratios;
    double without = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const auto [start, goal] = random_pose_pair(random, {1, 1e-8});
        const Eigen::Vector3d centre = 1e9 * eigen(random.vector(1));
        const PosedMotion motion =
            sweep_of(SweepMotion::between(start, goal, centre), exact(start), exact(goal), centre);
        const auto made = motion::control_maps(motion.made);
        const auto truth = motion::control_maps(motion.exactly);
        const auto in_doubles = motion::rounded(made);
        for (int i = 0; i < 12; ++i) {
            const Rational off =
                magnitude(Rational(exact(made.translation[i / 4][i % 4]) - truth.translation[i / 4][i % 4]));
            const auto ratio = [&](double reach) {
                const ErrorScale scale = error_scale(in_doubles, reach, 1);
                return static_cast<double>(off) / (relative_error<DoubleDouble>(scale) * scale.length);
            };
            ratios.note("shift", ratio(std::max(1.0, motion.made.reference_extent)));
            without = std::max(without, ratio(1));
        }
    }
    ratios.expect_sound(1e-6);
    EXPECT_GT(without, 1) << "the centre need not count";
}

} // namespace
} // namespace chasles::elementary
