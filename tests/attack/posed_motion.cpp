#include "tests/attack/posed_motion.h"

#include "tests/support/trajectories.h"

namespace chasles::attack {

namespace {

using Scalar = motion::RelativeEnds::Scalar;

Rational exact_number(const Scalar& x) {
    return Rational(x.high()) + Rational(x.low());
}

Triple exact_triple(const algebra::Vector3<Scalar>& v) {
    return {exact_number(v.x), exact_number(v.y), exact_number(v.z)};
}

ExactPose exact_frame_pose(const motion::GeneralPose<Scalar>& pose) {
    return {exact_triple(pose.translation), {exact_number(pose.rotation.w), exact_triple(pose.rotation.v)}};
}

} // namespace

Motion PosedMotion::motion() const {
    if (kind == MotionKind::screw)
        return *screw();
    return is_relative ? SweepMotion::relative(moving_start, moving_goal, fixed_start, fixed_goal)
                       : SweepMotion::between(moving_start, moving_goal);
}

std::optional<ScrewMotion> PosedMotion::screw() const {
    if (kind != MotionKind::screw)
        return std::nullopt;
    return is_relative ? ScrewMotion::relative(moving_start, moving_goal, fixed_start, fixed_goal, max_turn)
                       : ScrewMotion::between(moving_start, moving_goal, max_turn);
}

std::vector<MotionPath<Rational>> PosedMotion::paths() const {
    using reference::exact_pose;
    const auto seen = [&](const Pose& moving, const Pose& fixed) {
        return is_relative ? reference::seen_from(exact_pose(fixed), exact_pose(moving)) : exact_pose(moving);
    };
    const ExactPose start = seen(moving_start, fixed_start);
    const ExactPose goal = seen(moving_goal, fixed_goal);
    if (kind == MotionKind::sweep)
        return {reference::sweep_path(start, goal)};
    const std::vector<ScrewMotion> pieces = screw()->pieces();
    std::vector<MotionPath<Rational>> result;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const motion::RelativeEnds ends = test::relative_ends_of(pieces[i]);
        result.push_back(reference::screw_path(i == 0 ? start : exact_frame_pose(ends.start),
                                               i + 1 == pieces.size() ? goal : exact_frame_pose(ends.goal)));
    }
    return result;
}

Pose rounded_pose(const ExactPose& pose) {
    const auto number = [](const Rational& x) { return static_cast<double>(x); };
    const auto& t = pose.translation;
    const auto& q = pose.rotation;
    return Pose(Eigen::Vector3d(number(t[0]), number(t[1]), number(t[2])),
                Eigen::Quaterniond(number(q.w), number(q.v[0]), number(q.v[1]), number(q.v[2])));
}

} // namespace chasles::attack
