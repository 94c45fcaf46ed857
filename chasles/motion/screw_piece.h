// A screw with the numbers made that queries ask for again and again.
#pragma once

#include "chasles/motion/motion_ends.h"
#include "chasles/motion/screw_clock.h"

namespace chasles::motion {

/// The paper's motion between two poses. Where a screw turns too far to be one (ScrewClock::is_short), only its clock,
/// its end poses and pose_at() are.
class ScrewPiece {
public:
    explicit ScrewPiece(const MotionEnds& ends);

    [[nodiscard]] const MotionFrame& frame() const { return frame_; }
    [[nodiscard]] const ScrewClock& clock() const { return clock_; }

    [[nodiscard]] double time_at(double tau) const { return clock_.time_at(tau); }
    [[nodiscard]] double tau_rate(double tau) const { return clock_.tau_rate(tau); }
    [[nodiscard]] Pose pose_at(double time) const; ///< of the moving body in the world

private:
    MotionFrame frame_;
    ScrewClock clock_;
};

/// The equal turns of a screw, one after another, for less than one by one.
class ScrewPieces {
public:
    /// In `count` of them; the screw is kept by reference.
    ScrewPieces(const MotionFrame& screw, std::size_t count);

    /// The end poses of one; those between two pieces are rounded to double precision.
    [[nodiscard]] MotionEnds operator[](std::size_t index) const;

private:
    const MotionFrame& screw_;
    std::size_t count_;
    std::optional<ScrewPath> path_; ///< none where the screw is the only piece
};

} // namespace chasles::motion
