#include "chasles/motion/screw_motion.h"

#include "chasles/invalid_input.h"
#include "chasles/motion/screw_pose.h"

#include <cmath>
#include <numbers>

namespace chasles {

namespace {

/// The half-angle tangent of a longer turn exceeds 1000, and the error bounds grow with it.
constexpr double largest_turn = std::numbers::pi - 2e-3;
/// Below this turn, tau and time differ by less than half an ulp (their ratio is 1 + O(angle^2)).
constexpr double uniform_turn = 1e-9;

} // namespace

ScrewMotion ScrewMotion::from(MotionFrame frame) {
    ScrewMotion screw;
    if (motion::turn_angle(frame.start, frame.goal) <= largest_turn)
        frame.motion = motion::screw_between(frame.start, frame.goal);
    screw.numbers_ = motion::screw_numbers(frame.start, frame.goal);
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
    const double half = angle() / 2;
    return angle() < uniform_turn ? time : std::tan(half * time) / std::tan(half);
}

double ScrewMotion::time_at(double tau) const {
    const double half = angle() / 2;
    return angle() < uniform_turn ? tau : std::atan(tau * std::tan(half)) / half;
}

Pose ScrewMotion::pose_at(double time) const {
    return frame_.in_world(motion::screw_pose(frame_.start, frame_.goal, {time, tau_at(time)}), time);
}

std::vector<ScrewMotion> ScrewMotion::cut(double max_turn) const {
    if (!(max_turn > 0))
        throw InvalidInput("motion: max_turn: must be positive");
    const double turn = std::min(max_turn, largest_turn);
    // A turn that exceeds a multiple of max_turn only by rounding is not worth another piece.
    const auto pieces = static_cast<int>(std::ceil(angle() / turn * (1 - 1e-9)));
    if (pieces <= 1)
        return {*this};
    std::vector<ScrewMotion> result;
    MotionFrame piece = frame_;
    for (int i = 1; i <= pieces; ++i) {
        const double time = double(i) / pieces;
        piece.goal = i == pieces ? frame_.goal
                                 : motion::exact(motion::screw_pose(frame_.start, frame_.goal, {time, time}));
        piece.fixed_goal = i == pieces ? frame_.fixed_goal : frame_.fixed_pose_at(time);
        result.push_back(from(piece));
        piece.start = piece.goal;
        piece.fixed_start = piece.fixed_goal;
    }
    return result;
}

} // namespace chasles
