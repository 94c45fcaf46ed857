// Composed motions: their poses by their definitions, and the bounds of their rates by the test kit, which samples.
#include "chasles/motion/frames.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/motion.h"
#include "tests/motion/frame_bounds.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

std::vector<double> random_numbers(Random& random, int count, double size) {
    std::vector<double> numbers;
    for (int i = 0; i < count; ++i)
        numbers.push_back(random.uniform(-size, size));
    return numbers;
}

std::vector<Pose> random_poses(Random& random, int count) {
    std::vector<Pose> poses{random_pose(random, 2)};
    while (int(poses.size()) < count)
        poses.push_back(random_goal(random, poses.back(), random.uniform(0, 3), 2));
    return poses;
}

using chasles::test::expect_bounds_hold;

void expect_bounds_hold(const Motion& motion, std::uint64_t seed) {
    expect_bounds_hold(motion.trajectory().frame(), seed);
}

/// Of all kinds.
Motion random_motion(Random& random, int kind) {
    switch (kind % 7) {
    case 0:
        return Motion::hinge(random_point(random, 2), random_point(random, 1), random_numbers(random, 4, 2));
    case 1:
        return Motion::slider(random_point(random, 1), random_numbers(random, 3, 2));
    case 2:
        return Motion::polynomial({random_point(random, 1), random_point(random, 2), random_point(random, 1)});
    case 3:
        return Motion::velocity(random_pose(random, 2), random_pose(random, 2), random_point(random, 1));
    case 4:
        return Motion::twist(random_pose(random, 2), random_pose(random, 2));
    case 5:
        return Motion::spline({0, 0.3, 0.5, 1}, random_poses(random, 4));
    default:
        return Motion::b_spline(random_poses(random, 4));
    }
}

TEST(Hinge, TurnsAboutItsLineByThePolynomial) {
    const Vector3d point(1, 2, 3), direction(0, 3, 4);
    const Motion hinge = Motion::hinge(point, direction, {0.5, -1, 4});
    for (const double time : {0.0, 0.3, 1.0}) {
        const double angle = 0.5 - time + 4 * time * time;
        const Isometry3d expected = Eigen::Translation3d(point) * Eigen::AngleAxisd(angle, direction.normalized()) *
                                    Eigen::Translation3d(-point);
        EXPECT_TRUE(hinge.pose_at(time).isometry().isApprox(expected, 1e-14));
    }
    EXPECT_THROW((void)Motion::hinge(point, Vector3d::Zero(), {1}), InvalidInput);
    EXPECT_THROW((void)Motion::hinge(point, direction, {1, NAN}), InvalidInput);
    EXPECT_EQ(
        test::refusal([&] {
            (void)Motion::hinge(point, direction, {1, 1000});
        }),
        "motion: angle: the numbers are too large; their sizes may sum up to 1000 radians: ask about the turns one "
        "after another, each from the angle where the last one ended");
}

TEST(Slider, GoesAlongItsDirection) {
    const Motion slider = Motion::slider({0, 3, 4}, {1, 2, 3});
    EXPECT_TRUE(slider.pose_at(0.5).translation.isApprox(2.75 * Vector3d(0, 0.6, 0.8), 1e-14));
    EXPECT_THROW((void)Motion::slider({0, 0, 0}, {1}), InvalidInput);
}

TEST(Polynomial, GoesThroughItsPlaces) {
    const Motion path = Motion::polynomial({{1, 0, 0}, {0, 2, 0}, {0, 0, 3}});
    EXPECT_TRUE(path.pose_at(0.5).translation.isApprox(Vector3d(1, 1, 0.75), 1e-15));
    EXPECT_THROW((void)Motion::polynomial({{INFINITY, 0, 0}}), InvalidInput);
}

TEST(Product, CarriesTheInnerMotion) {
    Random random(1821);
    for (int trial = 0; trial < 49; ++trial) {
        const Motion outer = random_motion(random, trial), inner = random_motion(random, trial / 7);
        const Motion both = outer * inner;
        for (const double time : {0.0, 0.37, 1.0})
            EXPECT_TRUE(both.pose_at(time).isometry().isApprox(
                outer.pose_at(time).isometry() * inner.pose_at(time).isometry(), 1e-12));
        EXPECT_TRUE(both.fixed_pose_at(0.3).isometry().matrix() == Isometry3d::Identity().matrix());
    }
    EXPECT_THROW((void)(Motion::screw(Pose(), Pose()) * Motion::at_rest(Pose())), InvalidInput);
}

/// A loop that multiplies, and one that takes the rest of a rest, would overflow the stack; squares have 2^n factors.
TEST(Product, OfTooManyMotionsIsRefused) {
    const Motion step = Motion::slider({1, 0, 0}, {0, 0.01});
    const std::string refusal =
        "motion: is made of more than 1000 motions, which are all evaluated for every pose: multiply the poses of "
        "factors that stand still, or ask about a path of poses";
    const auto refused = [&](const auto& longer) {
        Motion motion = step;
        for (int i = 1; i < 30'000; ++i)
            try {
                motion = longer(motion);
            } catch (const InvalidInput& error) {
                EXPECT_EQ(error.what(), refusal);
                return i;
            }
        return 0;
    };
    EXPECT_EQ(refused([&](const Motion& motion) { return motion * step; }), 1000);
    EXPECT_EQ(refused([&](const Motion& motion) { return step * motion; }), 1000);
    EXPECT_EQ(refused([](const Motion& motion) { return motion * motion; }), 10);
    EXPECT_GT(refused([](const Motion& motion) { return rest_of(motion, 0.01); }), 500);
    Motion longest = step;
    for (int i = 1; i < 1000; ++i)
        longest = step * longest;
    EXPECT_NEAR(longest.pose_at(0.5).translation.x(), 5, 1e-12);
}

TEST(Relative, KeepsBothBodiesInTheWorld) {
    Random random(1822);
    for (int trial = 0; trial < 49; ++trial) {
        const Motion moving = random_motion(random, trial), fixed = random_motion(random, trial / 7);
        const Motion seen = relative(moving, fixed);
        for (const double time : {0.0, 0.61, 1.0}) {
            EXPECT_TRUE(seen.pose_at(time).isometry().isApprox(moving.pose_at(time).isometry(), 1e-13));
            EXPECT_TRUE(seen.fixed_pose_at(time).isometry().isApprox(fixed.pose_at(time).isometry(), 1e-13));
        }
    }
    EXPECT_THROW((void)relative(Motion::sweep(Pose(), Pose()), Motion::at_rest(Pose())), InvalidInput);
    const Motion straight = Motion::velocity(Pose(), Pose({1, 2, 3}, Eigen::Quaterniond::Identity()));
    EXPECT_TRUE((straight * Motion::at_rest(Pose())).pose_at(0.5).translation.isApprox(Vector3d(0.5, 1, 1.5)))
        << "it is searched as a sweep, but is an even motion";
    const Motion seen = relative(Motion::at_rest(Pose()), Motion::at_rest(Pose()));
    EXPECT_THROW((void)(seen * Motion::at_rest(Pose())), InvalidInput) << "its fixed body is no world";
}

TEST(Frames, NoBoundOfRatesIsBroken) {
    Random random(1823);
    for (int trial = 0; trial < 49; ++trial) {
        const Motion a = random_motion(random, trial), b = random_motion(random, trial / 7);
        expect_bounds_hold(a, std::uint64_t(trial));
        expect_bounds_hold(a * b, std::uint64_t(trial));
        expect_bounds_hold(a * b * random_motion(random, trial / 3), std::uint64_t(trial));
        const motion::SharedFrame seen = motion::relative_frame(a.trajectory().frame(), b.trajectory().frame());
        expect_bounds_hold(seen, std::uint64_t(trial));
    }
}

/// Powers of the time with coefficients of very different sizes, of which some are zero: then one term of a bound alone
/// must hold.
std::vector<double> random_powers(Random& random) {
    std::vector<double> coefficients{0, 0, 0, 0};
    for (std::size_t k = 1; k < 4; ++k)
        if (random.chance(0.5))
            coefficients[k] = random.scaled(-2, 1);
    return coefficients;
}

Motion random_joint(Random& random) {
    const Vector3d point = random.chance(0.5) ? Vector3d::Zero() : random_point(random, 2);
    return random.chance(0.6) ? Motion::hinge(point, random_point(random, 1), random_powers(random))
                              : Motion::slider(random_point(random, 1), random_powers(random)) *
                                    Motion::at_rest(Pose(point, Eigen::Quaterniond::Identity()));
}

/// No rate within an interval is greater than its bound, and no acceleration changes faster than the third rates say.
void expect_rates_within_bounds(const motion::MovingFrame& frame, Random& random) {
    for (int interval = 0; interval < 20; ++interval) {
        const double from = random.chance(0.5) ? 0 : random.uniform(0, 0.9);
        const double to = std::min(1.0, from + std::pow(10, random.uniform(-3, 0)));
        const motion::RateExpansion stated = frame.expansion({from, to});
        const auto rates_at = [&](double time) { return frame.expansion({time, time}); };
        const double a = random.uniform(from, to), b = random.chance(0.5) ? from : to;
        const motion::RateExpansion at = rates_at(a), other = rates_at(b);
        const auto expect_within = [&](double found, double bound, double sum) {
            EXPECT_LE(found, bound * (1 + 1e-9) + 1e-11 * sum) << from << " to " << to;
        };
        expect_within(length(at.turn_rate), stated.bounds.turn_rate, stated.sums.turn_rate);
        expect_within(length(at.turn_acceleration), stated.bounds.turn_acceleration, stated.sums.turn_acceleration);
        expect_within(length(at.velocity), stated.bounds.speed, stated.sums.speed);
        expect_within(length(at.acceleration), stated.bounds.acceleration, stated.sums.acceleration);
        expect_within(length(at.turn_acceleration - other.turn_acceleration), stated.turn_jerk * std::abs(a - b),
                      stated.sums.turn_acceleration);
        expect_within(length(at.acceleration - other.acceleration), stated.jerk * std::abs(a - b),
                      stated.sums.acceleration);
    }
}

TEST(Frames, EveryTermOfABoundIsNeeded) {
    Random random(1827);
    for (int trial = 0; trial < 3000; ++trial) {
        SCOPED_TRACE(trial);
        const motion::SharedFrame outer = random_joint(random).trajectory().frame();
        const motion::SharedFrame inner = random_joint(random).trajectory().frame();
        const motion::SharedFrame both = motion::product_frame(outer, inner);
        expect_rates_within_bounds(*both, random);
        expect_rates_within_bounds(*motion::relative_frame(outer, inner), random);
        expect_rates_within_bounds(*motion::relative_frame(random_joint(random).trajectory().frame(), both), random);
        if (HasFailure())
            break;
    }
}

TEST(Rest, IsTheMotionFromThereOn) {
    Random random(1828);
    for (int trial = 0; trial < 49; ++trial) {
        const Motion whole = random_motion(random, trial) * random_motion(random, trial / 7);
        const double from = random.uniform(0.05, 0.95);
        const Motion rest = rest_of(whole, from);
        const motion::SharedFrame frame = rest.trajectory().frame();
        for (const double time : {0.0, 0.37, 1.0}) {
            const Isometry3d expected = whole.pose_at(from + time * (1 - from)).isometry();
            EXPECT_TRUE(rest.pose_at(time).isometry().isApprox(expected, 1e-13));
            const auto [place, turn] = rounded_pose(frame->refined_at(algebra::DoubleDouble(time)));
            const Pose refined({place.x, place.y, place.z}, Eigen::Quaterniond(turn.w, turn.v.x, turn.v.y, turn.v.z));
            EXPECT_TRUE(refined.isometry().isApprox(expected, 1e-13));
        }
        expect_bounds_hold(rest, std::uint64_t(trial));
        expect_bounds_hold(Motion::at_rest(random_pose(random, 1)) * rest, std::uint64_t(trial));
    }
    const Motion straight = Motion::velocity(Pose(), Pose({4, 0, 0}, Eigen::Quaterniond::Identity()));
    EXPECT_TRUE(rest_of(straight, 0.25).pose_at(0.5).translation.isApprox(Vector3d(2.5, 0, 0)));
    EXPECT_THROW((void)rest_of(straight, 1), InvalidInput);
    EXPECT_THROW((void)rest_of(straight, -0.1), InvalidInput);
    EXPECT_THROW((void)rest_of(Motion::screw(Pose(), Pose()), 0), InvalidInput);
    try {
        (void)rest_of(relative(straight, Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, 1})), 0.5);
        ADD_FAILURE() << "is refused";
    } catch (const InvalidInput& error) {
        EXPECT_TRUE(std::string(error.what())
                        .ends_with("; of two motions take relative(rest_of(moving, start), rest_of(fixed, start))"))
            << error.what();
    }
}

/// The second difference of a path over a short time, as a share of the stated bound of the acceleration.
double share_of_bound(const motion::MovingFrame& frame, double time) {
    constexpr double half = 0x1p-10;
    const auto reference = frame.reference();
    const auto place = [&](double when) {
        const auto pose = frame.at(when);
        return rotated(pose.rotation, reference) + pose.translation;
    };
    const auto bend = place(time + half) - scale(place(time), 2.0) + place(time - half);
    return length(bend) / (half * half * frame.rates({time - half, time + half}).acceleration);
}

/// Bounds that were composed from bounds alone are four to twelve times too wide here.
TEST(Frames, BoundsOfChainsOverShortTimesAreSharp) {
    Random random(1826);
    double least = 1, sum = 0;
    constexpr int trials = 40;
    for (int trial = 0; trial < trials; ++trial) {
        Motion arm = Motion::at_rest(Pose());
        for (int joint = 0; joint < 7; ++joint)
            arm = arm * Motion::hinge(Vector3d::Zero(), random_point(random, 1), random_numbers(random, 3, 1)) *
                  Motion::at_rest(random_pose(random, 1));
        const Motion other = Motion::velocity(random_pose(random, 2), random_pose(random, 2));
        const motion::SharedFrame frame = arm.trajectory().frame();
        const double share = trial % 2
                                 ? share_of_bound(*frame, 0.4)
                                 : share_of_bound(*motion::relative_frame(frame, other.trajectory().frame()), 0.4);
        least = std::min(least, share);
        sum += share / trials;
        expect_bounds_hold(arm, std::uint64_t(trial));
    }
    std::cout << "the true acceleration is at least " << least << " of its bound, " << sum << " on average\n";
    EXPECT_GT(least, 0.8);
    EXPECT_GT(sum, 0.95);
}

/// A bound that is not known may be infinite; no bound becomes a NaN.
TEST(Frames, UnknownBoundsStayUnknown) {
    OwnTrajectory own;
    own.pose_at = [](double time) { return Pose({time, 0, 0}, Eigen::Quaterniond::Identity()); };
    own.bounds = [](double, double) { return MotionBounds{0, INFINITY, 1, INFINITY}; };
    const Motion unknown = Motion::along(own), rest = Motion::at_rest(Pose());
    for (const Motion& motion : {unknown * rest, rest * unknown, unknown * unknown}) {
        const motion::RateBounds rates = motion.trajectory().frame()->rates({0.25, 0.5});
        EXPECT_EQ(rates.turn_rate, 0);
        EXPECT_GE(rates.speed, 1);
        EXPECT_LT(rates.speed, 2.001);
        EXPECT_EQ(rates.acceleration, INFINITY);
    }
}

/// Frames in double are those in double-double, to within the rounding that they state.
TEST(Frames, PosesInDoubleHaveTheRoundingThatIsStated) {
    Random random(1824);
    double greatest = 0;
    for (int trial = 0; trial < 140; ++trial) {
        const Motion motion = random_motion(random, trial) * random_motion(random, trial / 7);
        const motion::SharedFrame frame = motion.trajectory().frame();
        ASSERT_TRUE(frame->is_refined());
        for (int k = 0; k < 5; ++k) {
            const double time = random.uniform(0, 1);
            const auto rough = frame->at(time);
            const auto fine = rounded_pose(frame->refined_at(algebra::DoubleDouble(time)));
            const double sign =
                rough.rotation.w * fine.rotation.w + dot(rough.rotation.v, fine.rotation.v) < 0 ? -1 : 1;
            const double turn = std::hypot(rough.rotation.w - sign * fine.rotation.w,
                                           length(rough.rotation.v - scale(fine.rotation.v, sign)));
            const double shift = length(rough.translation - fine.translation);
            const double unit = 0.25 * frame->rounding() * motion::pose_rounding<double>;
            greatest = std::max({greatest, turn / unit, shift / (unit * frame->size())});
        }
    }
    std::cout << "at most " << greatest << " of a quarter of the rounding\n";
    EXPECT_LE(greatest, 1);
}

TEST(Spline, GoesThroughItsPosesWithoutAJumpOfVelocityOrAcceleration) {
    Random random(1825);
    const std::vector<double> times{0, 0.1, 0.45, 0.7, 1};
    const std::vector<Pose> poses = random_poses(random, 5);
    const Motion spline = Motion::spline(times, poses);
    for (std::size_t i = 0; i < times.size(); ++i)
        EXPECT_TRUE(spline.pose_at(times[i]).isometry().isApprox(poses[i].isometry(), 1e-14));
    const auto second_difference = [&](double time, double step) -> Vector3d {
        return (spline.pose_at(time + step).translation + spline.pose_at(time - step).translation -
                2 * spline.pose_at(time).translation) /
               (step * step);
    };
    for (const double knot : {0.1, 0.45, 0.7}) {
        const double step = 1e-5;
        EXPECT_LT((second_difference(knot - step, step) - second_difference(knot + step, step)).norm(), 0.1)
            << "it would jump by tens";
    }
    EXPECT_LT(second_difference(2e-5, 1e-5).norm(), 0.2) << "natural: no acceleration at the ends";
    const Pose middle = spline.pose_at(0.275); // half way between two knots: slerp
    const Eigen::Quaterniond slerp =
        Eigen::Quaterniond(poses[1].rotation.normalized()).slerp(0.5, poses[2].rotation.normalized());
    EXPECT_LT(middle.rotation.angularDistance(slerp), 1e-13);
}

TEST(Spline, RefusesKnotsThatCannotBeUsed) {
    const std::vector<Pose> two(2), three(3);
    EXPECT_THROW((void)Motion::spline({0}, {Pose()}), InvalidInput);
    EXPECT_THROW((void)Motion::spline({0, 0.5, 1}, two), InvalidInput);
    EXPECT_THROW((void)Motion::spline({0, 2}, two), InvalidInput);
    EXPECT_THROW((void)Motion::spline({0, 0, 1}, three), InvalidInput);
    EXPECT_THROW((void)Motion::spline({0, NAN, 1}, three), InvalidInput);
    EXPECT_THROW((void)Motion::b_spline({Pose()}), InvalidInput);
    const Pose back({0, 0, 0}, Eigen::Quaterniond(0, 0, 0, 1));
    EXPECT_THROW((void)Motion::b_spline({Pose(), back}), InvalidInput) << "a half turn has two directions";
}

TEST(BSpline, StartsAndEndsAtItsPosesAndIsSmooth) {
    Random random(1826);
    const std::vector<Pose> poses = random_poses(random, 5);
    const Motion spline = Motion::b_spline(poses);
    EXPECT_TRUE(spline.pose_at(0).isometry().isApprox(poses.front().isometry(), 1e-14));
    EXPECT_TRUE(spline.pose_at(1).isometry().isApprox(poses.back().isometry(), 1e-14));
    const motion::SharedFrame frame = spline.trajectory().frame();
    std::vector<double> cuts;
    frame->add_cuts(cuts);
    for (const double cut : cuts) {
        if (cut <= 0 || cut >= 1)
            continue;
        const double step = 1e-5;
        const Isometry3d before = spline.pose_at(cut - step).isometry(), at = spline.pose_at(cut).isometry();
        const Isometry3d after = spline.pose_at(cut + step).isometry();
        const Eigen::Matrix4d bend = before.matrix() + after.matrix() - 2 * at.matrix();
        EXPECT_LT(bend.norm(), 1e-6) << "the velocity jumps at " << cut;
    }
}

/// Equal steps of orientation and position: a B-spline that runs evenly in its inner segments.
TEST(BSpline, OfEqualStepsIsEvenInside) {
    std::vector<Pose> poses;
    for (int i = 0; i < 8; ++i)
        poses.emplace_back(Vector3d(i, 0, 0), Eigen::Quaterniond(Eigen::AngleAxisd(0.3 * i, Vector3d::UnitZ())));
    const Motion spline = Motion::b_spline(poses);
    for (int i = 1; i <= 6; ++i) // nine segments; pose i is at the knot i + 1
        EXPECT_TRUE(spline.pose_at((i + 1) / 9.0).isometry().isApprox(poses[std::size_t(i)].isometry(), 1e-13)) << i;
}

} // namespace
} // namespace chasles::test
