// The numbers of a motion that an answer shows: the screw between its end poses, and how far along it a contact lies.
#pragma once

#include "chasles/chasles.h"

namespace chasles::view {

/// Of a sweep these are the numbers of the screw with the same end poses; the sweep itself runs another way between.
struct MotionNumbers {
    double angle = 0; ///< radians
    double slide = 0; ///< mesh unit
    Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();
    Eigen::Vector3d axis_direction = Eigen::Vector3d::UnitZ();
    bool is_sweep = false;
    double travel = 0; ///< of the sweep's reference point, mesh unit
};

MotionNumbers numbers_of(const Motion& motion);

/// Radians turned when `found` says that contact begins.
double turned_so_far(const MotionNumbers& motion, const FirstContact& found);

} // namespace chasles::view
