#include "chasles/query/far_apart.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace chasles::query {

namespace {

/// Of the sizes of all that enters: a hundred roundings would take a hundredth of it.
constexpr double slack = 1e-12;

struct Ball {
    Eigen::Vector3d centre;
    double radius;
};

/// Around a body, in its own frame.
Ball ball_of(const BoxHierarchy& hierarchy) {
    const BoxNode& root = hierarchy.nodes()[0];
    const Eigen::Vector3d lower(root.lower[0], root.lower[1], root.lower[2]);
    const Eigen::Vector3d upper(root.upper[0], root.upper[1], root.upper[2]);
    return {hierarchy.centre() + 0.5 * (lower + upper), 0.5 * (upper - lower).norm()};
}

using GeneralPose = motion::GeneralPose<MotionFrame::Scalar>;

Eigen::Vector3d translation(const GeneralPose& pose) {
    const auto& t = pose.translation;
    return {t.x.high(), t.y.high(), t.z.high()};
}

Eigen::Quaterniond rotation(const GeneralPose& pose) {
    const auto& q = pose.rotation;
    return Eigen::Quaterniond(q.w.high(), q.v.x.high(), q.v.y.high(), q.v.z.high()).normalized();
}

} // namespace

bool are_far_apart(const Polyhedron& moving, const Polyhedron& fixed, const MotionFrame& frame) {
    const Ball mover = ball_of(moving.hierarchy());
    const Ball target = ball_of(fixed.hierarchy());
    const Eigen::Quaterniond start_turn = rotation(frame.start);
    const Eigen::Quaterniond goal_turn = rotation(frame.goal);
    const Eigen::Vector3d start = start_turn * mover.centre + translation(frame.start);
    const Eigen::Vector3d goal = goal_turn * mover.centre + translation(frame.goal);
    double reach = (goal - start).norm(); // of the ball's centre from where it starts, and from where it ends
    double size = mover.centre.norm() + target.centre.norm() + mover.radius + target.radius +
                  translation(frame.start).norm() + translation(frame.goal).norm();
    if (frame.swept_centre) {
        const Eigen::Vector3d arm = mover.centre - *frame.swept_centre;
        const Eigen::Vector3d turned = goal_turn * arm - start_turn * arm;
        reach = (goal - start - turned).norm() + turned.norm();
        size += 2 * frame.swept_centre->norm();
    }
    const double away = std::max((start - target.centre).norm(), (goal - target.centre).norm());
    return away - mover.radius - target.radius - reach > slack * size;
}

} // namespace chasles::query
