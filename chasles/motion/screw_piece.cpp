#include "chasles/motion/screw_piece.h"

namespace chasles::motion {

ScrewPiece::ScrewPiece(const MotionEnds& ends) : frame_(ends), clock_(frame_.start, frame_.goal) {
    if (clock_.is_short())
        frame_.motion = screw_between(frame_.start, frame_.goal);
}

Pose ScrewPiece::pose_at(double time) const {
    return frame_.in_world(screw_pose(frame_.start, frame_.goal, {time, clock_.tau_at(time)}), time);
}

ScrewPieces::ScrewPieces(const MotionFrame& screw, std::size_t count) : screw_(screw), count_(count) {
    if (count > 1)
        path_.emplace(screw.start, screw.goal);
}

MotionEnds ScrewPieces::operator[](std::size_t index) const {
    const auto time_of = [&](std::size_t i) { return double(i) / double(count_); };
    const auto pose_of = [&](std::size_t i) { return path_->at({time_of(i), time_of(i)}); }; // the same bits each time
    MotionEnds piece = screw_;
    if (index > 0) {
        piece.given_start = {pose_of(index), {}};
        if (piece.fixed)
            piece.fixed->start = screw_.fixed_pose_at(time_of(index));
    }
    if (index + 1 < count_) {
        piece.given_goal = {pose_of(index + 1), {}};
        if (piece.fixed)
            piece.fixed->goal = screw_.fixed_pose_at(time_of(index + 1));
    }
    return piece;
}

} // namespace chasles::motion
