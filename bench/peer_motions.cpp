#include "bench/peer_motions.h"

#include "chasles/motion/screw_path.h"

namespace chasles::bench {

using chasles::motion::exact;

Eigen::Isometry3d on_uniform_screw(const Displacement& motion, double time) {
    return chasles::motion::screw_pose(exact(motion.start), exact(motion.goal), {time, time}).isometry();
}

Eigen::Isometry3d without_turning(const Displacement& motion, double time) {
    Pose pose = motion.start;
    pose.translation += time * (motion.goal.translation - motion.start.translation);
    return pose.isometry();
}

} // namespace chasles::bench
