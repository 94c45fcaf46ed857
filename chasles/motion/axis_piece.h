// A span of a motion about or along one axis as a piece of a trajectory: a cubic motion that is the true one, with a
// clock of its own. Source: docs/derivations/35-one-axis.md.
#pragma once

#include "chasles/motion/axis_way.h"
#include "chasles/motion/smooth_trajectory.h"

namespace chasles::motion {

class AxisPiece {
public:
    /// Keeps the span by reference.
    AxisPiece(SmoothMotion motion, const AxisSpan& span);

    [[nodiscard]] const RationalMotion<algebra::DoubleDouble>& cubic() const { return cubic_; }
    [[nodiscard]] std::optional<ExactMotion> exact() const;
    [[nodiscard]] static std::optional<Enclosure<double>> enclosure(const Bracket&) { return std::nullopt; }
    [[nodiscard]] static std::optional<Enclosure<algebra::DoubleDouble>> refined_enclosure(const Bracket&) {
        return std::nullopt;
    }
    [[nodiscard]] static bool is_refined() { return false; }

    [[nodiscard]] Bracket time_of(const Bracket& tau) const;
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const { return time_of(tau); }
    [[nodiscard]] double tau_rate(double tau) const;
    [[nodiscard]] double tau_tolerance(double time_tolerance) const;
    [[nodiscard]] Pose pose_at(double tau) const;
    [[nodiscard]] Pose fixed_pose_at(double tau) const;

private:
    [[nodiscard]] double share_at(double tau) const;
    [[nodiscard]] double rate_of_value(double time) const;
    [[nodiscard]] double least_rate_of_value() const;
    [[nodiscard]] Bracket times_of_shares(const Bracket& shares) const;
    [[nodiscard]] double time_at(double tau) const;

    SmoothMotion motion_;
    const AxisSpan& span_;
    Bracket times_; ///< of the motion
    RationalMotion<algebra::DoubleDouble> cubic_;
    double half_tangent_ = 0; ///< of the turn; 0 for a slide
};

/// The pieces of a motion that goes about or along one axis after another; null for another one.
std::unique_ptr<const AnyPieces> axis_pieces(SmoothMotion motion, std::shared_ptr<const std::vector<AxisSpan>> spans);

} // namespace chasles::motion
