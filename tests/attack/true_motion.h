// Motions in multiprecision, written anew from what the headers promise. Nothing here uses the library's motions.
// Natural splines are left out: their second derivatives are rounded to double by definition.
#pragma once

#include "chasles/motion/pose.h"

#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/gmp.hpp>
#include <functional>
#include <vector>

namespace chasles::attack {

/// A number of about 256 bits.
using Wide = boost::multiprecision::number<boost::multiprecision::gmp_float<77>, boost::multiprecision::et_off>;
using WideVector = Eigen::Matrix<Wide, 3, 1>;
using WideMatrix = Eigen::Matrix<Wide, 3, 3>;

/// Covers the rounding of a bound to double.
inline constexpr double bound_rounding = 1 + 1e-12;

/// The body point x is at turn * x + place in the frame of the fixed body.
struct TruePose {
    WideMatrix turn;
    WideVector place;
};

/// Upper bounds during a part of time, where the whole motion takes one unit of time.
struct TrueRates {
    double turn_rate = 0;         ///< radians
    double turn_acceleration = 0; ///< change of the angular velocity
    double speed = 0;             ///< of the reference
    double acceleration = 0;      ///< of the reference
};

/// A part of time in which no velocity jumps.
struct TruePart {
    double from = 0;
    double to = 1;
    TrueRates rates{};

    [[nodiscard]] double middle() const { return from + (to - from) / 2; }
    /// No time of the part is farther from its middle, which is rounded.
    [[nodiscard]] double half() const { return std::max(middle() - from, to - middle()); }
};

/// All that the reference needs of a motion. A new motion is one more function that returns this struct.
struct TrueMotion {
    std::function<TruePose(const Wide& time)> at;
    Eigen::Vector3d reference = Eigen::Vector3d::Zero(); ///< a point of the moving body
    std::vector<TruePart> parts;                         ///< of [0, 1], in order of time
    double size = 0;  ///< sum of the lengths that enter a pose and cancel: the library's rounding grows with it
    int elements = 1; ///< elementary motions in it: likewise
};

/// The body turns evenly the shorter way round, while the body point `centre` moves evenly on a straight line.
TrueMotion true_velocity(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre);

/// The body turns evenly the shorter way round about the axis of the screw, and slides evenly along the axis.
TrueMotion true_twist(const Pose& start, const Pose& goal);

/// The body stays at a pose, whose quaternion is normalised.
TrueMotion true_rest(const Pose& pose);

/// The body turns about a line by the angle sum of angle[k] time^k.
TrueMotion true_hinge(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, const std::vector<double>& angle);

/// The body is shifted by the sum of places[k] time^k.
TrueMotion true_polynomial(const std::vector<Eigen::Vector3d>& places);

/// The uniform cubic B-spline of places, and the cumulative one of orientations, whose ends count three times.
TrueMotion true_b_spline(const std::vector<Pose>& poses);

/// Motion i lasts from times[i] to times[i + 1]. Each has one part, and all have the same reference.
TrueMotion true_track(const std::vector<double>& times, const std::vector<TrueMotion>& motions);

/// The body moves in a frame, which moves itself: `outer` of the frame after `inner` of the body.
TrueMotion true_product(const TrueMotion& outer, const TrueMotion& inner);

/// The resting body seen from the moving one. Two bodies in one world: true_product(true_inverse(fixed), moving).
TrueMotion true_inverse(const TrueMotion& motion);

inline WideVector widened(const Eigen::Vector3d& v) {
    return v.cast<Wide>();
}
inline Eigen::Vector3d narrowed(const WideVector& v) {
    return {double(v.x()), double(v.y()), double(v.z())};
}

/// A pose rounded to double.
Eigen::Isometry3d narrowed(const TruePose& pose);

} // namespace chasles::attack
