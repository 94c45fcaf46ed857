// Makes the motions in plain double, by the same templates as in double-double.
// Source: docs/derivations/23-coarse-motion.md.
#include "chasles/motion/coarse_motion.h"

#include <cmath>

namespace chasles::motion {

namespace {

/// A screw in any number of pieces slides unlike the screw in one piece by at most this times |a|^2 of its slide.
constexpr double slide_deviation = 0.1284;

/// The sizes of all translations that a motion is made from.
double size_of(const MotionEnds& ends) {
    const auto size = [](const Pose& pose) { return norm1(vector_in<double>(pose.translation)); };
    const double moving = size(ends.start) + size(ends.goal);
    return ends.fixed ? moving + size(ends.fixed->start) + size(ends.fixed->goal) : moving;
}

/// Both end poses in the fixed body's frame, and the turn between them.
struct CoarseEnds {
    GeneralPose<double> start;
    GeneralPose<double> goal;
    Quaternion<double> turn;

    explicit CoarseEnds(const MotionEnds& ends)
        : start(seen_from<double>(ends.start, ends.start_seen_from())),
          goal(seen_from<double>(ends.goal, ends.goal_seen_from())), turn(turn_between(start, goal)) {}

    /// At most 90 degrees. Next to a half turn, rounding would decide which way round the body turns.
    [[nodiscard]] bool turn_is_short() const { return dot(turn.v, turn.v) <= turn.w * turn.w; }
};

} // namespace

std::optional<CoarseMotion> coarse_screw(const MotionEnds& given) {
    const CoarseEnds ends(given);
    if (!ends.turn_is_short())
        return std::nullopt;
    CoarseMotion coarse{screw_between(ends.start, ends.goal, ends.turn), 0, size_of(given)};
    const double square = dot(coarse.path.axis, coarse.path.axis);
    coarse.deviation = slide_deviation * square * length(coarse.path.displacement);
    return coarse;
}

std::optional<CoarseMotion> coarse_sweep(const MotionEnds& given, const Vector3<double>& centre) {
    const CoarseEnds ends(given);
    if (!ends.turn_is_short())
        return std::nullopt;
    const double inverse = 1 / std::sqrt(ends.turn.squared_norm());
    const Quaternion<double> unit{ends.turn.w * inverse, scale(ends.turn.v, inverse)};
    return CoarseMotion{sweep_between(ends.start, ends.goal, unit, centre), 0, size_of(given) + norm1(centre)};
}

std::optional<CoarseMotion> coarse_part(const CoarsePart& part) {
    constexpr double quarter_turn = 1.5707963;
    const auto& [ends, reference, rates, duration, rounding, size] = part;
    if (!(rates.turn_rate * duration <= quarter_turn))
        return std::nullopt;
    const EnclosureBounds bounds = enclosure_bounds(reference, rates, duration, rounding, size);
    return CoarseMotion{sweep_between_ends<double>(ends, reference),
                        bounds.deviation,
                        size,
                        bounds.turn_deviation,
                        reference,
                        bounds.rounding,
                        bounds.turn_rounding};
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
