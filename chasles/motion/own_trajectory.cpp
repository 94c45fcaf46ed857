// Attacks the bounds of a trajectory: differences of sampled poses refute bounds that are too small.
// Source: docs/derivations/26-frames.md, "The test kit".
#include "chasles/motion/own_trajectory.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/motion/own_frame.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace chasles {

namespace {

using motion::GeneralPose;
using motion::Quaternion;
using motion::Vector3;

/// The sine of half of the angle between two orientations.
double half_sine_between(const Quaternion<double>& a, const Quaternion<double>& b) {
    return std::min(1.0, length((a.conjugate() * b).v));
}

/// The orientation half way of a slerp.
Quaternion<double> half_way(const Quaternion<double>& a, const Quaternion<double>& b) {
    const double sign = a.w * b.w + dot(a.v, b.v) < 0 ? -1 : 1;
    const Quaternion<double> sum{a.w + sign * b.w, a.v + scale(b.v, sign)};
    const double inverse = 1 / std::sqrt(sum.squared_norm());
    return {sum.w * inverse, scale(sum.v, inverse)};
}

/// The poses at the start, in the middle and at the end of an interval.
class Sample {
public:
    Sample(const motion::MovingFrame& frame, const OwnTrajectory& trajectory, double from, double to)
        : duration_(to - from), reference_(motion::vector_in<double>(trajectory.reference)), start_(frame.at(from)),
          middle_(frame.at(0.5 * (from + to))), end_(frame.at(to)), turn_noise_(8 * trajectory.rounding + 0x1p-49),
          noise_(turn_noise_ * frame.size()) {}

    // What the poses prove of each rate, at least.

    [[nodiscard]] double turn_rate() const {
        return (2 * algebra::arc_sine(half_sine_between(start_.rotation, end_.rotation)) - turn_noise_) / duration_;
    }
    [[nodiscard]] double speed() const { return (length(place(end_) - place(start_)) - noise_) / duration_; }
    [[nodiscard]] double acceleration() const {
        const Vector3<double> bend = place(start_) + place(end_) - scale(place(middle_), 2);
        return 4 * (length(bend) - 4 * noise_) / (duration_ * duration_);
    }
    /// For a body that turns at most at `rate`: note 24, "Turns", with the orientation half way. Nothing for a large
    /// turn, which may be more than a half turn.
    [[nodiscard]] double turn_acceleration(double rate) const {
        constexpr double large = 1;
        const double turn = rate * duration_;
        if (turn > large)
            return 0;
        const double sine = half_sine_between(half_way(start_.rotation, end_.rotation), middle_.rotation);
        return 16 * (sine * algebra::cosine(0.25 * turn) - turn * turn * turn / 384 - turn_noise_) /
               (duration_ * duration_);
    }

private:
    [[nodiscard]] Vector3<double> place(const GeneralPose<double>& pose) const { return placed(pose, reference_); }

    double duration_;
    Vector3<double> reference_;
    GeneralPose<double> start_;
    GeneralPose<double> middle_;
    GeneralPose<double> end_;
    double turn_noise_;
    double noise_;
};

} // namespace

std::optional<BrokenBound> find_broken_bound(const OwnTrajectory& trajectory, int intervals, std::uint64_t seed) {
    constexpr double allowance = 1 + 1e-9; // for the rounding of the bounds themselves
    constexpr int halvings = 15;
    const motion::SharedFrame frame = motion::own_frame(trajectory);
    std::mt19937_64 random(seed);
    const auto draw = [&] { return double(random() >> 11) * 0x1p-53; };
    for (int i = 0; i < intervals; ++i) {
        const double from = draw();
        double to = std::min(1.0, from + std::ldexp(1.0, -(i % halvings)));
        for (const double knot : trajectory.knots)
            if (knot > from)
                to = std::min(to, knot);
        if (to - from < 0x1p-20)
            continue;
        const MotionBounds bounds = motion::checked_bounds(trajectory, from, to);
        const Sample sample(*frame, trajectory, from, to);
        const auto broken = [&](const char* name, double stated, double found) {
            return BrokenBound{name, from, to, 0.5 * (from + to), stated, found};
        };
        if (const double found = sample.turn_rate(); found > bounds.turn_rate * allowance)
            return broken("turn_rate", bounds.turn_rate, found);
        if (const double found = sample.speed(); found > bounds.speed * allowance)
            return broken("speed", bounds.speed, found);
        if (const double found = sample.acceleration(); found > bounds.acceleration * allowance)
            return broken("acceleration", bounds.acceleration, found);
        if (const double found = sample.turn_acceleration(bounds.turn_rate);
            found > bounds.turn_acceleration * allowance)
            return broken("turn_acceleration", bounds.turn_acceleration, found);
    }
    return std::nullopt;
}

} // namespace chasles
