// Even motions: the body turns evenly about one direction while a point of it moves evenly on a straight line or on a
// helix about that direction. Constant velocity and constant twist are of this kind.
// Source: docs/derivations/25-even-motions.md.
#pragma once

#include "chasles/algebra/sine_cosine.h"
#include "chasles/motion/motion_ends.h"
#include "chasles/motion/smooth_trajectory.h"

#include <memory>
#include <optional>

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

EvenMotion<double> rounded(const EvenMotion<algebra::DoubleDouble>& motion);

/// An even motion as a frame.
class EvenFrame final : public MovingFrame {
public:
    explicit EvenFrame(const EvenMotion<Wide>& motion);

    /// The turn from one orientation to another, the shorter way round; without a path.
    static EvenMotion<Wide> turn_between(const Pose& from, const Pose& to);

    [[nodiscard]] GeneralPose<double> at(double time) const override { return in_double_.at(time); }
    [[nodiscard]] GeneralPose<Wide> refined_at(const Wide& time) const override { return motion_.at(time); }
    [[nodiscard]] bool is_refined() const override { return true; }
    [[nodiscard]] Vector3<Wide> reference() const override { return motion_.reference; }
    [[nodiscard]] RateBounds rates(const Bracket& /*times*/) const override { return rates_; }
    [[nodiscard]] double size() const override { return motion_.size; }

private:
    EvenMotion<Wide> motion_;
    EvenMotion<double> in_double_;
    RateBounds rates_; ///< at all times
};

/// Slerp, the shorter way round, while the body point `centre` moves on a straight line.
SharedFrame velocity_frame(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre);
/// A uniform helix, with the body's origin as its reference.
SharedFrame twist_frame(const Pose& start, const Pose& goal);

/// What a ConstantVelocity or a ConstantTwist describes. Small: the numbers of the motion are computed when they are
/// requested, as most motions of a plan are proven clear without them.
class EvenTrajectory {
public:
    enum class Kind : std::uint8_t { velocity, twist };

    /// The fixed body stands still. `centre` is the point that moves straight, in the moving body's frame; without
    /// effect for a twist. Throws InvalidInput if it cannot be used.
    EvenTrajectory(Kind kind, const MotionEnds& ends, const Eigen::Vector3d& centre);

    [[nodiscard]] SharedFrame frame() const { return std::make_shared<const EvenFrame>(motion()); }
    [[nodiscard]] SmoothPieces pieces() const { return SmoothPieces(SmoothMotion::of_one(frame())); }
    [[nodiscard]] PathBall ball_around_path(const Vector3<double>& point) const;
    [[nodiscard]] std::optional<CoarseMotion> coarse() const;
    [[nodiscard]] Pose pose_at(double time) const;
    [[nodiscard]] static Pose fixed_pose_at(double /*time*/) { return {}; }

    [[nodiscard]] EvenMotion<algebra::DoubleDouble> motion() const;

private:
    template <class S>
    [[nodiscard]] EvenMotion<S> motion_in() const;

    MotionEnds ends_;
    Eigen::Vector3d centre_;
    Kind kind_;
};

} // namespace chasles::motion
