// Bounds the second derivative of paths; the chord deviation is at most step^2 / 8 times this bound.
// Source: docs/derivations/14-node-pairs.md, "Chords".
#include "chasles/motion/chord_deviation.h"

#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

namespace {

/// The relative allowance for about twenty roundings, with a safety factor.
constexpr double rounding = 1e-14;

} // namespace

ChordDeviation::ChordDeviation(const RationalMotion<double>& m, const Ball& moving, const Ball& fixed) {
    cosine_rate_ = m.end_cosine - 1;
    square_ = cosine_rate_ * cosine_rate_ + dot(m.axis, m.axis);
    turn_ = std::sqrt(square_);
    cross_travel_ = length(cross(m.axis, m.displacement));
    const auto swing = [&](const Vector3<double>& centre, double radius, double size) {
        return length(cross(m.axis, centre) + m.moment) + length(m.axis) * (radius + rounding * size) +
               rounding * length(m.moment);
    };
    const Vector3<double> start = m.orientation * vector_in<double>(moving.centre);
    const double of_moving = swing(start, moving.radius, length(start));
    const double of_fixed =
        swing(vector_in<double>(fixed.centre) - m.origin, fixed.radius, fixed.centre.norm() + length(m.origin)) +
        cross_travel_;
    moving_swing_ = std::min(of_moving, of_fixed);
    fixed_swing_ = std::min(of_fixed, of_moving + cross_travel_);
}

double ChordDeviation::of_moving(double from, double to) const {
    const double step = to - from;
    const double weight = least_weight(from, to);
    return 0.5 * step * step * turn_ * moving_swing_ / (weight * std::sqrt(weight)) * (1 + rounding);
}

double ChordDeviation::of_fixed(double from, double to) const {
    const double step = to - from;
    const double weight = least_weight(from, to);
    return 0.5 * step * step * (turn_ * fixed_swing_ / (weight * std::sqrt(weight)) + cross_travel_ / weight) *
           (1 + rounding);
}

/// The least W = 1 + 2 (e1 - 1) tau + |z|^2 tau^2 on [from, to]: at the vertex, or at the end next to the vertex.
double ChordDeviation::least_weight(double from, double to) const {
    const double vertex = square_ > 0 ? std::clamp(-cosine_rate_ / square_, from, to) : from;
    return 1 + vertex * (2 * cosine_rate_ + square_ * vertex);
}

} // namespace chasles::motion
