// How much a frame departs from a turn about one direction. Where it does not, as in planar mechanisms and on helices,
// the heights of all body points along the direction are known far better than their places.
// Source: docs/derivations/36-heights.md.
#pragma once

#include "chasles/motion/rate_expansion.h"

#include <optional>

namespace chasles::motion {

/// The rates of a frame, in all and across a direction.
struct AxisExpansion {
    RateExpansion all;
    AxisRates across;
};

/// The frame `inner` carried by the frame `outer`. `inner.across` is for the direction as
/// `outer` sees it (`seen_by`).
AxisExpansion carried(const AxisExpansion& outer, const AxisExpansion& inner, double half, double size);

/// The frame `moving` as seen from the frame `fixed`. Both `across` are for the direction in the common frame.
AxisExpansion seen_from(const AxisExpansion& moving, const AxisExpansion& fixed, double half, double size);

/// In the time of the whole, in which the frame lasts `duration`.
std::optional<AxisExpansion> slowed(std::optional<AxisExpansion> expansion, double duration);

/// A direction of the fixed frame as the turning frame sees it in the middle of the interval.
Vector3<double> seen_by(const RateExpansion& frame, const Vector3<double>& direction);

/// A frame that turns about an axis of unit length, at most at these rates, and whose reference is on the axis or at
/// most `arm` beside it.
AxisRates turn_across(const Vector3<double>& axis, const Vector3<double>& direction, double rate, double acceleration,
                      double arm = 0);

} // namespace chasles::motion
