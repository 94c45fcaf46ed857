#include "chasles/motion/screw_motion.h"

#include "chasles/motion/screw_piece.h"

namespace chasles {

namespace {

motion::ScrewClock clock_of(const MotionEnds& ends) {
    const MotionFrame frame(ends);
    return {frame.start, frame.goal};
}

motion::ScrewNumbers numbers_of(const MotionEnds& ends) {
    const MotionFrame frame(ends);
    return motion::ScrewPath(frame.start, frame.goal).numbers();
}

} // namespace

ScrewMotion ScrewMotion::between(const Pose& start, const Pose& goal) {
    return {start, goal};
}

ScrewMotion ScrewMotion::relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                  const Pose& fixed_goal) {
    return ScrewMotion(MotionEnds::relative(moving_start, moving_goal, fixed_start, fixed_goal));
}

double ScrewMotion::angle() const {
    return clock_of(ends_).angle();
}

double ScrewMotion::slide() const {
    return numbers_of(ends_).slide;
}

Eigen::Vector3d ScrewMotion::axis_direction() const {
    return numbers_of(ends_).axis_direction;
}

Eigen::Vector3d ScrewMotion::axis_point() const {
    return numbers_of(ends_).axis_point;
}

double ScrewMotion::tau_at(double time) const {
    return clock_of(ends_).tau_at(time);
}

double ScrewMotion::time_at(double tau) const {
    return clock_of(ends_).time_at(tau);
}

double ScrewMotion::tau_rate(double tau) const {
    return clock_of(ends_).tau_rate(tau);
}

Pose ScrewMotion::pose_at(double time) const {
    if (time <= 0 || time >= 1)
        return ends_.pose_at_end(time);
    return motion::ScrewPiece(ends_).pose_at(time);
}

MotionFrame ScrewMotion::frame() const {
    return motion::ScrewPiece(ends_).frame();
}

std::size_t ScrewMotion::piece_count(double max_turn) const {
    return clock_of(ends_).piece_count(max_turn);
}

ScrewMotion ScrewMotion::piece(std::size_t index, std::size_t count) const {
    return ScrewMotion(motion::ScrewPieces(MotionFrame(ends_), count)[index]);
}

std::vector<ScrewMotion> ScrewMotion::cut(double max_turn) const {
    const std::size_t count = piece_count(max_turn);
    const MotionFrame whole(ends_);
    const motion::ScrewPieces all(whole, count);
    std::vector<ScrewMotion> pieces;
    for (std::size_t i = 0; i < count; ++i)
        pieces.push_back(ScrewMotion(all[i]));
    return pieces;
}

} // namespace chasles
