// Random poses with a chosen turn between them.
#pragma once

#include "chasles/motion/pose.h"
#include "tests/support/random.h"

namespace chasles::test {

inline Eigen::Vector3d random_point(Random& random, double size) {
    const algebra::Vector3<double> v = random.vector(size);
    return {v.x, v.y, v.z};
}

/// A random pose. Its quaternion is not normalised.
inline Pose random_pose(Random& random, double size) {
    const Eigen::Vector3d v = random_point(random, 1);
    return Pose(random_point(random, size), Eigen::Quaterniond(random.uniform(-1, 1), v.x(), v.y(), v.z()));
}

/// A goal pose turned by `angle` from `start` about a random axis, and shifted by up to `size`.
inline Pose random_goal(Random& random, const Pose& start, double angle, double size) {
    const Eigen::Vector3d axis = random_point(random, 1).normalized();
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, axis));
    return Pose(start.translation + random_point(random, size), turn * start.rotation);
}

} // namespace chasles::test
