// Converts between time and tau by tangents of half angles. Both ends are exact.
// Source: docs/derivations/01-screw-from-two-poses.md.
#include "chasles/motion/screw_clock.h"

#include "chasles/algebra/arc_tangent.h"

#include <cmath>
#include <numbers>

namespace chasles::motion {

namespace {

/// In radians. The half-angle tangent of a longer turn exceeds 1000, and the error bounds grow with the tangent.
constexpr double largest_turn = std::numbers::pi - 2e-3;
/// A turn that exceeds a whole number of pieces by at most this fraction, which is rounding, gets no additional piece.
constexpr double turn_slack = 1e-9;
/// Below this angle in radians, tau and time differ by less than half an ulp: their ratio is 1 + O(angle^2).
constexpr double uniform_turn = 1e-9;

} // namespace

double ScrewClock::tau_at(double time) const {
    if (time <= 0 || time >= 1) // both ends are exact
        return time <= 0 ? 0 : 1;
    return turn_.angle < uniform_turn ? time : algebra::tangent(turn_.angle / 2 * time) / turn_.half_tangent;
}

double ScrewClock::time_at(double tau) const {
    // Half the angle is the arc tangent of the tangent, bit for bit: tau = 1 gives time 1.
    return turn_.angle < uniform_turn ? tau : algebra::arc_tangent(tau * turn_.half_tangent) / (turn_.angle / 2);
}

double ScrewClock::tau_rate(double tau) const {
    const double tangent = turn_.half_tangent;
    return turn_.angle < uniform_turn ? 1 : turn_.angle / 2 / tangent * (1 + tau * tau * tangent * tangent);
}

std::size_t equal_turns(double angle, double max_turn) {
    const double count = std::ceil(angle / std::min(max_turn, largest_turn) * (1 - turn_slack));
    return std::max<std::size_t>(1, static_cast<std::size_t>(count));
}

bool ScrewClock::is_short() const {
    return turn_.angle <= largest_turn * (1 + 2 * turn_slack);
}

} // namespace chasles::motion
