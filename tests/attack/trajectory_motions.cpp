#include "tests/attack/trajectory_motions.h"

#include "tests/attack/check_mesh.h"

#include <numbers>

namespace chasles::attack {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Ends {
    Pose start;
    Pose goal;
    Vector3d centre = Vector3d::Zero();
};

double power_of_ten(AttackRandom& random, double lower, double upper) {
    return std::pow(10, random.uniform(lower, upper));
}

Quaterniond scaled(const Quaterniond& q, double factor) {
    return Quaterniond(q.coeffs() * factor);
}

/// Small whole numbers, whose products are exact.
Quaterniond whole_quaternion(AttackRandom& random) {
    for (;;) {
        const Eigen::Vector3i v = random.grid(2);
        if (const int w = random.integer(-2, 2); w != 0 || v != Eigen::Vector3i::Zero())
            return Quaterniond(w, v.x(), v.y(), v.z());
    }
}

Quaterniond any_quaternion(AttackRandom& random) {
    if (random.chance(0.3))
        return whole_quaternion(random);
    const Vector3d v = random.vector(1);
    return Quaterniond(random.uniform(-1, 1), v.x(), v.y(), v.z());
}

double any_angle(AttackRandom& random) {
    const int kind = random.integer(0, 9);
    if (kind < 3)
        return power_of_ten(random, -9, -3);
    if (kind < 8)
        return random.uniform(0, std::numbers::pi);
    return std::numbers::pi - power_of_ten(random, -16, -1);
}

/// The orientations at both ends.
std::array<Quaterniond, 2> any_turn(AttackRandom& random) {
    const double kind = random.uniform(0, 1);
    const Eigen::Vector3i grid = random.grid_direction(2);
    if (kind < 0.1) { // exactly a half turn
        const Quaterniond start = whole_quaternion(random);
        return {start, Quaterniond(0, grid.x(), grid.y(), grid.z()) * start};
    }
    const Quaterniond start = random.chance(0.2) ? Quaterniond::Identity() : any_quaternion(random);
    if (kind < 0.22) // exactly none
        return {start, scaled(start, random.pick(std::array{1.0, -1.0, 0x1p-20, 4.0}))};
    if (kind < 0.28) // none or the least possible
        return {start, scaled(start, random.uniform(0.1, 10))};
    const double angle = any_angle(random);
    const Vector3d axis = random.chance(0.3) ? grid.cast<double>() : random.vector(1);
    const Quaterniond turn(Eigen::AngleAxisd(angle, axis.normalized()));
    const double sign = random.chance(0.3) ? -1 : 1; // the same rotation
    return {scaled(start, power_of_ten(random, -6, 6)), scaled(turn * start, sign * power_of_ten(random, -6, 6))};
}

Vector3d any_centre(AttackRandom& random) {
    const double kind = random.uniform(0, 1);
    return kind < 0.4 ? Vector3d::Zero() : random.vector(kind < 0.7 ? 1 : power_of_ten(random, 0, 3));
}

Vector3d any_travel(AttackRandom& random) {
    const double kind = random.uniform(0, 1);
    return kind < 0.1 ? Vector3d::Zero() : random.vector(kind < 0.6 ? 4 : power_of_ten(random, -6, 2));
}

Ends any_ends(AttackRandom& random, double unit) {
    const auto [from, to] = any_turn(random);
    const Vector3d centre = any_centre(random) * unit;
    const Vector3d start = random.chance(0.3) ? Vector3d::Zero() : Vector3d(random.vector(3) * unit);
    const Vector3d swing = from.normalized() * centre - to.normalized() * centre;
    const Vector3d goal = start + any_travel(random) * unit + swing;
    return {Pose(start, from), Pose(goal, to), centre};
}

Ends simple_ends(AttackRandom& random, double unit) {
    Ends ends;
    const Eigen::Vector3i v = random.grid_direction(1);
    const int w = random.integer(0, 1);
    const Quaterniond turn(w, v.x(), v.y(), v.z());
    if (random.chance(0.7))
        ends.goal.rotation = turn;
    ends.goal.translation = random.grid(2).cast<double>() * unit;
    ends.centre = random.grid(1).cast<double>() * unit;
    return ends;
}

MotionCase made(const Ends& ends, Motion motion, TrueMotion truth, const char* name) {
    char centre[160];
    std::snprintf(centre, sizeof centre, " about %a %a %a, a turn by about %.3g\n", ends.centre.x(), ends.centre.y(),
                  ends.centre.z(), truth.parts.front().rates.turn_rate);
    return {std::move(motion), std::move(truth),
            name + (centre + described("start", ends.start)) + described("goal", ends.goal)};
}

} // namespace

MotionCase velocity_case(AttackRandom& random, bool is_simple, double unit) {
    const Ends ends = is_simple ? simple_ends(random, unit) : any_ends(random, unit);
    return made(ends, ConstantVelocity::between(ends.start, ends.goal, ends.centre),
                true_velocity(ends.start, ends.goal, ends.centre), "constant velocity");
}

MotionCase twist_case(AttackRandom& random, bool is_simple, double unit) {
    const Ends ends = is_simple ? simple_ends(random, unit) : any_ends(random, unit);
    return made(ends, ConstantTwist::between(ends.start, ends.goal), true_twist(ends.start, ends.goal),
                "constant twist, centre unused,");
}

} // namespace chasles::attack
