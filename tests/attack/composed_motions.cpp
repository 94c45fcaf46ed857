#include "tests/attack/composed_motions.h"

#include "chasles/motion/timed_poses.h"
#include "tests/attack/check_mesh.h"
#include "tests/attack/trajectory_motions.h"

#include <numbers>
#include <span>

namespace chasles::attack {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::numbers::pi;

std::string text_of(const char* name, std::span<const double> numbers) {
    std::string text = name;
    char buffer[40];
    for (const double number : numbers) {
        std::snprintf(buffer, sizeof buffer, " %a", number);
        text += buffer;
    }
    return text + "\n";
}

std::string text_of(const char* name, const Vector3d& v) {
    return text_of(name, std::span(v.data(), 3));
}

std::string text_of(const std::vector<Pose>& poses) {
    std::string text;
    for (const Pose& pose : poses)
        text += described("pose", pose);
    return text;
}

double power_of_ten(AttackRandom& random, double lower, double upper) {
    return std::pow(10, random.uniform(lower, upper));
}

Vector3d any_direction(AttackRandom& random) {
    if (random.chance(0.3))
        return random.grid_direction(2).cast<double>();
    const double length = random.chance(0.5) ? 1 : power_of_ten(random, -6, 6);
    return random.vector(1).normalized() * length;
}

/// Within some units, or zero.
Vector3d any_place(AttackRandom& random, bool is_simple, double unit) {
    if (is_simple)
        return random.grid(2).cast<double>() * unit;
    const double kind = random.uniform(0, 1);
    return kind < 0.2 ? Vector3d(Vector3d::Zero()) : Vector3d(random.vector(kind < 0.9 ? 2 : 20) * unit);
}

/// Coefficients of an angle. The whole turn is at most about `most`.
std::vector<double> any_angle(AttackRandom& random, bool is_simple, double most) {
    const int degree = random.integer(1, 3);
    if (is_simple) {
        std::vector<double> angle{0};
        for (int i = 0; i < degree; ++i)
            angle.push_back(random.chance(0.5) ? pi / 2 * random.integer(-2, 2) : random.integer(-2, 2));
        return angle;
    }
    const double kind = random.uniform(0, 1);
    const double turn = kind < 0.15 ? power_of_ten(random, -9, -3) : kind < 0.7 ? std::min(pi, most) : most;
    std::vector<double> angle{random.chance(0.5) ? 0 : random.uniform(-3, 3)};
    for (int i = 0; i < degree; ++i)
        angle.push_back(random.uniform(-1, 1) * turn / std::sqrt(degree));
    return angle;
}

MotionCase any_hinge(AttackRandom& random, bool is_simple, double unit, double most) {
    const Vector3d point = any_place(random, is_simple, unit);
    const Vector3d direction = is_simple ? Vector3d(random.grid_direction(1).cast<double>()) : any_direction(random);
    const std::vector<double> angle = any_angle(random, is_simple, most);
    return {Motion::hinge(point, direction, angle), true_hinge(point, direction, angle),
            "hinge\n" + text_of(" point", point) + text_of(" direction", direction) + text_of(" angle", angle)};
}

MotionCase any_path(AttackRandom& random, bool is_simple, double unit) {
    std::vector<Vector3d> places{any_place(random, is_simple, unit)};
    std::string text = "polynomial\n" + text_of(" place", places.front());
    for (int degree = random.integer(1, 4); degree > 0; --degree) {
        const double size = random.chance(0.8) ? 3 : power_of_ten(random, -6, 1);
        places.emplace_back(is_simple ? any_place(random, true, unit) : Vector3d(random.vector(size) * unit));
        text += text_of(" place", places.back());
    }
    return {Motion::polynomial(places), true_polynomial(places), text};
}

/// The turn from one orientation to the next.
Quaterniond any_turn(AttackRandom& random, double most) {
    const double kind = random.uniform(0, 1);
    const double angle = kind < 0.15   ? power_of_ten(random, -9, -3)
                         : kind < 0.85 ? random.uniform(0, most)
                                       : most - power_of_ten(random, -15, -1);
    return Quaterniond(Eigen::AngleAxisd(angle, any_direction(random).normalized()));
}

/// Small whole numbers; the turns are quarter turns and thirds of a turn.
Quaterniond simple_turn(AttackRandom& random) {
    const Eigen::Vector3i v = random.grid_direction(1);
    return v.squaredNorm() == 2 ? Quaterniond(2, v.x(), v.y(), v.z()) : Quaterniond(1, v.x(), v.y(), v.z());
}

/// Poses along a way. Consecutive ones differ by at most the turn `most`.
std::vector<Pose> any_poses(AttackRandom& random, bool is_simple, double unit, double most) {
    Quaterniond orientation = Quaterniond::Identity();
    if (!is_simple && random.chance(0.7)) {
        const Vector3d v = random.vector(1);
        orientation = Quaterniond(random.uniform(-1, 1), v.x(), v.y(), v.z());
    }
    Vector3d place = any_place(random, is_simple, unit);
    std::vector<Pose> poses{Pose(place, orientation)};
    for (int count = random.integer(2, 4); count > 0; --count) {
        if (!random.chance(0.2)) // else exactly no turn
            orientation = (is_simple ? simple_turn(random) : any_turn(random, most)) * orientation;
        if (!random.chance(0.1))
            place += any_place(random, is_simple, unit);
        const double length = is_simple || random.chance(0.5) ? 1 : -power_of_ten(random, -6, 6);
        poses.emplace_back(place, Quaterniond(orientation.coeffs() * length));
    }
    return poses;
}

/// From 0 to 1.
std::vector<double> any_stamps(AttackRandom& random, bool is_simple, std::size_t count) {
    std::vector<double> stamps{0};
    const bool is_even = is_simple || random.chance(0.3);
    for (std::size_t i = 1; i < count; ++i)
        stamps.push_back(is_even ? double(i) : stamps.back() + random.uniform(0.05, 1));
    const double last = stamps.back();
    for (double& stamp : stamps)
        stamp /= last;
    if (!is_simple && random.chance(0.1)) // two stamps are close
        stamps[1] = random.chance(0.5) ? std::nextafter(stamps[2], 0) : stamps[2] - power_of_ten(random, -14, -3);
    return stamps;
}

MotionCase any_even(AttackRandom& random, bool is_simple, double unit) {
    return random.chance(0.5) ? velocity_case(random, is_simple, unit) : twist_case(random, is_simple, unit);
}

/// Seldom a motion that is a product itself.
MotionCase any_motion(AttackRandom& random, bool is_simple, double unit) {
    constexpr std::array kinds{hinge_case, hinge_case, polynomial_case, b_spline_case, track_case, any_even};
    return random.pick(kinds)(random, is_simple, unit);
}

MotionCase carried(const MotionCase& outer, const MotionCase& inner) {
    return {outer.motion * inner.motion, true_product(outer.truth, inner.truth),
            outer.text + "that carries\n" + inner.text};
}

} // namespace

MotionCase hinge_case(AttackRandom& random, bool is_simple, double unit) {
    return any_hinge(random, is_simple, unit, 20);
}

MotionCase polynomial_case(AttackRandom& random, bool is_simple, double unit) {
    const MotionCase path = any_path(random, is_simple, unit);
    return random.chance(0.5) ? path : carried(path, any_hinge(random, is_simple, unit, 20));
}

MotionCase b_spline_case(AttackRandom& random, bool is_simple, double unit) {
    const std::vector<Pose> poses = any_poses(random, is_simple, unit, 3.1);
    return {Motion::b_spline(poses), true_b_spline(poses), "B-spline\n" + text_of(poses)};
}

MotionCase track_case(AttackRandom& random, bool is_simple, double unit) {
    std::vector<Pose> poses = any_poses(random, is_simple, unit, pi);
    if (random.chance(0.3)) // one more, where the body has been before
        poses.push_back(poses[1]);
    const std::vector<double> stamps = any_stamps(random, is_simple, poses.size());
    if (stamps[2] - stamps[1] < 1e-15) // the library refuses a turn by more than 0.25 within one rounding of time
        poses[2].rotation = poses[1].rotation;
    const bool is_twist = random.chance(0.5);
    const Vector3d centre = is_twist ? Vector3d(Vector3d::Zero()) : any_place(random, is_simple, unit);
    std::vector<TrueMotion> motions;
    for (std::size_t i = 0; i + 1 < poses.size(); ++i)
        motions.push_back(is_twist ? true_twist(poses[i], poses[i + 1])
                                   : true_velocity(poses[i], poses[i + 1], centre));
    const auto between = is_twist ? TimedPoses::Between::twist : TimedPoses::Between::velocity;
    return {TimedPoses::through(stamps, poses, between, centre), true_track(stamps, motions),
            (is_twist ? "track of twists\n" : "track of velocities\n") + text_of(" stamps", stamps) +
                text_of(" centre", centre) + text_of(poses)};
}

MotionCase product_case(AttackRandom& random, bool is_simple, double unit) {
    const MotionCase outer = any_motion(random, is_simple, unit);
    return carried(outer, any_motion(random, is_simple, unit));
}

MotionCase chain_case(AttackRandom& random, bool is_simple, double unit) {
    MotionCase chain = any_hinge(random, is_simple, unit, 2 * pi);
    for (int links = random.integer(2, 4); links > 0; --links) {
        const Quaterniond turn = is_simple ? simple_turn(random) : any_turn(random, pi);
        const double length = random.chance(0.5) ? 1 : power_of_ten(random, -6, 6);
        const Pose link(any_place(random, is_simple, unit), Quaterniond(turn.coeffs() * length));
        chain = carried(chain, {Motion::at_rest(link), true_rest(link), described("link", link)});
        chain = carried(chain, any_hinge(random, is_simple, unit, 2 * pi));
    }
    return chain;
}

MotionCase both_case(AttackRandom& random, bool is_simple, double unit) {
    const auto any = [&] {
        return random.chance(0.2) ? product_case(random, is_simple, unit) : any_motion(random, is_simple, unit);
    };
    const MotionCase moving = any();
    const MotionCase fixed = any();
    return {relative(moving.motion, fixed.motion), true_product(true_inverse(fixed.truth), moving.truth),
            moving.text + "as seen from\n" + fixed.text};
}

} // namespace chasles::attack
