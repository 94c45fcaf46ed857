// The members of the family: screws and sweeps have the right end poses, exactly in rationals.
#include "chasles/motion/rational_motion.h"

#include "tests/support/rational_motions.h"

namespace chasles::motion {
namespace {

using namespace test;
using Vector = Vector3<Rational>;
using RationalPose = GeneralPose<Rational>;

Vector random_vector(Random& random) {
    Vector v;
    for (int i = 0; i < 3; ++i)
        v[i] = ratio(random.integer(-12, 12), random.integer(1, 5));
    return v;
}

RationalPose random_pose(Random& random) {
    return {random_vector(random), {ratio(random.integer(1, 9), 4), random_vector(random)}};
}

Vector placed(const RationalPose& pose, const Vector& point) {
    return turned(point, pose.rotation.w, pose.rotation.v) + pose.translation;
}

Vector position(const RationalMotion<Rational>& motion, const Vector& point, const Rational& tau) {
    const auto maps = control_maps(motion);
    const Vector carried = test::value_at(maps.rotation * point + maps.translation, tau);
    return scale(carried, Rational(1 / algebra::value_at(maps.weight, tau)));
}

void expect_equal(const Vector& a, const Vector& b) {
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(a[i], b[i]) << "component " << i;
}

TEST(RotationMatrix, TurnsAsRodriguesFormulaDoes) {
    Random random(621);
    for (int trial = 0; trial < 50; ++trial) {
        const RationalPose pose = random_pose(random);
        const Vector v = random_vector(random);
        expect_equal(rotation_matrix(pose.rotation) * v, turned(v, pose.rotation.w, pose.rotation.v));
        expect_equal(rotated(pose.rotation, v), turned(v, pose.rotation.w, pose.rotation.v));
    }
}

TEST(Quaternion, ProductTurnsByTheRightFactorFirst) {
    Random random(622);
    for (int trial = 0; trial < 50; ++trial) {
        const Quaternion<Rational> a = random_pose(random).rotation;
        const Quaternion<Rational> b = random_pose(random).rotation;
        const Vector v = random_vector(random);
        expect_equal(rotation_matrix(a * b) * v, turned(turned(v, b.w, b.v), a.w, a.v));
        expect_equal(rotation_matrix(a.conjugate() * a) * v, v);
        EXPECT_EQ((a * b).squared_norm(), a.squared_norm() * b.squared_norm());
    }
}

TEST(TurnBetween, CarriesStartToGoalTheShortWay) {
    Random random(623);
    for (int trial = 0; trial < 50; ++trial) {
        const RationalPose start = random_pose(random);
        const RationalPose goal = random_pose(random);
        const Quaternion<Rational> turn = turn_between(start, goal);
        const Vector v = random_vector(random);
        EXPECT_GE(turn.w, 0);
        expect_equal(turned(turned(v, start.rotation.w, start.rotation.v), turn.w, turn.v),
                     turned(v, goal.rotation.w, goal.rotation.v));
    }
}

TEST(ScrewBetween, KeepsBothEndPosesExactly) {
    Random random(624);
    for (int trial = 0; trial < 100; ++trial) {
        const RationalPose start = random_pose(random);
        const RationalPose goal = random_pose(random);
        if (turn_between(start, goal).w == 0)
            continue;
        const auto screw = screw_between(start, goal);
        const Vector b = random_vector(random);
        expect_equal(position(screw, b, 0), placed(start, b));
        expect_equal(position(screw, b, 1), placed(goal, b));
    }
}

TEST(ScrewBetween, RecoversTheScrewThatMadeTheGoal) {
    Random random(625);
    for (int trial = 0; trial < 100; ++trial) {
        const Vector tangent = scale(random_vector(random), ratio(1, 8));
        const PlainScrew plain{random_vector(random), tangent, scale(tangent, ratio(random.integer(-9, 9), 2))};
        const RationalPose goal{plain.position({}, 1), {Rational(3), scale(tangent, Rational(3))}};
        const auto screw = screw_between(RationalPose{{}, {Rational(1), {}}}, goal);
        const Vector b = random_vector(random);
        const Rational tau = ratio(random.integer(0, 7), 7);
        expect_equal(position(screw, b, tau), plain.position(b, tau));
    }
}

TEST(ScrewBetween, QuaternionsOfAnyPositiveLengthGiveTheSameMotion) {
    Random random(626);
    const RationalPose start = random_pose(random);
    const RationalPose goal = random_pose(random);
    const auto longer = [](RationalPose pose, const Rational& factor) {
        pose.rotation = {Rational(pose.rotation.w * factor), scale(pose.rotation.v, factor)};
        return pose;
    };
    const auto one = screw_between(start, goal);
    const auto other = screw_between(longer(start, ratio(7, 3)), longer(goal, ratio(1, 100)));
    const Vector b = random_vector(random);
    expect_equal(position(one, b, ratio(1, 3)), position(other, b, ratio(1, 3)));
    const auto opposite = screw_between(start, longer(goal, Rational(-1)));
    expect_equal(position(one, b, ratio(1, 3)), position(opposite, b, ratio(1, 3)));
}

TEST(ScrewBetween, WithoutATurnIsAStraightLine) {
    Random random(627);
    const RationalPose start = random_pose(random);
    RationalPose goal = start;
    goal.translation = random_vector(random);
    const auto screw = screw_between(start, goal);
    const Vector b = random_vector(random);
    for (const Rational& tau : {ratio(1, 3), ratio(5, 7)})
        expect_equal(position(screw, b, tau), placed(start, b) + scale(goal.translation - start.translation, tau));
}

/// The square of a quaternion over its squared length has length one and stays rational.
Quaternion<Rational> unit_square(const Quaternion<Rational>& q) {
    const Rational inverse = 1 / q.squared_norm();
    const Quaternion<Rational> square = q * q;
    return {Rational(square.w * inverse), scale(square.v, inverse)};
}

struct Sweep {
    RationalPose start;
    RationalPose goal;
    Vector centre;
    RationalMotion<Rational> motion;
};

Sweep random_sweep(Random& random) {
    Sweep sweep{random_pose(random), {}, random_vector(random), {}};
    Quaternion<Rational> turn = unit_square(random_pose(random).rotation);
    if (turn.w < 0)
        turn = {Rational(-turn.w), Vector() - turn.v};
    sweep.goal = {random_vector(random), turn * sweep.start.rotation};
    sweep.motion = sweep_between(sweep.start, sweep.goal, turn, sweep.centre);
    return sweep;
}

TEST(SweepBetween, KeepsBothEndPosesExactly) {
    Random random(628);
    for (int trial = 0; trial < 60; ++trial) {
        const Sweep sweep = random_sweep(random);
        const Vector b = random_vector(random);
        expect_equal(position(sweep.motion, b, 0), placed(sweep.start, b));
        expect_equal(position(sweep.motion, b, 1), placed(sweep.goal, b));
    }
}

TEST(SweepBetween, CentreRunsStraight) {
    Random random(629);
    for (int trial = 0; trial < 60; ++trial) {
        const Sweep sweep = random_sweep(random);
        const Rational tau = ratio(random.integer(0, 9), 9);
        const Vector from = placed(sweep.start, sweep.centre);
        const Vector to = placed(sweep.goal, sweep.centre);
        expect_equal(position(sweep.motion, sweep.centre, tau), from + scale(to - from, tau));
    }
}

TEST(SweepBetween, BackwardsVisitsTheSamePoses) {
    Random random(630);
    for (int trial = 0; trial < 60; ++trial) {
        const Sweep sweep = random_sweep(random);
        const Quaternion<Rational> back{sweep.motion.end_cosine, Vector() - sweep.motion.axis};
        const auto reverse = sweep_between(sweep.goal, sweep.start, back, sweep.centre);
        const Vector b = random_vector(random);
        const Rational tau = ratio(random.integer(0, 9), 9);
        expect_equal(position(reverse, b, tau), position(sweep.motion, b, 1 - tau));
    }
}

} // namespace
} // namespace chasles::motion
