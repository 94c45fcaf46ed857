#include "chasles/motion/screw_clock.h"


#include <cmath>
#include <numbers>

namespace chasles::motion {

namespace {

/// The half-angle tangent of a longer turn exceeds 1000, and the error bounds grow with it.
constexpr double largest_turn = std::numbers::pi - 2e-3;
/// Turns that exceed a whole number of pieces by this part, which is rounding, get no further piece.
constexpr double turn_slack = 1e-9;
/// Below this turn, tau and time differ by less than half an ulp (their ratio is 1 + O(angle^2)).
constexpr double uniform_turn = 1e-9;

} // namespace

double ScrewClock::tau_at(double time) const {
    if (time <= 0 || time >= 1) // the ends to the last bit
        return time <= 0 ? 0 : 1;
    return turn_.angle < uniform_turn ? time : std::tan(turn_.angle / 2 * time) / turn_.half_tangent;
}

double ScrewClock::time_at(double tau) const {
    const double tangent = turn_.half_tangent; // itself to the last bit: the arc tangents then lose none
    return turn_.angle < uniform_turn ? tau : std::atan(tau * tangent) / std::atan(tangent);
}

double ScrewClock::tau_rate(double tau) const {
    const double tangent = turn_.half_tangent;
    return turn_.angle < uniform_turn ? 1 : std::atan(tangent) / tangent * (1 + tau * tau * tangent * tangent);
}

std::size_t ScrewClock::piece_count(double max_turn) const {
    const double count = std::ceil(turn_.angle / std::min(max_turn, largest_turn) * (1 - turn_slack));
    return std::max<std::size_t>(1, static_cast<std::size_t>(count));
}

bool ScrewClock::is_short() const {
    return turn_.angle <= largest_turn * (1 + 2 * turn_slack);
}

} // namespace chasles::motion
