// The seam between motions and searches: what a trajectory states, checked by the compiler. A search sees no motion
// but through these two concepts. Source: docs/decisions/0035-one-seam-for-motions.md.
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/motion/coarse_motion.h"
#include "chasles/motion/enclosure.h"
#include "chasles/motion/exact_motion.h"
#include "chasles/motion/rational_motion.h"

#include <concepts>
#include <cstddef>
#include <optional>

namespace chasles::motion {

/// A ball that a point of the moving body never leaves, in the frame of the fixed body.
struct PathBall {
    Vector3<double> centre;
    double radius = 0;
    double size = 0; ///< sum of the sizes of everything that enters; with the radius and distances, it bounds roundings
                     ///< (1e-13 of it)
};

/// What a piece states whose cubic motion is the true one: there is nothing to enclose.
struct NotEnclosed {
    [[nodiscard]] static std::optional<Enclosure<double>> enclosure(const Bracket&) { return std::nullopt; }
    [[nodiscard]] static std::optional<Enclosure<algebra::DoubleDouble>> refined_enclosure(const Bracket&) {
        return std::nullopt;
    }
    [[nodiscard]] static bool is_refined() { return false; }
};

/// One piece of a trajectory: a cubic motion over tau in [0, 1] with the true ends, and enclosures of the true motion
/// if that is another one.
template <class P>
concept TrajectoryPiece = requires(const P& piece, double number, const Bracket& bracket) {
    /// The cubic motion. The control maps in double and in double-double are made from it.
    { piece.cubic() } -> std::same_as<const RationalMotion<algebra::DoubleDouble>&>;
    /// The control maps of the cubic motion without rounding; empty where there are none.
    { piece.exact() } -> std::same_as<std::optional<ExactMotion>>;
    /// A cubic motion near the true one over a part of the piece, and how near: the shorter the part, the nearer. Empty
    /// if the cubic motion of the piece is the true one.
    { piece.enclosure(bracket) } -> std::same_as<std::optional<Enclosure<double>>>;
    /// Likewise in double-double; empty, too, if the trajectory is known in double only.
    { piece.refined_enclosure(bracket) } -> std::same_as<std::optional<Enclosure<algebra::DoubleDouble>>>;
    /// Whether there are enclosures in double-double.
    { piece.is_refined() } -> std::same_as<bool>;

    /// The piece's own clock: brackets of tau within the piece as brackets of the trajectory's time and of its tau,
    /// rounded outward; dtau/dtime at a tau; and the width in tau that is no wider than a width in time anywhere.
    { piece.time_of(bracket) } -> std::same_as<Bracket>;
    { piece.tau_of(bracket) } -> std::same_as<Bracket>;
    { piece.tau_rate(number) } -> std::same_as<double>;
    { piece.tau_tolerance(number) } -> std::same_as<double>;

    /// The bodies in the world at a tau.
    { piece.pose_at(number) } -> std::same_as<Pose>;
    { piece.fixed_pose_at(number) } -> std::same_as<Pose>;
};

/// A motion over time in [0, 1]: its pieces in order of time, and what is known without them.
template <class T>
concept Trajectory = requires(const T& trajectory, std::size_t index, double time, const Vector3<double>& point) {
    { trajectory.pieces().size() } -> std::convertible_to<std::size_t>;
    requires TrajectoryPiece<std::remove_cvref_t<decltype(trajectory.pieces()[index])>>;
    /// For the test that bodies stay far apart. Encloses the true path, deviation included.
    { trajectory.ball_around_path(point) } -> std::same_as<PathBall>;
    /// Motions in double near the trajectory, one after another; most have one for the whole. Empty if there is none:
    /// the pieces are then searched at once.
    { trajectory.coarse_count() } -> std::same_as<std::size_t>;
    { trajectory.coarse(index) } -> std::same_as<std::optional<CoarseMotion>>;
    { trajectory.pose_at(time) } -> std::same_as<Pose>;
    { trajectory.fixed_pose_at(time) } -> std::same_as<Pose>;
    /// The motion back, as a SharedTrajectory; null if there is none.
    trajectory.reversed();
};

} // namespace chasles::motion
