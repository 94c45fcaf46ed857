// The numbers of a motion that an answer shows: the screw between the end poses, and the turn until the contact.
#pragma once

#include "chasles/chasles.h"

namespace chasles::view {

/// For a sweep these are the numbers of the screw with equal end poses. The sweep itself follows another path.
struct MotionNumbers {
    double angle = 0; ///< radians
    double slide = 0; ///< mesh unit
    Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();
    Eigen::Vector3d axis_direction = Eigen::Vector3d::UnitZ();
    bool is_sweep = false;
    double travel = 0; ///< path length of the sweep's reference point, mesh unit
};

MotionNumbers numbers_of(const ScrewMotion& screw);
MotionNumbers numbers_of(const SweepMotion& sweep);

/// The angle turned until a time, in radians. `tau` is the same time in the paper's parameter.
double turned_so_far(const MotionNumbers& motion, double time, double tau);

} // namespace chasles::view
