#include "chasles/query/far_apart.h"

#include "chasles/motion/screw_pose.h"
#include "chasles/query/body_ball.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace chasles::query {

namespace {

/// Of the sizes of all that enters: a hundred roundings would take a hundredth of it.
constexpr double slack = 1e-12;

} // namespace

bool are_far_apart(const Polyhedron& moving, const Polyhedron& fixed, const MotionFrame& frame) {
    const motion::Ball mover = ball_around(moving.hierarchy());
    const motion::Ball target = ball_around(fixed.hierarchy());
    const Eigen::Isometry3d start_pose = motion::rounded(frame.start).isometry();
    const Eigen::Isometry3d goal_pose = motion::rounded(frame.goal).isometry();
    const Eigen::Vector3d start = start_pose * mover.centre;
    const Eigen::Vector3d goal = goal_pose * mover.centre;
    double reach = (goal - start).norm(); // of the ball's centre from where it starts, and from where it ends
    double size = mover.centre.norm() + target.centre.norm() + mover.radius + target.radius +
                  start_pose.translation().norm() + goal_pose.translation().norm();
    if (frame.swept_centre) {
        const Eigen::Vector3d arm = mover.centre - *frame.swept_centre;
        const Eigen::Vector3d turned = goal_pose.linear() * arm - start_pose.linear() * arm;
        reach = (goal - start - turned).norm() + turned.norm();
        size += 2 * frame.swept_centre->norm();
    }
    const double away = std::max((start - target.centre).norm(), (goal - target.centre).norm());
    return away - mover.radius - target.radius - reach > slack * size;
}

} // namespace chasles::query
