// Motions in multiprecision, written anew from what the headers promise. Nothing here uses the library's motions.
#pragma once

#include "chasles/motion/pose.h"

#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/gmp.hpp>
#include <functional>

namespace chasles::attack {

/// A number of about 256 bits.
using Wide = boost::multiprecision::number<boost::multiprecision::gmp_float<77>, boost::multiprecision::et_off>;
using WideVector = Eigen::Matrix<Wide, 3, 1>;
using WideMatrix = Eigen::Matrix<Wide, 3, 3>;

/// The body point x is at turn * x + place in the frame of the fixed body.
struct TruePose {
    WideMatrix turn;
    WideVector place;
};

/// Upper bounds at all times of [0, 1], where the whole motion takes one unit of time.
struct TrueRates {
    double turn_rate = 0;                                ///< radians
    double turn_acceleration = 0;                        ///< change of the angular velocity
    double speed = 0;                                    ///< of the reference
    double acceleration = 0;                             ///< of the reference
    Eigen::Vector3d reference = Eigen::Vector3d::Zero(); ///< a point of the moving body
};

/// All that the reference needs of a motion. A new motion is one more function that returns this struct.
struct TrueMotion {
    std::function<TruePose(double time)> at;
    TrueRates rates;
};

/// The body turns evenly the shorter way round, while the body point `centre` moves evenly on a straight line.
TrueMotion true_velocity(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre);

/// The body turns evenly the shorter way round about the axis of the screw, and slides evenly along the axis.
TrueMotion true_twist(const Pose& start, const Pose& goal);

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
