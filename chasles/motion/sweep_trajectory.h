// The sweep as a trajectory: one cubic motion without deviation. Here tau = time.
// Source: docs/derivations/02-rational-motion.md.
#pragma once

#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/motion_ends.h"

namespace chasles::motion {

/// The only piece of a sweep.
class SweepPiece : public NotEnclosed {
public:
    SweepPiece(const MotionEnds& ends, const Eigen::Vector3d& centre);

    [[nodiscard]] const RationalMotion<algebra::DoubleDouble>& cubic() const { return cubic_; }
    [[nodiscard]] std::optional<ExactMotion> exact() const { return exact_sweep(ends_, centre_); }

    [[nodiscard]] Bracket time_of(const Bracket& tau) const;
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const { return time_of(tau); }
    [[nodiscard]] double tau_rate(double) const { return 1; }
    [[nodiscard]] double tau_tolerance(double time_tolerance) const { return time_tolerance; }
    [[nodiscard]] Pose pose_at(double tau) const;
    [[nodiscard]] Pose fixed_pose_at(double tau) const { return ends_.fixed_pose_at(tau); }

private:
    MotionEnds ends_;
    Eigen::Vector3d centre_;
    RelativeEnds relative_;
    RationalMotion<algebra::DoubleDouble> cubic_;
};

/// What a SweepMotion describes.
class SweepTrajectory {
public:
    /// `centre` is the reference point, in the moving body's frame. Throws InvalidInput if it cannot be used.
    SweepTrajectory(const MotionEnds& ends, const Eigen::Vector3d& centre);

    /// The piece, as a sequence of one.
    class Pieces {
    public:
        explicit Pieces(SweepPiece piece) : piece_(std::move(piece)) {}
        [[nodiscard]] std::size_t size() const { return 1; }
        [[nodiscard]] SweepPiece operator[](std::size_t) const { return piece_; }

    private:
        SweepPiece piece_;
    };

    [[nodiscard]] SweepPiece piece() const { return {ends_, centre_}; }
    [[nodiscard]] Pieces pieces() const { return Pieces(piece()); }
    [[nodiscard]] PathBall ball_around_path(const Vector3<double>& point) const;
    [[nodiscard]] static std::size_t coarse_count() { return 1; }
    [[nodiscard]] std::optional<CoarseMotion> coarse(std::size_t /*part*/) const {
        return coarse_sweep(ends_, vector_in<double>(centre_));
    }
    [[nodiscard]] Pose pose_at(double time) const {
        return time <= 0 || time >= 1 ? ends_.pose_at_end(time) : piece().pose_at(time);
    }
    [[nodiscard]] Pose fixed_pose_at(double time) const { return ends_.fixed_pose_at(time); }
    [[nodiscard]] SharedTrajectory with_goal(const Pose& goal_in_world) const;
    [[nodiscard]] SharedTrajectory reversed() const;
    [[nodiscard]] MotionDescription description() const {
        return {.kind = MotionDescription::Kind::sweep, .pieces = {ends_}, .centre = centre_, .chain = {}};
    }

    [[nodiscard]] const MotionEnds& ends() const { return ends_; }
    [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }

private:
    MotionEnds ends_;
    Eigen::Vector3d centre_;
};

} // namespace chasles::motion
