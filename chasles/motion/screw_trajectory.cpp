#include "chasles/motion/screw_trajectory.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/motion.h"
#include "chasles/motion/path_ends.h"

#include <algorithm>
#include <numbers>

namespace chasles::motion {

static_assert(Trajectory<ScrewTrajectory>);

ScrewPiece::ScrewPiece(const MotionEnds& ends, const RelativeScrew& relative, const PieceClock& clock)
    : ends_(ends), relative_(relative.ends), screw_clock_(relative.clock), clock_(clock) {
    if (screw_clock_.is_short())
        cubic_ = screw_between(relative_.start, relative_.goal, relative.turn);
}

Bracket ScrewPiece::time_of(const Bracket& tau) const {
    return clock_.whole({screw_clock_.time_at(tau.lower), screw_clock_.time_at(tau.upper)});
}

double ScrewPiece::tau_rate(double tau) const {
    return screw_clock_.tau_rate(tau) * double(clock_.count);
}

double ScrewPiece::tau_tolerance(double time_tolerance) const {
    // tau as a function of time is convex: dtime/dtau is largest at tau = 0.
    const double largest_rate = std::max(1.0, 1 / screw_clock_.tau_rate(0));
    return std::min(time_tolerance * double(clock_.count) / largest_rate, 1.0);
}

Pose ScrewPiece::pose_at_time(double time) const {
    return ends_.in_world(screw_pose(relative_.start, relative_.goal, {time, screw_clock_.tau_at(time)}), time);
}

ScrewPieces::ScrewPieces(const MotionEnds& ends, double max_turn) : ends_(ends) {
    const RelativeScrew relative(ends);
    count_ = relative.clock.piece_count(max_turn);
    if (count_ == 1)
        whole_.emplace(ends, relative);
    else
        path_.emplace(relative.ends.start, relative.ends.goal, relative.turn);
}

ScrewPiece ScrewPieces::operator[](std::size_t index) const {
    return whole_ ? *whole_ : ScrewPiece(ends_of(index), {index, count_});
}

MotionEnds ScrewPieces::ends_of(std::size_t index) const {
    const auto time_of = [&](std::size_t i) { return double(i) / double(count_); };
    const auto pose_of = [&](std::size_t i) { return path_->at({time_of(i), time_of(i)}); }; // the same bits each time
    MotionEnds piece = ends_;
    if (index > 0) {
        piece.start = pose_of(index);
        piece.start_is_in_world = false;
        if (piece.fixed)
            piece.fixed->start = ends_.fixed_pose_at(time_of(index));
    }
    if (index + 1 < count_) {
        piece.goal = pose_of(index + 1);
        piece.goal_is_in_world = false;
        if (piece.fixed)
            piece.fixed->goal = ends_.fixed_pose_at(time_of(index + 1));
    }
    return piece;
}

ScrewTrajectory::ScrewTrajectory(const MotionEnds& ends, double max_turn) : ends_(ends), max_turn_(max_turn) {
    if (!(max_turn >= ScrewMotion::least_max_turn))
        throw InvalidInput("motion: max_turn: must be at least 1e-4 radians (0.00573 degrees)");
    if (max_turn > std::numbers::pi)
        throw InvalidInput("motion: max_turn: must be at most pi radians (180 degrees): one screw in one piece");
}

PathBall ScrewTrajectory::ball_around_path(const Vector3<double>& point) const {
    const PathEnds path(ends_, point); // the arc stays within the ball over its chord
    return {path.middle(), length(path.chord()) / 2, size_of_fixed_ends(ends_)};
}

Pose ScrewTrajectory::pose_at(double time) const {
    if (time <= 0 || time >= 1)
        return ends_.pose_at_end(time);
    const ScrewPieces pieces(ends_, max_turn_);
    const double place = time * double(pieces.size());
    const std::size_t index = std::min(static_cast<std::size_t>(place), pieces.size() - 1);
    return pieces[index].pose_at_time(place - double(index));
}

/// Near a half turn there is no uncut one: its two halves.
Pose ScrewTrajectory::uncut_pose_at(double time) const {
    if (time <= 0 || time >= 1)
        return ends_.pose_at_end(time);
    return clock().is_short() ? ScrewPiece(ends_).pose_at_time(time)
                              : ScrewTrajectory(ends_, std::numbers::pi).pose_at(time);
}

/// The middle of the largest turns of a piece that give so many pieces.
SharedTrajectory ScrewTrajectory::with_goal(const Pose& goal_in_world) const {
    const std::size_t pieces = clock().piece_count(max_turn_);
    ScrewTrajectory other(ends_.with_goal(goal_in_world), max_turn_);
    if (const ScrewClock turn = other.clock(); turn.piece_count(max_turn_) != pieces)
        other.max_turn_ = std::min(turn.angle() / (double(pieces) - 0.5), std::numbers::pi);
    return std::make_shared<const ErasedTrajectory<ScrewTrajectory>>(std::move(other));
}

ScrewNumbers ScrewTrajectory::numbers() const {
    const RelativeEnds ends(ends_);
    return ScrewPath(ends.start, ends.goal).numbers();
}

ScrewClock ScrewTrajectory::clock() const {
    const RelativeEnds ends(ends_);
    return {ends.start, ends.goal};
}

MotionDescription ScrewTrajectory::description() const {
    MotionDescription description{.kind = MotionDescription::Kind::screw, .pieces = {}, .chain = {}};
    const ScrewPieces all = pieces();
    for (std::size_t i = 0; i < all.size(); ++i)
        description.pieces.push_back(all.ends_of(i));
    return description;
}

} // namespace chasles::motion
