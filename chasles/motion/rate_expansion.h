// The rates of a frame about the middle of an interval. They sharpen the bounds of frames that are composed.
// Source: docs/derivations/26-frames.md, "Sharper bounds".
#pragma once

#include "chasles/motion/enclosure.h"

#include <limits>

namespace chasles::motion {

/// A frame in the middle of an interval of time, and bounds of its rates during the interval. Vectors are in the fixed
/// frame, per unit of time. Where the third rates have no bound, the vectors do not count.
struct RateExpansion {
    GeneralPose<double> pose{};
    Vector3<double> reference{};         ///< its place
    Vector3<double> turn_rate{};         ///< the angular velocity, radians
    Vector3<double> turn_acceleration{}; ///< the angular acceleration, radians
    Vector3<double> velocity{};          ///< of the reference
    Vector3<double> acceleration{};      ///< of the reference
    RateBounds bounds{};
    RateBounds sums{}; ///< bounds of the sums that the vectors are, term by term: their rounding is 2^-50 of it
    double turn_jerk = std::numeric_limits<double>::infinity(); ///< a bound of the angular jerk, radians
    double jerk = std::numeric_limits<double>::infinity();      ///< a bound of the jerk of the reference
};

/// A bound of the distance of the references of two frames, which changes by at most `change` from the middle on.
/// `size` bounds the sizes of the lengths that enter.
double distance_of_references(const RateExpansion& a, const RateExpansion& b, double size, double change);

/// The frame `inner` carried by the frame `outer`. `half` is half of the duration of the interval; `size` bounds the
/// sizes of the lengths that enter.
RateExpansion carried(const RateExpansion& outer, const RateExpansion& inner, double half, double size);

/// The frame `moving` as seen from the frame `fixed`.
RateExpansion seen_from(const RateExpansion& moving, const RateExpansion& fixed, double half, double size);

/// Rates in the time of a segment, in the time of the whole, in which the segment lasts `duration`; below 0 if it is
/// passed backwards.
RateBounds slowed(const RateBounds& bounds, double duration);
RateExpansion slowed(RateExpansion expansion, double duration);

} // namespace chasles::motion
