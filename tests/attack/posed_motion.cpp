#include "tests/attack/posed_motion.h"

namespace chasles::attack {

namespace {

using Scalar = MotionFrame::Scalar;

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
        return is_relative ? ScrewMotion::relative(moving_start, moving_goal, fixed_start, fixed_goal)
                           : ScrewMotion::between(moving_start, moving_goal);
    return is_relative ? SweepMotion::relative(moving_start, moving_goal, fixed_start, fixed_goal)
                       : SweepMotion::between(moving_start, moving_goal);
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
    const ScrewMotion whole = std::get<ScrewMotion>(motion());
    const std::size_t count = whole.piece_count(max_turn);
    std::vector<MotionPath<Rational>> result;
    for (std::size_t i = 0; i < count; ++i) {
        const MotionFrame frame = whole.piece(i, count).frame();
        result.push_back(reference::screw_path(i == 0 ? start : exact_frame_pose(frame.start),
                                               i + 1 == count ? goal : exact_frame_pose(frame.goal)));
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
