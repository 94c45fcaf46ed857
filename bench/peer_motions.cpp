#include "bench/peer_motions.h"

#include "chasles/motion/screw_motion.h"

namespace chasles::bench {

namespace {

Eigen::Isometry3d placed(const Eigen::Quaterniond& orientation, const Eigen::Vector3d& origin) {
    Eigen::Isometry3d pose(orientation);
    pose.pretranslate(origin);
    return pose;
}

} // namespace

Eigen::Isometry3d on_uniform_screw(const Displacement& motion, double time) {
    const ScrewMotion screw = ScrewMotion::between(motion.start, motion.goal);
    const Eigen::Vector3d along = screw.axis_direction();
    const Eigen::Vector3d point = screw.axis_point();
    const Eigen::AngleAxisd turn(time * screw.angle(), along);
    const Eigen::Vector3d origin = point + turn * (motion.start.translation - point) + time * screw.slide() * along;
    return placed(turn * Eigen::Quaterniond(motion.start.rotation), origin);
}

Eigen::Isometry3d without_turning(const Displacement& motion, double time) {
    return placed(Eigen::Quaterniond(motion.start.rotation).normalized(),
                  motion.start.translation + time * (motion.goal.translation - motion.start.translation));
}

} // namespace chasles::bench
