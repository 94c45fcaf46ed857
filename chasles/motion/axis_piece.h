// A span of a motion about or along one axis as a piece of a trajectory: a cubic motion that is the true one, with a
// clock of its own. Source: docs/derivations/35-one-axis.md.
#pragma once

#include "chasles/motion/axis_way.h"
#include "chasles/motion/screw_clock.h"
#include "chasles/motion/smooth_trajectory.h"

namespace chasles::motion {

class AxisPiece : public NotEnclosed {
public:
    AxisPiece(SmoothMotion motion, std::shared_ptr<const AxisSpan> span);

    [[nodiscard]] const RationalMotion<algebra::DoubleDouble>& cubic() const { return cubic_; }
    [[nodiscard]] std::optional<ExactMotion> exact() const;

    [[nodiscard]] Bracket time_of(const Bracket& tau) const;
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const { return time_of(tau); }
    [[nodiscard]] double tau_rate(double tau) const;
    [[nodiscard]] double tau_tolerance(double time_tolerance) const;
    [[nodiscard]] Pose pose_at(double tau) const;
    [[nodiscard]] Pose fixed_pose_at(double tau) const;

private:
    [[nodiscard]] const AxisSection& section() const { return span_->way->section; }
    [[nodiscard]] bool runs_evenly() const;
    [[nodiscard]] Bracket times_of_shares(const Bracket& shares) const;
    [[nodiscard]] double time_at(double tau) const;
    [[nodiscard]] double local(double time) const;
    [[nodiscard]] double global(double time) const;
    [[nodiscard]] double share_rate(double time) const;
    [[nodiscard]] double least_share_rate() const;

    SmoothMotion motion_;
    std::shared_ptr<const AxisSpan> span_;
    Bracket times_; ///< of the motion
    RationalMotion<algebra::DoubleDouble> cubic_;
    ScrewClock clock_; ///< of the share of the way
};

/// The pieces of a motion that goes about or along one axis after another; null for another one.
std::unique_ptr<const AnyPieces> axis_pieces(SmoothMotion motion, std::shared_ptr<const std::vector<AxisSpan>> spans);

} // namespace chasles::motion
