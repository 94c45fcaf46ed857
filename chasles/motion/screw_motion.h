// The paper's in-between motion: one screw from the start pose to the goal pose (paper, section 1.2).
#pragma once

#include "chasles/motion/motion_ends.h"

#include <cstddef>
#include <vector>

namespace chasles {

/// Rotation by angle() * time about a fixed axis while sliding along it by slide() * tau(time), where
/// tau(time) = tan(angle * time / 2) / tan(angle / 2), and tau = time for a translation. Both end poses are kept
/// exactly. Source: paper section 1.2; docs/derivations/01-screw-from-two-poses.md.
class ScrewMotion {
public:
    /// The motion of one body from `start` to `goal`, both in the frame of the fixed body, which is the world.
    static ScrewMotion between(const Pose& start, const Pose& goal);

    /// The paper's motion for two moving bodies: the screw of the moving body as seen from the other one, which is
    /// called fixed. All four poses are in the world. The fixed body itself runs along its own screw in the world.
    static ScrewMotion relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                const Pose& fixed_goal);

    /// Turn in [0, pi], radians.
    [[nodiscard]] double angle() const;
    /// Signed travel along axis_direction(), mesh unit.
    [[nodiscard]] double slide() const;
    /// Unit vector in the fixed body's frame. Of the travel if nothing turns; 0 0 1 if nothing moves.
    [[nodiscard]] Eigen::Vector3d axis_direction() const;
    /// The axis point nearest to the start position of the body's origin; that position itself if nothing turns.
    /// In the fixed body's frame.
    [[nodiscard]] Eigen::Vector3d axis_point() const;

    [[nodiscard]] double tau_at(double time) const;  ///< the paper's parameter, [0, 1] -> [0, 1]
    [[nodiscard]] double time_at(double tau) const;  ///< its inverse
    [[nodiscard]] double tau_rate(double tau) const; ///< dtau/dtime at a tau
    [[nodiscard]] Pose pose_at(double time) const;   ///< of the moving body in the world

    /// The poses that the motion is made from.
    [[nodiscard]] const MotionEnds& ends() const { return ends_; }

    /// What the elementary detections are built from. Its motion is defined for turns that cut(pi) leaves whole.
    [[nodiscard]] MotionFrame frame() const;

    /// The screw in equal turns of at most `max_turn` radians, in order; each piece is one of the paper's motions
    /// between poses rounded to double precision. A screw that turns by pi exactly, or too near for its half-angle
    /// tangent, is cut in two whatever `max_turn`. Throws InvalidInput if max_turn is less than least_max_turn.
    [[nodiscard]] std::vector<ScrewMotion> cut(double max_turn) const;

    /// How many pieces cut() gives, and one of them, from 0; for long screws that need not be held whole.
    [[nodiscard]] std::size_t piece_count(double max_turn) const;
    [[nodiscard]] ScrewMotion piece(std::size_t index, std::size_t count) const;

    /// The least max_turn, radians: a screw has some ten thousand pieces at most.
    static constexpr double least_max_turn = 1e-4;

private:
    explicit ScrewMotion(const MotionEnds& ends) : ends_(ends) {}
    ScrewMotion(const Pose& start, const Pose& goal) : ends_(MotionEnds::between(start, goal)) {}

    MotionEnds ends_; ///< the numbers are made when they are asked for: most motions of a plan are told clear without
};

} // namespace chasles
