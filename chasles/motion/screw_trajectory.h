// The paper's screw as a trajectory: equal turns one after another, each a cubic motion without deviation.
// Source: paper section 1.2; docs/derivations/01-screw-from-two-poses.md.
#pragma once

#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/motion_ends.h"
#include "chasles/motion/piece_clock.h"
#include "chasles/motion/screw_clock.h"

namespace chasles::motion {

/// The ends of a screw in the frame of the fixed body, with what every use of them needs first.
struct RelativeScrew {
    RelativeEnds ends;
    Quaternion<algebra::DoubleDouble> turn;
    ScrewClock clock;

    explicit RelativeScrew(const MotionEnds& given)
        : ends(given), turn(turn_between(ends.start, ends.goal)), clock(turn) {}
};

/// The screw between two poses. Where it turns too far for the paper's parameter (ScrewClock::is_short), only its clock
/// and its poses are defined.
class ScrewPiece : public NotEnclosed {
public:
    explicit ScrewPiece(const MotionEnds& ends, const PieceClock& clock = {})
        : ScrewPiece(ends, RelativeScrew(ends), clock) {}
    ScrewPiece(const MotionEnds& ends, const RelativeScrew& relative, const PieceClock& clock = {});

    [[nodiscard]] const RationalMotion<algebra::DoubleDouble>& cubic() const { return cubic_; }
    [[nodiscard]] std::optional<ExactMotion> exact() const { return exact_screw(ends_); }

    [[nodiscard]] Bracket time_of(const Bracket& tau) const;
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const { return clock_.whole(tau); }
    [[nodiscard]] double tau_rate(double tau) const;
    [[nodiscard]] double tau_tolerance(double time_tolerance) const;
    [[nodiscard]] Pose pose_at(double tau) const { return pose_at_time(screw_clock_.time_at(tau)); }
    [[nodiscard]] Pose fixed_pose_at(double tau) const { return ends_.fixed_pose_at(screw_clock_.time_at(tau)); }

    /// The moving body in the world at a time within the piece, in [0, 1].
    [[nodiscard]] Pose pose_at_time(double time) const;
    [[nodiscard]] const MotionEnds& ends() const { return ends_; }
    [[nodiscard]] const RelativeEnds& relative_ends() const { return relative_; }

private:
    MotionEnds ends_;
    RelativeEnds relative_;
    ScrewClock screw_clock_;
    PieceClock clock_;
    RationalMotion<algebra::DoubleDouble> cubic_;
};

/// The pieces of a screw. Poses between two pieces are rounded to double precision.
class ScrewPieces {
public:
    ScrewPieces(const MotionEnds& ends, double max_turn);

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] ScrewPiece operator[](std::size_t index) const;

    [[nodiscard]] MotionEnds ends_of(std::size_t index) const;

private:
    MotionEnds ends_;
    std::size_t count_;
    std::optional<ScrewPiece> whole_; ///< only where the screw is the only piece
    std::optional<ScrewPath> path_;   ///< only where it is not
};

/// What a ScrewMotion describes. Small: the pieces are computed when they are requested, as most motions of a plan are
/// proven clear without them.
class ScrewTrajectory {
public:
    /// Throws InvalidInput if max_turn is below ScrewMotion::least_max_turn.
    ScrewTrajectory(const MotionEnds& ends, double max_turn);

    [[nodiscard]] ScrewPieces pieces() const { return {ends_, max_turn_}; }
    [[nodiscard]] PathBall ball_around_path(const Vector3<double>& point) const;
    [[nodiscard]] static std::size_t coarse_count() { return 1; }
    [[nodiscard]] std::optional<CoarseMotion> coarse(std::size_t /*part*/) const { return coarse_screw(ends_); }
    /// Along the pieces.
    [[nodiscard]] Pose pose_at(double time) const;
    [[nodiscard]] Pose uncut_pose_at(double time) const;
    [[nodiscard]] Pose fixed_pose_at(double time) const { return ends_.fixed_pose_at(time); }
    [[nodiscard]] SharedTrajectory with_goal(const Pose& goal_in_world) const;
    /// None: it slides unevenly, so that the way back is no screw.
    [[nodiscard]] static SharedTrajectory reversed() { return nullptr; }
    [[nodiscard]] MotionDescription description() const;

    [[nodiscard]] const MotionEnds& ends() const { return ends_; }
    [[nodiscard]] double max_turn() const { return max_turn_; }
    [[nodiscard]] ScrewNumbers numbers() const;
    [[nodiscard]] ScrewClock clock() const;

private:
    MotionEnds ends_;
    double max_turn_;
};

} // namespace chasles::motion
