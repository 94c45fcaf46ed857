// The paper's parameter of a screw, and time. Source: docs/derivations/01-screw-from-two-poses.md.
#pragma once

#include "chasles/motion/screw_path.h"

#include <cstddef>

namespace chasles::motion {

/// tau(time) = tan(angle * time / 2) / tan(angle / 2); the same as time for a translation.
class ScrewClock {
public:
    using Scalar = algebra::DoubleDouble;
    ScrewClock(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal) : turn_(turn_angle(start, goal)) {}

    [[nodiscard]] double angle() const { return turn_.angle; } ///< in [0, pi]

    [[nodiscard]] double tau_at(double time) const;  ///< [0, 1] -> [0, 1]
    [[nodiscard]] double time_at(double tau) const;  ///< its inverse
    [[nodiscard]] double tau_rate(double tau) const; ///< dtau/dtime at a tau

    /// Equal turns of at most `max_turn` radians, none of them too near to a half turn for its half-angle tangent.
    [[nodiscard]] std::size_t piece_count(double max_turn) const;
    /// Whether the screw may be left whole, up to rounding.
    [[nodiscard]] bool is_short() const;

private:
    TurnAngle turn_;
};

} // namespace chasles::motion
