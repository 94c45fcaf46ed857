// The trajectory of any moving frame: pieces that turn little, each enclosed by sweeps.
// Source: docs/derivations/24-enclosures.md.
#pragma once

#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/moving_frame.h"

namespace chasles::motion {

/// The moving body seen from the fixed body, and both in the world.
struct SmoothMotion {
    SharedFrame relative;
    SharedFrame moving; ///< in the world; `relative` if the fixed body stands still
    SharedFrame fixed;  ///< in the world; null if the fixed body's frame is the world

    /// For a fixed body that stands still.
    static SmoothMotion of_one(const SharedFrame& frame) { return {frame, frame, nullptr}; }
};

/// A part of a smooth motion that turns little and has no cut inside.
class SmoothPiece {
public:
    SmoothPiece(SmoothMotion motion, const Bracket& times);

    [[nodiscard]] const RationalMotion<algebra::DoubleDouble>& cubic() const { return cubic_; }
    [[nodiscard]] static std::optional<ExactMotion> exact() { return std::nullopt; }
    [[nodiscard]] std::optional<Enclosure<double>> enclosure(const Bracket& part) const;
    [[nodiscard]] std::optional<Enclosure<algebra::DoubleDouble>> refined_enclosure(const Bracket& part) const;

    [[nodiscard]] Bracket time_of(const Bracket& tau) const;
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const { return time_of(tau); }
    [[nodiscard]] double tau_rate(double) const { return 1 / (times_.upper - times_.lower); }
    [[nodiscard]] double tau_tolerance(double time_tolerance) const;
    [[nodiscard]] Pose pose_at(double tau) const;
    [[nodiscard]] Pose fixed_pose_at(double tau) const;

    [[nodiscard]] const Bracket& times() const { return times_; } ///< of the whole motion

private:
    [[nodiscard]] double time_at(double tau) const;
    template <class S>
    [[nodiscard]] EnclosureBounds bounds(const Bracket& part) const;

    SmoothMotion motion_;
    Bracket times_;
    Vector3<algebra::DoubleDouble> reference_;
    Vector3<double> reference_in_double_;
    RationalMotion<algebra::DoubleDouble> cubic_;
};

/// The pieces of a smooth motion, in order of time.
class SmoothPieces {
public:
    /// Throws InvalidInput where the motion turns so fast, by its bounds, that pieces would be too many.
    explicit SmoothPieces(SmoothMotion motion);

    [[nodiscard]] std::size_t size() const { return cuts_.size() - 1; }
    [[nodiscard]] SmoothPiece operator[](std::size_t index) const {
        return {motion_, {cuts_[index], cuts_[index + 1]}};
    }

private:
    SmoothMotion motion_;
    std::vector<double> cuts_; ///< from 0 to 1
};

/// A smooth motion as a trajectory.
class SmoothTrajectory {
public:
    explicit SmoothTrajectory(SmoothMotion motion) : motion_(std::move(motion)) {}

    [[nodiscard]] SmoothPieces pieces() const { return SmoothPieces(motion_); }
    [[nodiscard]] PathBall ball_around_path(const Vector3<double>& point) const;
    [[nodiscard]] std::optional<CoarseMotion> coarse() const;
    [[nodiscard]] Pose pose_at(double time) const;
    [[nodiscard]] Pose fixed_pose_at(double time) const;

    [[nodiscard]] SharedFrame frame() const { return motion_.fixed ? nullptr : motion_.moving; }

private:
    SmoothMotion motion_;
};

/// A pose with a quaternion of any length, as a public pose.
Pose public_pose(const GeneralPose<double>& pose);

} // namespace chasles::motion
