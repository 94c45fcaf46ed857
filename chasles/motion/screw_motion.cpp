#include "chasles/motion/screw_motion.h"

#include "chasles/invalid_input.h"
#include "chasles/motion/screw_pose.h"

#include <cmath>
#include <numbers>

namespace chasles {

namespace {

/// The half-angle tangent of a longer turn exceeds 1000, and the error bounds grow with it.
constexpr double largest_turn = std::numbers::pi - 2e-3;
/// Turns that exceed a whole number of pieces by this part, which is rounding, get no further piece.
constexpr double turn_slack = 1e-9;
/// Below this turn, tau and time differ by less than half an ulp (their ratio is 1 + O(angle^2)).
constexpr double uniform_turn = 1e-9;

} // namespace

ScrewMotion ScrewMotion::from(MotionFrame frame) {
    ScrewMotion screw;
    screw.turn_ = motion::turn_angle(frame.start, frame.goal);
    if (screw.turn_.angle <= largest_turn * (1 + 2 * turn_slack))
        frame.motion = motion::screw_between(frame.start, frame.goal);
    screw.frame_ = std::move(frame);
    return screw;
}

ScrewMotion ScrewMotion::between(const Pose& start, const Pose& goal) {
    return from(MotionFrame::between(start, goal));
}

ScrewMotion ScrewMotion::relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                  const Pose& fixed_goal) {
    return from(MotionFrame::relative(moving_start, moving_goal, fixed_start, fixed_goal));
}

double ScrewMotion::tau_at(double time) const {
    if (time <= 0 || time >= 1) // the ends to the last bit
        return time <= 0 ? 0 : 1;
    return angle() < uniform_turn ? time : std::tan(angle() / 2 * time) / turn_.half_tangent;
}

double ScrewMotion::time_at(double tau) const {
    const double tangent = turn_.half_tangent; // itself to the last bit: the arc tangents then lose none
    return angle() < uniform_turn ? tau : std::atan(tau * tangent) / std::atan(tangent);
}

double ScrewMotion::tau_rate(double tau) const {
    const double tangent = turn_.half_tangent;
    return angle() < uniform_turn ? 1 : std::atan(tangent) / tangent * (1 + tau * tau * tangent * tangent);
}

Pose ScrewMotion::pose_at(double time) const {
    return frame_.in_world(motion::screw_pose(frame_.start, frame_.goal, {time, tau_at(time)}), time);
}

std::size_t ScrewMotion::piece_count(double max_turn) const {
    if (!(max_turn >= least_max_turn))
        throw InvalidInput("motion: max_turn: must be at least 1e-4 radians");
    const double count = std::ceil(angle() / std::min(max_turn, largest_turn) * (1 - turn_slack));
    return std::max<std::size_t>(1, static_cast<std::size_t>(count));
}

ScrewMotion ScrewMotion::piece(std::size_t index, std::size_t count) const {
    return ScrewPieces(*this, count)[index];
}

std::vector<ScrewMotion> ScrewMotion::cut(double max_turn) const {
    const std::size_t count = piece_count(max_turn);
    const ScrewPieces whole(*this, count);
    std::vector<ScrewMotion> pieces;
    for (std::size_t i = 0; i < count; ++i)
        pieces.push_back(whole[i]);
    return pieces;
}

motion::ScrewNumbers ScrewMotion::numbers() const {
    return motion::ScrewPath(frame_.start, frame_.goal).numbers();
}

ScrewPieces::ScrewPieces(const ScrewMotion& screw, std::size_t count) : screw_(screw), count_(count) {
    if (count > 1)
        path_.emplace(screw.frame().start, screw.frame().goal);
}

ScrewMotion ScrewPieces::operator[](std::size_t index) const {
    if (count_ == 1)
        return screw_;
    const MotionFrame& whole = screw_.frame();
    const auto time_of = [&](std::size_t i) { return double(i) / double(count_); };
    const auto pose_of = [&](std::size_t i) { return path_->at({time_of(i), time_of(i)}); }; // the same bits each time
    MotionFrame piece = whole;
    if (index > 0) {
        piece.given_start = {pose_of(index), {}};
        piece.start = motion::exact(piece.given_start.pose);
        piece.fixed_start = whole.fixed_pose_at(time_of(index));
    }
    if (index + 1 < count_) {
        piece.given_goal = {pose_of(index + 1), {}};
        piece.goal = motion::exact(piece.given_goal.pose);
        piece.fixed_goal = whole.fixed_pose_at(time_of(index + 1));
    }
    return ScrewMotion::from(std::move(piece));
}

} // namespace chasles
