// The relation between the paper's parameter tau of a screw and time, for one pair of poses.
// Source: docs/derivations/01-screw-from-two-poses.md.
#pragma once

#include "chasles/motion/screw_path.h"

#include <cstddef>

namespace chasles::motion {

/// The number of equal turns of at most `max_turn` radians each, up to rounding. Every one also stays far enough below
/// a half turn for a half-angle tangent of at most 1000.
std::size_t equal_turns(double angle, double max_turn);

/// tau(time) = tan(angle * time / 2) / tan(angle / 2). For a translation tau equals time.
class ScrewClock {
public:
    using Scalar = algebra::DoubleDouble;
    ScrewClock(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal) : turn_(turn_angle(start, goal)) {}
    /// `turn` is turn_between the two poses.
    explicit ScrewClock(const Quaternion<Scalar>& turn) : turn_(turn_angle(turn)) {}

    [[nodiscard]] double angle() const { return turn_.angle; } ///< in radians, in [0, pi]

    [[nodiscard]] double tau_at(double time) const;  ///< [0, 1] -> [0, 1]
    [[nodiscard]] double time_at(double tau) const;  ///< the inverse of tau_at
    [[nodiscard]] double tau_rate(double tau) const; ///< dtau/dtime at this tau

    /// The number of equal pieces with a rotation of at most `max_turn` radians each.
    [[nodiscard]] std::size_t piece_count(double max_turn) const { return equal_turns(turn_.angle, max_turn); }
    /// Whether one piece suffices without a limit by `max_turn`, up to rounding.
    [[nodiscard]] bool is_short() const;

private:
    TurnAngle turn_;
};

} // namespace chasles::motion
