// Even motions: the body turns evenly about one direction while a point of it moves evenly on a straight line or on a
// helix about that direction. Constant velocity and constant twist are of this kind.
// Source: docs/derivations/25-even-motions.md.
#pragma once

#include "chasles/algebra/sine_cosine.h"
#include "chasles/motion/axis_motion.h"
#include "chasles/motion/motion_ends.h"
#include "chasles/motion/smooth_trajectory.h"

#include <memory>
#include <mutex>

namespace chasles::motion {

/// The numbers of an even motion over time in [0, 1], in the frame of the fixed body. The orientation at a time is the
/// turn by angle * time about the direction, after that of the start. The reference, a point of the body, is at
/// start + time * travel + (turn - identity) arm.
template <class S>
struct EvenMotion {
    Quaternion<S> orientation; ///< at the start, of unit length
    S angle{};                 ///< in radians, in [0, pi]
    Vector3<S> direction;      ///< of unit length
    Vector3<S> reference;      ///< in the frame of the moving body
    Vector3<S> start;          ///< of the reference
    Vector3<S> travel;         ///< straight, of the reference during the whole motion
    Vector3<S> arm;            ///< from the axis of the helix to the start, perpendicular to the direction
    double size = 0;           ///< the sum of the sizes of all lengths that enter

    [[nodiscard]] GeneralPose<S> at(const S& time) const {
        const auto [sine, cosine] = algebra::sine_cosine(S(S(0.5) * angle * time));
        const Quaternion<S> rotation = Quaternion<S>{cosine, scale(direction, sine)} * orientation;
        const Vector3<S> across = cross(direction, arm);
        const S twice = S(2) * sine;
        const Vector3<S> swing = scale(across, S(twice * cosine)) + scale(cross(direction, across), S(twice * sine));
        const Vector3<S> place = start + scale(travel, time) + swing;
        return {place - rotated(rotation, reference), rotation};
    }
};

enum class EvenKind : std::uint8_t {
    velocity, ///< slerp, the shorter way round, while a point of the body moves straight
    twist     ///< a uniform helix
};

/// An even motion as a frame. Most motions of a plan are proven clear in double: the motion in double-double is made
/// when it is requested.
class EvenFrame final : public MovingFrame {
public:
    /// The reference is `centre` for a velocity; for a twist it is the body's origin, or a point of the axis if
    /// `may_be_on_axis` and the axis is not far away.
    EvenFrame(EvenKind kind, const Pose& start, const Pose& goal, const Eigen::Vector3d& centre, bool may_be_on_axis);

    /// The turn from one orientation to another, the shorter way round; without a path.
    static EvenMotion<Wide> turn_between(const Pose& from, const Pose& to);

    [[nodiscard]] GeneralPose<double> at(double time) const override {
        return time == 0 || time == 1 ? at_end(time == 1) : motion_.at(time);
    }
    [[nodiscard]] GeneralPose<Wide> refined_at(const Wide& time) const override { return refined().at(time); }
    [[nodiscard]] bool is_refined() const override { return true; }
    [[nodiscard]] Vector3<double> reference() const override { return motion_.reference; }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return refined().reference; }
    [[nodiscard]] RateBounds rates(const Bracket& /*times*/) const override { return rates_; }
    [[nodiscard]] RateExpansion expansion(const Bracket& times) const override;
    [[nodiscard]] std::optional<AxisExpansion> expansion_about(const Vector3<double>& direction,
                                                               const Bracket& times) const override {
        return AxisExpansion{expansion(times),
                             turn_across(motion_.direction, direction, motion_.angle, 0, length(motion_.arm))};
    }
    [[nodiscard]] std::optional<Vector3<Wide>> refined_axis(const Bracket& /*times*/) const override {
        return motion_.angle > 0 ? std::optional(refined().direction) : std::nullopt;
    }
    [[nodiscard]] double size() const override { return motion_.size; }
    [[nodiscard]] std::vector<AxisSection> axis_sections() const override;
    [[nodiscard]] bool add_links(ChainLinks& chain, bool is_inverse) const override;
    [[nodiscard]] const EvenMotion<Wide>& refined() const;

private:
    /// The turn and the displacement of the body's origin from the start to the goal, without rounding.
    struct ExactTurn {
        Quaternion<algebra::ExactNumber> rotation;
        Vector3<algebra::ExactNumber> shift;
    };

    [[nodiscard]] std::optional<ScaledVector> resting_point(const ExactTurn& turn) const;
    /// An end as it was given. Ends are asked for most often, and need no sine.
    [[nodiscard]] GeneralPose<double> at_end(bool is_goal) const;

    Pose start_;
    Pose goal_;
    Eigen::Vector3d centre_;
    EvenMotion<double> motion_;
    RateBounds rates_; ///< at all times
    EvenKind kind_;
    bool may_be_on_axis_;
    mutable std::once_flag is_made_;
    mutable std::unique_ptr<const EvenMotion<Wide>> refined_;
};

/// Slerp, the shorter way round, while the body point `centre` moves on a straight line.
SharedFrame velocity_frame(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre);
/// A uniform helix, with the body's origin as its reference.
SharedFrame twist_frame(const Pose& start, const Pose& goal);

/// What a ConstantVelocity or a ConstantTwist describes. Small: the numbers of the motion are computed when they are
/// requested.
class EvenTrajectory {
public:
    using Kind = EvenKind;

    /// The fixed body stands still. `centre` is the point that moves straight, in the moving body's frame; without
    /// effect for a twist. Throws InvalidInput if it cannot be used.
    EvenTrajectory(Kind kind, const MotionEnds& ends, const Eigen::Vector3d& centre);

    [[nodiscard]] SharedFrame frame() const;
    [[nodiscard]] double size() const {
        return ends_.start.translation.lpNorm<1>() + ends_.goal.translation.lpNorm<1>() + centre_.lpNorm<1>();
    }
    [[nodiscard]] SmoothPieces pieces() const;
    [[nodiscard]] PathBall ball_around_path(const Vector3<double>& point) const;
    [[nodiscard]] static std::size_t coarse_count() { return 1; }
    [[nodiscard]] std::optional<CoarseMotion> coarse(std::size_t part = 0) const;
    [[nodiscard]] Pose pose_at(double time) const;
    [[nodiscard]] static Pose fixed_pose_at(double /*time*/) { return {}; }
    [[nodiscard]] SharedTrajectory with_goal(const Pose& goal_in_world) const;
    [[nodiscard]] SharedTrajectory reversed() const;
    [[nodiscard]] MotionDescription description() const { return MotionDescription::of_frame(*frame()); }

private:
    [[nodiscard]] EvenMotion<double> numbers() const;

    MotionEnds ends_;
    Eigen::Vector3d centre_;
    Kind kind_;
};

} // namespace chasles::motion
