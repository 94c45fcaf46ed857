// Even motions: the body turns evenly about one direction while a point of it moves evenly on a straight line or on a
// helix about that direction. Constant velocity and constant twist are of this kind.
// Source: docs/derivations/25-even-motions.md.
#pragma once

#include "chasles/motion/coarse_motion.h"
#include "chasles/motion/enclosure.h"
#include "chasles/motion/motion_ends.h"
#include "chasles/motion/piece_clock.h"
#include "chasles/algebra/sine_cosine.h"
#include "chasles/motion/any_trajectory.h"

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

/// What all pieces of an even motion share.
struct EvenWhole {
    MotionEnds ends;
    EvenMotion<algebra::DoubleDouble> motion;
    EvenMotion<double> in_double;
    RateBounds rates; ///< at all times
    std::size_t count; ///< of pieces

    EvenWhole(const MotionEnds& given, const EvenMotion<algebra::DoubleDouble>& even);
};

/// A part of an even motion that turns little.
class EvenPiece {
public:
    EvenPiece(std::shared_ptr<const EvenWhole> whole, std::size_t index);

    [[nodiscard]] const RationalMotion<algebra::DoubleDouble>& cubic() const { return cubic_; }
    [[nodiscard]] std::optional<ExactMotion> exact() const { return std::nullopt; }
    [[nodiscard]] std::optional<Enclosure<double>> enclosure(const Bracket& part) const;
    [[nodiscard]] std::optional<Enclosure<algebra::DoubleDouble>> refined_enclosure(const Bracket& part) const;

    [[nodiscard]] Bracket time_of(const Bracket& tau) const { return clock_.whole(tau); }
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const { return time_of(tau); }
    [[nodiscard]] double tau_rate(double) const { return double(clock_.count); }
    [[nodiscard]] double tau_tolerance(double time_tolerance) const;
    [[nodiscard]] Pose pose_at(double tau) const;
    [[nodiscard]] Pose fixed_pose_at(double tau) const { return whole_->ends.fixed_pose_at(time_at(tau)); }

private:
    [[nodiscard]] double time_at(double tau) const { return (double(clock_.index) + tau) / double(clock_.count); }
    [[nodiscard]] EnclosureBounds bounds(const Bracket& part, double rounding) const;

    std::shared_ptr<const EvenWhole> whole_;
    PieceClock clock_;
    RationalMotion<algebra::DoubleDouble> cubic_;
};

/// What a ConstantVelocity or a ConstantTwist describes. Small: the numbers of the motion are computed when they are
/// requested, as most motions of a plan are proven clear without them.
class EvenTrajectory {
public:
    enum class Kind : std::uint8_t { velocity, twist };

    /// `centre` is the point that moves straight, in the moving body's frame; without effect for a twist. Throws
    /// InvalidInput if it cannot be used.
    EvenTrajectory(Kind kind, const MotionEnds& ends, const Eigen::Vector3d& centre);

    class Pieces {
    public:
        explicit Pieces(const EvenTrajectory& trajectory)
            : whole_(std::make_shared<const EvenWhole>(trajectory.ends_, trajectory.motion())) {}
        [[nodiscard]] std::size_t size() const { return whole_->count; }
        [[nodiscard]] EvenPiece operator[](std::size_t index) const { return {whole_, index}; }

    private:
        std::shared_ptr<const EvenWhole> whole_;
    };

    [[nodiscard]] Pieces pieces() const { return Pieces(*this); }
    [[nodiscard]] PathBall ball_around_path(const Vector3<double>& point) const;
    [[nodiscard]] std::optional<CoarseMotion> coarse() const;
    [[nodiscard]] Pose pose_at(double time) const;
    [[nodiscard]] Pose fixed_pose_at(double time) const { return ends_.fixed_pose_at(time); }

    [[nodiscard]] const MotionEnds& ends() const { return ends_; }
    [[nodiscard]] EvenMotion<algebra::DoubleDouble> motion() const;

private:
    template <class S>
    [[nodiscard]] EvenMotion<S> motion_in() const;

    MotionEnds ends_;
    Eigen::Vector3d centre_;
    Kind kind_;
};

} // namespace chasles::motion
