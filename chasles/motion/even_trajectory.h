// Even motions: the body turns evenly about one direction while a point of it moves evenly on a straight line or on a
// helix about that direction. Constant velocity and constant twist are of this kind.
// Source: docs/derivations/25-even-motions.md.
#pragma once

#include "chasles/motion/coarse_motion.h"
#include "chasles/motion/enclosure.h"
#include "chasles/motion/motion_ends.h"
#include "chasles/motion/piece_clock.h"
#include "chasles/motion/any_trajectory.h"

#include <optional>

namespace chasles::motion {

/// The numbers of an even motion over time in [0, 1], in the frame of the fixed body. The orientation at a time is the
/// turn by angle * time about the direction, after that of the start. The reference, a point of the body, is at
/// start + time * travel + (turn - identity) arm.
struct EvenMotion {
    Quaternion<double> orientation;  ///< at the start, of unit length
    double angle = 0;                ///< in radians, at least 0
    Vector3<double> direction;       ///< of unit length
    Vector3<double> reference;       ///< in the frame of the moving body
    Vector3<double> start;           ///< of the reference
    Vector3<double> travel;          ///< straight, of the reference during the whole motion
    Vector3<double> arm;             ///< from the axis of the helix to the start, perpendicular to the direction
    double size = 0;                 ///< the sum of the sizes of all lengths that enter

    [[nodiscard]] GeneralPose<double> at(double time) const;
    /// They hold at all times.
    [[nodiscard]] RateBounds rates() const;
};

/// Slerp, the shorter way round, while the body point `centre` moves on a straight line.
EvenMotion constant_velocity(const RelativeEnds& ends, const Vector3<double>& centre);

/// Even turn about, and even slide along, the axis of the screw between both poses: a uniform helix.
EvenMotion constant_twist(const RelativeEnds& ends);

/// A part of an even motion that turns little.
class EvenPiece {
public:
    EvenPiece(const MotionEnds& ends, const EvenMotion& motion, const PieceClock& clock);

    [[nodiscard]] const RationalMotion<algebra::DoubleDouble>& cubic() const { return cubic_; }
    [[nodiscard]] std::optional<ExactMotion> exact() const { return std::nullopt; }
    [[nodiscard]] std::optional<Enclosure> enclosure(const Bracket& part) const;

    [[nodiscard]] Bracket time_of(const Bracket& tau) const { return clock_.whole(tau); }
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const { return time_of(tau); }
    [[nodiscard]] double tau_rate(double) const { return double(clock_.count); }
    [[nodiscard]] double tau_tolerance(double time_tolerance) const;
    [[nodiscard]] Pose pose_at(double tau) const;
    [[nodiscard]] Pose fixed_pose_at(double tau) const { return ends_.fixed_pose_at(time_at(tau)); }

private:
    [[nodiscard]] double time_at(double tau) const { return (double(clock_.index) + tau) / double(clock_.count); }

    MotionEnds ends_;
    EvenMotion motion_;
    PieceClock clock_;
    RationalMotion<algebra::DoubleDouble> cubic_;
};

/// What a ConstantVelocity or a ConstantTwist describes.
class EvenTrajectory {
public:
    enum class Kind : std::uint8_t { velocity, twist };

    /// `centre` is the point that moves straight, in the moving body's frame; without effect for a twist. Throws
    /// InvalidInput if it cannot be used.
    EvenTrajectory(Kind kind, const MotionEnds& ends, const Eigen::Vector3d& centre);

    class Pieces {
    public:
        explicit Pieces(const EvenTrajectory& trajectory);
        [[nodiscard]] std::size_t size() const { return count_; }
        [[nodiscard]] EvenPiece operator[](std::size_t index) const { return {ends_, motion_, {index, count_}}; }

    private:
        MotionEnds ends_;
        EvenMotion motion_;
        std::size_t count_;
    };

    [[nodiscard]] Pieces pieces() const { return Pieces(*this); }
    [[nodiscard]] PathBall ball_around_path(const Vector3<double>& point) const;
    [[nodiscard]] std::optional<CoarseMotion> coarse() const;
    [[nodiscard]] Pose pose_at(double time) const;
    [[nodiscard]] Pose fixed_pose_at(double time) const { return ends_.fixed_pose_at(time); }

    [[nodiscard]] const MotionEnds& ends() const { return ends_; }
    [[nodiscard]] const EvenMotion& motion() const { return motion_; }

private:
    MotionEnds ends_;
    EvenMotion motion_;
};

} // namespace chasles::motion
