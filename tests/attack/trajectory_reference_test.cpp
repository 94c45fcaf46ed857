// Tests of the reference for trajectories: closed forms, the ends of the motions, and dense sampling.
#include "tests/attack/touch_search.h"
#include "tests/attack/trajectory_families.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::attack {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::numbers::pi;

Shape triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return {{a, b, c}, {{0, 1, 2}}};
}

/// A half turn about z, as quaternions of whole numbers, of different lengths.
const Pose at_rest(Vector3d(0, 0, 0), Quaterniond(3, 0, 0, 0));
Pose half_turned(const Vector3d& place) {
    return {place, Quaterniond(0, 0, 0, 2)};
}

void expect_touch(const TrueTouch& found, double time) {
    ASSERT_TRUE(found.upper.has_value());
    EXPECT_FALSE(found.is_clear);
    EXPECT_LE(found.lower, time + 0x1p-52);
    EXPECT_GE(*found.upper, time - 0x1p-52);
    EXPECT_LE(*found.upper - found.lower, 0x1p-48);
}

TEST(TrajectoryReference, ATranslationTouchesAtItsTime) {
    const Shape above = triangle({1, 1, 1}, {1, 2, 3}, {2, 1, 3});
    const Shape floor = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    for (const double depth : {-1.25, -3.0, -700.0}) {
        const Pose goal(Vector3d(0, 0, depth), Quaterniond(-7, 0, 0, 0));
        for (const TrueMotion& motion : {true_velocity(at_rest, goal, Vector3d(5, 6, 7)), true_twist(at_rest, goal)}) {
            expect_touch(first_touch(above, floor, motion), -1 / depth);
            expect_touch(first_touch(above, floor, motion, {.wide_only = true}), -1 / depth);
        }
    }
    const Pose short_of(Vector3d(0, 0, std::nextafter(-1.0, 0.0)), Quaterniond::Identity());
    EXPECT_TRUE(first_touch(above, floor, true_twist(at_rest, short_of)).is_clear);
    const Pose too_far(Vector3d(0, 0, std::nextafter(-1.0, -2.0)), Quaterniond::Identity());
    EXPECT_FALSE(first_touch(above, floor, true_twist(at_rest, too_far)).is_clear);
}

/// The long edge of a bar along x turns about z by a half turn. It touches a post at the angle of the post.
TEST(TrajectoryReference, ABarTurnsIntoAPost) {
    const Shape bar = triangle({1, 0, 0}, {9, 0, 0}, {5, -1, 0});
    for (const double angle : {0.5, 1.0, 2.0, 3.0}) {
        const Vector3d foot(4 * std::cos(angle), 4 * std::sin(angle), 0);
        const Vector3d behind(-std::sin(angle), std::cos(angle), 0);
        const Shape post = triangle(foot - Vector3d::UnitZ(), foot + Vector3d::UnitZ(), foot + behind);
        const double time = std::atan2(foot.y(), foot.x()) / pi;
        for (const TrueMotion& motion :
             {true_velocity(at_rest, half_turned({0, 0, 0}), {0, 0, 0}), true_twist(at_rest, half_turned({0, 0, 0}))}) {
            expect_touch(first_touch(bar, post, motion), time);
            expect_touch(first_touch(bar, post, motion, {.wide_only = true}), time);
        }
    }
}

/// On the helix about the axis x = 2 a corner is at the height 6 t. The floor of small triangles at its height stops
/// it.
TEST(TrajectoryReference, ATwistRunsOnAHelix) {
    const TrueMotion motion = true_twist(at_rest, half_turned({4, 0, 6})); // about the axis through (2, 0)
    const Shape pin = triangle({0, 0, 0}, {0, 0, -1}, {0.1, 0, -1});
    for (const double time : {0.25, 0.5, 0.9}) {
        const Vector3d tip(2 - 2 * std::cos(pi * time), -2 * std::sin(pi * time), 6 * time);
        const Shape roof = triangle(tip + Vector3d(-1, -1, 0), tip + Vector3d(1, -1, 0), tip + Vector3d(0, 1, 0));
        expect_touch(first_touch(pin, roof, motion), time);
    }
}

/// A corner on a circle of radius 5 passes a wall at the distance 5 + gap, from 4 ahead to 4 behind.
TEST(TrajectoryReference, AGrazeIsClearOrTouchesOrIsUndecided) {
    const Shape tip = triangle({5, 0, 0}, {4, -1, 1}, {4, -1, -1});
    const TrueMotion motion = true_twist(at_rest, half_turned({0, 0, 0}));
    const auto passed = [&](double gap) {
        return first_touch(tip, triangle({-9, 5 + gap, -9}, {9, 5 + gap, -9}, {0, 5 + gap, 20}), motion);
    };
    EXPECT_TRUE(passed(1e-3).is_clear);
    EXPECT_TRUE(passed(0x1p-50).is_clear);
    const TrueTouch exact = passed(0);
    EXPECT_FALSE(exact.is_clear);
    EXPECT_FALSE(exact.upper.has_value());
    EXPECT_LE(exact.lower, 0.5);
    EXPECT_GE(exact.lower, 0.5 - 1e-10);
    for (const double depth : {1e-3, 1e-9, 1e-12}) {
        const double exact_depth = 5 - (5 - depth);
        expect_touch(passed(-depth), 0.5 - 2 * std::asin(std::sqrt(exact_depth / 10)) / pi);
    }
}

TEST(TrajectoryReference, CrossingAtTheStartAndNestedBodies) {
    const Shape floor = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    const Pose away(Vector3d(0, 0, 9), Quaterniond::Identity());
    const TrueTouch crossing =
        first_touch(triangle({1, 1, -1}, {1, 1, 1}, {5, 5, 1}), floor, true_twist(at_rest, away));
    EXPECT_EQ(crossing.upper, 0.0);
    EXPECT_EQ(crossing.lower, 0.0);
    const Shape outer = box_shape({-1, -1, -1}, {1, 1, 1});
    const Shape inner = box_shape({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25});
    EXPECT_TRUE(first_touch(inner, outer, true_twist(at_rest, half_turned({0, 0, 0.5}))).is_clear);
    expect_touch(first_touch(inner, outer, true_twist(at_rest, half_turned({0, 0, 1}))), 0.75);
}

/// A margin needs more than the distance.
TEST(TrajectoryReference, AMarginIsKept) {
    const Shape floor = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    const Shape above = triangle({1, 1, 1}, {1, 2, 3}, {2, 1, 3});
    const TrueMotion motion = true_twist(at_rest, Pose(Vector3d(0, 0, -0.5), Quaterniond::Identity()));
    EXPECT_TRUE(first_touch(above, floor, motion, {.margin = 0.49}).is_clear);
    EXPECT_FALSE(first_touch(above, floor, motion, {.margin = 0.51}).is_clear);
}

/// Compares bounds with differences over a short step. True if the bound of accelerations is nearly reached.
bool expect_within_bounds(const TrueMotion& motion, const Vector3d& point, double time) {
    const double step = 0x1p-10;
    const auto part = std::ranges::find_if(
        motion.parts, [&](const TruePart& p) { return p.from <= time - step && time + step <= p.to; });
    if (part == motion.parts.end()) // rates may jump
        return false;
    const auto at = [&](double when) -> WideVector {
        const TruePose pose = motion.at(when);
        return pose.turn * widened(point) + pose.place;
    };
    const TrueRates& rates = part->rates;
    const double reach = (point - motion.reference).norm();
    const double speed = rates.speed + rates.turn_rate * reach;
    const double turn = rates.turn_rate * rates.turn_rate + rates.turn_acceleration;
    const double bend = rates.acceleration + turn * reach;
    EXPECT_LE(double((at(time + step) - at(time)).norm()), speed * step * (1 + 1e-9));
    const WideVector second = at(time + step) + at(time - step) - at(time) * Wide(2);
    const double allowed = bend * step * step;
    EXPECT_LE(double(second.norm()), allowed * (1 + 1e-9) + 1e-60);
    return double(second.norm()) > 0.3 * allowed;
}

struct RandomEnds {
    Pose start;
    Pose goal;
};

RandomEnds random_ends(AttackRandom& random) {
    const auto quaternion = [&] {
        const Vector3d v = random.vector(1);
        return Quaterniond(random.uniform(-1, 1), v.x(), v.y(), v.z());
    };
    const Quaterniond from = quaternion();
    const double turn = std::pow(10, random.uniform(-12, 1));
    const Quaterniond to(from.coeffs() + turn * quaternion().coeffs());
    return {Pose(random.vector(3), from), Pose(random.vector(3), to)};
}

/// Sampled: 200 motions of each kind.
TEST(TrajectoryReference, MotionsKeepTheirEndsAndTheirBounds) {
    int tight = 0;
    for (std::uint64_t index = 0; index < 200; ++index) {
        AttackRandom random(5, 1, index);
        const auto [start, goal] = random_ends(random);
        const Vector3d point = random.vector(2);
        const double time = random.integer(100, 900) * 0x1p-10; // sums with the step are exact
        for (const TrueMotion& motion : {true_velocity(start, goal, random.vector(100)), true_twist(start, goal)}) {
            EXPECT_LT((narrowed(motion.at(0)) * point - start.isometry() * point).norm(), 1e-14);
            EXPECT_LT((narrowed(motion.at(1)) * point - goal.isometry() * point).norm(), 1e-14);
            const WideMatrix square = motion.at(1).turn.transpose() * motion.at(1).turn;
            EXPECT_LT(double((square - WideMatrix::Identity()).norm()), 0x1p-200);
            tight += expect_within_bounds(motion, point, time) ? 1 : 0;
        }
    }
    EXPECT_GT(tight, 200);
}

/// Expects a motion to be at poses at times.
void expect_poses(const TrueMotion& motion, const std::vector<double>& times, const std::vector<Pose>& poses) {
    const Vector3d point(0.5, -2, 1);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const Vector3d place = narrowed(motion.at(times[i])) * point;
        EXPECT_LT((place - poses[i].isometry() * point).norm(), 1e-13);
    }
}

TEST(TrajectoryReference, HingesAndPathsKeepTheirBounds) {
    int tight = 0;
    for (std::uint64_t index = 0; index < 200; ++index) {
        AttackRandom random(5, 3, index);
        const Vector3d foot = random.vector(2);
        const Vector3d axis = random.vector(1);
        const std::vector<double> angle{random.uniform(-1, 1), random.uniform(-9, 9), random.uniform(-9, 9)};
        const TrueMotion hinge = true_hinge(foot, axis, angle);
        const Eigen::AngleAxisd turn(angle[0] + angle[1] + angle[2], axis.normalized());
        expect_poses(hinge, {1}, {Pose(foot - turn * foot, Quaterniond(turn))});
        const std::vector<Vector3d> places{random.vector(1), random.vector(1), random.vector(1), random.vector(1)};
        const TrueMotion path = true_polynomial(places);
        const Vector3d middle = places[0] + places[1] / 2 + places[2] / 4 + places[3] / 8;
        expect_poses(path, {0, 0.5}, {Pose(places[0], Quaterniond::Identity()), Pose(middle, Quaterniond::Identity())});
        const Vector3d point = random.vector(2);
        const double time = random.integer(100, 900) * 0x1p-10;
        tight += expect_within_bounds(hinge, point, time) ? 1 : 0;
        tight += expect_within_bounds(path, point, time) ? 1 : 0;
        expect_within_bounds(true_product(path, true_product(true_rest(random_ends(random).start), hinge)), point,
                             time);
    }
    EXPECT_GT(tight, 200);
}

TEST(TrajectoryReference, TracksAndSplinesKeepTheirBounds) {
    int tight = 0;
    for (std::uint64_t index = 0; index < 200; ++index) {
        AttackRandom random(5, 4, index);
        const auto [first, second] = random_ends(random);
        const auto [third, fourth] = random_ends(random);
        const std::vector<Pose> poses{first, second, third, fourth};
        const std::vector<double> times{0, random.uniform(0.1, 0.3), random.uniform(0.4, 0.8), 1};
        std::vector<TrueMotion> motions;
        for (std::size_t i = 0; i < 3; ++i)
            motions.push_back(true_twist(poses[i], poses[i + 1]));
        const TrueMotion track = true_track(times, motions);
        expect_poses(track, times, poses);
        const TrueMotion spline = true_b_spline(poses);
        expect_poses(spline, {0, 1}, {first, fourth});
        const Vector3d point = random.vector(2);
        const double time = random.integer(100, 900) * 0x1p-10;
        tight += expect_within_bounds(track, point, time) ? 1 : 0;
        tight += expect_within_bounds(spline, point, time) ? 1 : 0;
        expect_within_bounds(true_product(true_inverse(track), spline), point, time);
    }
    EXPECT_GT(tight, 100);
}

/// A whole turn meets no post that it had not met after a part of it; a track jumps within a rounding of time.
TEST(TrajectoryReference, ATouchInALaterPartIsFound) {
    const Shape bar = triangle({1, 0, 0}, {9, 0, 0}, {5, -1, 0});
    const Shape post = triangle({0, 4, -1}, {0, 4, 1}, {-1, 4, 0});
    expect_touch(first_touch(bar, post, true_hinge({0, 0, 0}, {0, 0, 3}, {0.0, 16.0})), pi / 32);
    expect_touch(first_touch(bar, post, true_hinge({0, 0, 0}, {0, 0, 3}, {2.5, 8.0})), (2.5 * pi - 2.5) / 8);
    const Shape floor = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    const Pose below(Vector3d(0, 0, -2), Quaterniond::Identity());
    const double next = std::nextafter(0.5, 1);
    const TrueMotion jump = true_track(
        {0, 0.5, next, 1}, {true_twist(at_rest, at_rest), true_twist(at_rest, below), true_twist(below, below)});
    const TrueTouch found = first_touch(triangle({1, 1, 1}, {1, 2, 3}, {2, 1, 3}), floor, jump);
    EXPECT_EQ(found.lower, 0.5);
    EXPECT_EQ(found.upper, next);
}

TEST(TrajectoryReference, ProductsAndInversesKeepTheirBounds) {
    int tight = 0;
    for (std::uint64_t index = 0; index < 200; ++index) {
        AttackRandom random(5, 2, index);
        const auto [start, goal] = random_ends(random);
        const auto [from, to] = random_ends(random);
        const Vector3d point = random.vector(2);
        const double time = random.integer(100, 900) * 0x1p-10;
        const TrueMotion moving = true_velocity(start, goal, random.vector(2));
        const TrueMotion frame = true_twist(from, to);
        const TrueMotion seen = true_product(true_inverse(frame), moving);
        tight += expect_within_bounds(true_inverse(moving), point, time) ? 1 : 0;
        tight += expect_within_bounds(true_product(moving, frame), point, time) ? 1 : 0;
        tight += expect_within_bounds(seen, point, time) ? 1 : 0;
        const Vector3d back = narrowed(frame.at(time)) * (narrowed(seen.at(time)) * point);
        EXPECT_LT((back - narrowed(moving.at(time)) * point).norm(), 1e-13);
    }
    EXPECT_GT(tight, 30);
}

} // namespace
} // namespace chasles::attack
