// Makes the motions in plain double, by the same templates as in double-double.
// Source: docs/derivations/21-coarse-motion.md.
#include "chasles/motion/coarse_motion.h"

#include <cmath>

namespace chasles::motion {

namespace {

/// The greatest |a|^2 of a screw: a turn of 90 degrees.
constexpr double largest_square = 1;
/// A screw in any number of pieces slides unlike the screw in one piece by at most this times |a|^2 of its slide.
constexpr double slide_deviation = 0.1284;

/// The sizes of all translations that a motion is made from.
double size_of(const MotionEnds& ends) {
    const auto size = [](const Pose& pose) { return norm1(vector_in<double>(pose.translation)); };
    const double moving = size(ends.start) + size(ends.goal);
    return ends.fixed ? moving + size(ends.fixed->start) + size(ends.fixed->goal) : moving;
}

} // namespace

std::optional<CoarseMotion> coarse_screw(const MotionEnds& ends) {
    const auto start = seen_from<double>(ends.start, ends.start_seen_from());
    const auto goal = seen_from<double>(ends.goal, ends.goal_seen_from());
    CoarseMotion coarse{screw_between(start, goal), 0, size_of(ends)};
    const double square = dot(coarse.path.axis, coarse.path.axis);
    if (!(square <= largest_square)) // also if the square is not a number
        return std::nullopt;
    coarse.deviation = slide_deviation * square * length(coarse.path.displacement);
    return coarse;
}

CoarseMotion coarse_sweep(const MotionEnds& ends, const Vector3<double>& centre) {
    const auto start = seen_from<double>(ends.start, ends.start_seen_from());
    const auto goal = seen_from<double>(ends.goal, ends.goal_seen_from());
    const Quaternion<double> turn = turn_between(start, goal);
    const double inverse = 1 / std::sqrt(turn.squared_norm());
    const Quaternion<double> unit{turn.w * inverse, scale(turn.v, inverse)};
    return {sweep_between(start, goal, unit, centre), 0, size_of(ends) + norm1(centre)};
}

MatrixPose position_at(const RationalMotion<double>& path, double tau) {
    const Quaternion<double> turn{1 + tau * (path.end_cosine - 1), scale(path.axis, tau)};
    const double weight = turn.squared_norm();
    // The swing of the body's origin is (2 tau e m + 2 tau^2 a x m) / W.
    const Vector3<double> swing = scale(path.moment, turn.w) + cross(turn.v, path.moment);
    const Vector3<double> slid = path.origin + scale(path.displacement, tau);
    return {scale(scaled_rotation_matrix(turn), 1 / weight) * path.orientation, slid + scale(swing, 2 * tau / weight)};
}

} // namespace chasles::motion
