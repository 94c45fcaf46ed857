// How the moving body moves: the motions that a query takes.
#pragma once

#include "chasles/base/export.h"
#include "chasles/motion/pose.h"

#include <memory>
#include <numbers>
#include <span>
#include <vector>

namespace chasles {

struct OwnTrajectory;

namespace motion {
class AnyTrajectory;
class EvenTrajectory;
class ScrewTrajectory;
class SweepTrajectory;
} // namespace motion

/// Any motion of one body, or of two bodies in one world, over time in [0, 1]. An opaque value of 16 bytes; copies
/// share what it describes, at most 300 bytes with the handle for a screw
/// (docs/decisions/0035-one-seam-for-motions.md).
class CHASLES_EXPORT Motion {
public:
    /// Largest turn of one piece of a screw, unless stated otherwise: 10 degrees in radians.
    static constexpr double default_max_turn = std::numbers::pi / 18;

    /// ScrewMotion::between and SweepMotion::between as plain motions.
    static Motion screw(const Pose& start, const Pose& goal, double max_turn = default_max_turn);
    static Motion sweep(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());

    /// ConstantVelocity::between and ConstantTwist::between as plain motions.
    static Motion velocity(const Pose& start, const Pose& goal,
                           const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());
    static Motion twist(const Pose& start, const Pose& goal);

    /// No motion.
    static Motion at_rest(const Pose& pose);
    /// The turn about the line through `point` along `direction` (of any non-zero length) by the angle
    /// sum of angle[k] time^k, in radians, and at most 1000. At the angle 0 the body is where its coordinates are.
    /// Throws InvalidInput for numbers that cannot be used.
    static Motion hinge(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                        const std::vector<double>& angle);
    /// The translation by (sum of way[k] time^k) along the unit vector of `direction`, mesh unit. Throws InvalidInput
    /// for numbers that cannot be used.
    static Motion slider(const Eigen::Vector3d& direction, const std::vector<double>& way);
    /// The translation by the sum of places[k] time^k, mesh unit. Throws InvalidInput for numbers that cannot be used.
    static Motion polynomial(const std::vector<Eigen::Vector3d>& places);
    /// Through poses at ascending times from 0 to 1: the body's origin on the natural cubic spline, slerp from each
    /// orientation to the next, the shorter way round. Throws InvalidInput for fewer than two poses, and for times that
    /// do not ascend from 0 to 1.
    static Motion spline(const std::vector<double>& times, const std::vector<Pose>& poses);
    /// The uniform cumulative cubic B-spline of positions and of orientations: smooth in velocity and acceleration,
    /// near its control poses but not through them. The first and the last pose count three times, so that the motion
    /// starts and ends there. Consecutive orientations must differ by less than a half turn. Throws InvalidInput for
    /// fewer than two poses. Source: Kim, Kim, Shin, "A general construction scheme for unit quaternion curves", 1995.
    static Motion b_spline(const std::vector<Pose>& poses);
    /// A trajectory of the user's own (chasles/motion/own_trajectory.h).
    static Motion along(const OwnTrajectory& trajectory);

    /// `inner`, carried by `outer`: pose_at(t) is outer.pose_at(t) * inner.pose_at(t). Throws InvalidInput if one of
    /// them is the paper's screw or a sweep, or has a fixed body that moves.
    friend CHASLES_EXPORT Motion operator*(const Motion& outer, const Motion& inner);

    /// The pose of the moving body in the world, and that of the fixed body, at a time in [0, 1]. A screw is followed
    /// piece by piece, as a query does.
    [[nodiscard]] Pose pose_at(double time) const;
    [[nodiscard]] Pose fixed_pose_at(double time) const;

    /// The motion back from the goal to the start: at a time, the poses are those of this motion at 1 - time. A last
    /// contact is the first one of the motion back. Throws InvalidInput for the paper's screw, which slides unevenly.
    [[nodiscard]] Motion reversed() const;

    /// For the library's own use: the seam between motions and searches. Its type is no part of the public interface.
    explicit Motion(std::shared_ptr<const motion::AnyTrajectory> trajectory) : trajectory_(std::move(trajectory)) {}
    [[nodiscard]] const motion::AnyTrajectory& trajectory() const { return *trajectory_; }

private:
    std::shared_ptr<const motion::AnyTrajectory> trajectory_;
};

/// The motion of one body as seen from another one; both move in the world. A query with it has the body of `moving` as
/// its moving body and that of `fixed` as its fixed body. Throws InvalidInput if one of them is the paper's screw or a
/// sweep, or has a fixed body that moves.
CHASLES_EXPORT Motion relative(const Motion& moving, const Motion& fixed);

/// The rest of a motion from the time `start` in [0, 1) on, as a motion over [0, 1]. Throws InvalidInput for another
/// time, and for the motions that `relative` does not take.
CHASLES_EXPORT Motion rest_of(const Motion& motion, double start);

/// The paper's motion between two poses: rotation by angle() * time about a fixed axis while sliding along it by
/// slide() * tau(time), where tau(time) = tan(angle * time / 2) / tan(angle / 2), and tau = time for a translation.
/// Keeps both end poses exactly. Source: paper section 1.2; docs/derivations/01-screw-from-two-poses.md.
///
/// A query cuts a screw that turns by more than `max_turn` radians into equal turns of at most that; each piece is one
/// of the paper's motions between poses rounded to double precision. Smaller pieces slide more evenly.
class CHASLES_EXPORT ScrewMotion {
public:
    static constexpr double default_max_turn = Motion::default_max_turn; ///< radians
    static constexpr double least_max_turn = 1e-4; ///< radians; limits the pieces of a screw to some ten thousand

    /// The motion of one body from `start` to `goal`, both in the frame of the fixed body, which is the world. Throws
    /// InvalidInput for a pose that cannot be used and for a max_turn outside of [least_max_turn, pi].
    static ScrewMotion between(const Pose& start, const Pose& goal, double max_turn = default_max_turn);

    /// The paper's motion for two moving bodies: the screw of the moving body as seen from the fixed body. All four
    /// poses are in the world, in which the fixed body itself follows the constant twist between its poses.
    static ScrewMotion relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                const Pose& fixed_goal, double max_turn = default_max_turn);

    /// Turn in [0, pi], radians.
    [[nodiscard]] double angle() const;
    /// Signed travel along axis_direction(), mesh unit.
    [[nodiscard]] double slide() const;
    /// Unit vector in the fixed body's frame: along the axis; along the travel if nothing turns; 0 0 1 if nothing
    /// moves.
    [[nodiscard]] Eigen::Vector3d axis_direction() const;
    /// The axis point nearest to the start position of the body's origin, in the fixed body's frame; the start position
    /// itself if nothing turns.
    [[nodiscard]] Eigen::Vector3d axis_point() const;
    /// Largest turn of one piece, radians.
    [[nodiscard]] double max_turn() const;
    /// The same screw in pieces of another size. Throws InvalidInput for a max_turn that `between` refuses.
    [[nodiscard]] ScrewMotion with_max_turn(double max_turn) const;

    [[nodiscard]] double tau_at(double time) const;  ///< the paper's parameter, [0, 1] -> [0, 1]
    [[nodiscard]] double time_at(double tau) const;  ///< its inverse
    [[nodiscard]] double tau_rate(double tau) const; ///< dtau/dtime at a tau
    [[nodiscard]] Pose pose_at(double time) const;   ///< of the moving body in the world, along the uncut screw

    /// The screw in equal turns of at most max_turn(), in order. A screw that turns by pi, or by so nearly pi that its
    /// half-angle tangent would exceed 1000, is cut in two whatever max_turn().
    [[nodiscard]] std::vector<ScrewMotion> pieces() const;
    /// The number of those pieces.
    [[nodiscard]] std::size_t piece_count() const;

    operator Motion() const { return motion_; } // NOLINT(google-explicit-constructor): a query takes any motion

    /// For the library's own use.
    [[nodiscard]] const motion::ScrewTrajectory& trajectory() const;

private:
    friend class SweepMotion;
    explicit ScrewMotion(Motion motion) : motion_(std::move(motion)) {}
    Motion motion_;
};

/// Straight travel with a normalised linear turn ("nlerp and lerp"): a reference point of the body follows a straight
/// line while the body turns by the normalised linear interpolation of quaternions. Symmetric in time, regular at a
/// half turn. Here tau = time. Keeps both end poses exactly. Source: docs/derivations/02-rational-motion.md.
class CHASLES_EXPORT SweepMotion {
public:
    /// The motion of one body from `start` to `goal`, both in the frame of the fixed body, which is the world. `centre`
    /// is the reference point in the moving body's frame (default its origin). Throws InvalidInput for a pose or a
    /// centre that cannot be used.
    static SweepMotion between(const Pose& start, const Pose& goal,
                               const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());

    /// For two moving bodies: the sweep of the moving body as seen from the fixed one, which follows a constant twist.
    static SweepMotion relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                const Pose& fixed_goal);

    /// The same sweep with another reference point, in the moving body's frame. Throws InvalidInput for a centre that
    /// cannot be used.
    [[nodiscard]] SweepMotion about(const Eigen::Vector3d& centre) const;

    /// The sweep back from the goal to the start.
    [[nodiscard]] SweepMotion reversed() const;

    /// The screw between the same poses.
    [[nodiscard]] ScrewMotion screw_of_same_poses() const;

    [[nodiscard]] double angle() const;                 ///< turn in [0, pi], radians
    [[nodiscard]] Eigen::Vector3d displacement() const; ///< of the reference point in the fixed body's frame
    [[nodiscard]] Pose pose_at(double time) const;      ///< of the moving body in the world

    operator Motion() const { return motion_; } // NOLINT(google-explicit-constructor): a query takes any motion

    /// For the library's own use.
    [[nodiscard]] const motion::SweepTrajectory& trajectory() const;

private:
    explicit SweepMotion(Motion motion) : motion_(std::move(motion)) {}
    Motion motion_;
};

/// Constant velocity: the body turns evenly about one direction, the shorter way round, while a point of it moves
/// evenly on a straight line ("slerp and lerp"). Keeps both end poses. Source: docs/derivations/25-even-motions.md.
///
/// The motion is no rational one. A query encloses it by cubic motions and follows a contact until the bracket is as
/// narrow as asked or as rounding allows (docs/derivations/24-enclosures.md). A motion that does not turn is a sweep.
class CHASLES_EXPORT ConstantVelocity {
public:
    /// The motion of one body from `start` to `goal`, both in the frame of the fixed body, which is the world. `centre`
    /// is the point that moves straight, in the moving body's frame (default its origin). Throws InvalidInput for a
    /// pose or a centre that cannot be used.
    static ConstantVelocity between(const Pose& start, const Pose& goal,
                                    const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());

    [[nodiscard]] double angle() const; ///< turn in [0, pi], radians
    /// Of the centre during the whole motion, in the fixed body's frame and the mesh unit.
    [[nodiscard]] Eigen::Vector3d displacement() const;
    [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }         ///< in the moving body's frame
    [[nodiscard]] Pose pose_at(double time) const { return motion_.pose_at(time); } ///< of the moving body in the world

    operator Motion() const { return motion_; } // NOLINT(google-explicit-constructor): a query takes any motion

private:
    ConstantVelocity(Motion motion, const Eigen::Vector3d& centre) : motion_(std::move(motion)), centre_(centre) {}

    Motion motion_;
    Eigen::Vector3d centre_;
};

/// Constant twist: even turn about the axis of the screw between two poses, the shorter way round, and even slide along
/// it, so that every point runs on a uniform helix. The paper's screw between the same poses has the same paths, but
/// slides unevenly. Keeps both end poses. Without a slide it is that screw (docs/derivations/35-one-axis.md), otherwise
/// enclosed like ConstantVelocity. Source: docs/derivations/25-even-motions.md.
class CHASLES_EXPORT ConstantTwist {
public:
    /// The motion of one body from `start` to `goal`, both in the frame of the fixed body, which is the world. Throws
    /// InvalidInput for a pose that cannot be used.
    static ConstantTwist between(const Pose& start, const Pose& goal);

    /// The paper's screw between the same poses, which has the same axis, angle and slide.
    [[nodiscard]] ScrewMotion screw_of_same_poses() const;
    [[nodiscard]] Pose pose_at(double time) const { return motion_.pose_at(time); } ///< of the moving body in the world

    operator Motion() const { return motion_; } // NOLINT(google-explicit-constructor): a query takes any motion

private:
    explicit ConstantTwist(Motion motion) : motion_(std::move(motion)) {}

    Motion motion_;
};

/// The screws from each pose of a path to the next. Throws InvalidInput for fewer than two poses.
CHASLES_EXPORT std::vector<Motion> screws_along(std::span<const Pose> poses,
                                                double max_turn = ScrewMotion::default_max_turn);

} // namespace chasles
