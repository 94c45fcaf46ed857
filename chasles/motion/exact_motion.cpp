#include "chasles/motion/exact_motion.h"

#include "chasles/motion/axis_motion.h"
#include "chasles/motion/screw_path.h"

namespace chasles::motion {

namespace {

using Exact = algebra::ExactNumber;
using ExactVector = Vector3<Exact>;

/// Both poses over one unit.
struct Ends {
    GeneralPose<Exact> start;
    GeneralPose<Exact> goal;
    Exact unit;

    [[nodiscard]] ExactVector shift() const { return goal.translation - start.translation; }
};

ExactPose in_fixed_frame(const Pose& given, const Pose* seen_from) {
    const ExactPose pose(given);
    return seen_from ? ExactPose(*seen_from).inverse() * pose : pose;
}

Ends exact_ends(const MotionEnds& ends) {
    const ExactPose start = in_fixed_frame(ends.start, ends.start_seen_from());
    const ExactPose goal = in_fixed_frame(ends.goal, ends.goal_seen_from());
    const auto& [from, start_unit] = start.translation;
    const auto& [to, goal_unit] = goal.translation;
    return {{scale(from, goal_unit), start.rotation}, {scale(to, start_unit), goal.rotation}, start_unit * goal_unit};
}

RationalMotion<Exact> started(const GeneralPose<Exact>& start) {
    RationalMotion<Exact> motion;
    motion.orientation = scaled_rotation_matrix(start.rotation);
    motion.orientation_unit = start.rotation.squared_norm();
    return motion;
}

/// `screw_between`, times 2 |v|^2 of the turn (w, v) in lengths, or 1 where nothing turns.
RationalMotion<Exact> scaled_screw(const Ends& ends) {
    const Quaternion<Exact> turn = turn_between(ends.start, ends.goal);
    const Exact square = dot(turn.v, turn.v);
    const ExactVector shift = ends.shift();
    RationalMotion<Exact> motion = started(ends.start);
    motion.turn_unit = motion.end_cosine = turn.w;
    motion.axis = turn.v;
    if (square.sign() == 0) {
        motion.length_unit = ends.unit;
        motion.origin = ends.start.translation;
        motion.displacement = shift;
        return motion;
    }
    const Exact twice = square + square;
    const ExactVector along = scale(turn.v, dot(turn.v, shift));
    const ExactVector across = scale(shift, square) - along;
    motion.length_unit = ends.unit * twice;
    motion.origin = scale(ends.start.translation, twice);
    motion.displacement = along + along;
    motion.moment = scale(across, turn.w) - cross(turn.v, across);
    return motion;
}

/// `sweep_between`, times the squared norms of both end quaternions in lengths. `norm` is that of the turn.
RationalMotion<Exact> scaled_sweep(const Ends& ends, const Quaternion<Exact>& turn, const Exact& norm,
                                   const ExactVector& centre) {
    const Exact start_square = ends.start.rotation.squared_norm();
    const Exact goal_square = ends.goal.rotation.squared_norm();
    RationalMotion<Exact> motion = started(ends.start);
    motion.turn_unit = norm;
    motion.end_cosine = turn.w;
    motion.axis = turn.v;
    motion.length_unit = ends.unit * start_square * goal_square;
    motion.origin = scale(ends.start.translation, start_square * goal_square);
    const ExactVector reference = scale(motion.orientation * centre, ends.unit * goal_square);
    const ExactVector moved = scale(scaled_rotation_matrix(ends.goal.rotation) * centre, ends.unit * start_square);
    motion.displacement = scale(ends.shift(), start_square * goal_square) + moved - reference;
    motion.moment = cross(reference, turn.v);
    return motion;
}

} // namespace

ExactMotion exact_screw(const MotionEnds& ends) {
    return {nullptr, control_maps(scaled_screw(exact_ends(ends)))};
}

ExactMotion exact_sweep(const MotionEnds& given, const Eigen::Vector3d& centre) {
    const Ends ends = exact_ends(given);
    const Quaternion<Exact> turn = turn_between(ends.start, ends.goal);
    auto radicand = std::make_unique<const algebra::Dyadic>(turn.squared_norm().rational());
    const Exact norm = Exact::root_of(*radicand);
    auto maps = control_maps(scaled_sweep(ends, turn, norm, vector_in<Exact>(centre)));
    return {std::move(radicand), std::move(maps)};
}

} // namespace chasles::motion
