// A screw turns in proportion to time. A sweep turns by the normalised interpolation of quaternions
// (docs/derivations/02-rational-motion.md).
#include "view/motion_numbers.h"

#include <cmath>

namespace chasles::view {

MotionNumbers numbers_of(const ScrewMotion& screw) {
    return {.angle = screw.angle(),
            .slide = screw.slide(),
            .axis_point = screw.axis_point(),
            .axis_direction = screw.axis_direction()};
}

MotionNumbers numbers_of(const SweepMotion& sweep) {
    MotionNumbers numbers = numbers_of(sweep.screw_of_same_poses());
    numbers.is_sweep = true;
    numbers.travel = sweep.displacement().norm();
    return numbers;
}

double turned_so_far(const MotionNumbers& motion, double time, double tau) {
    if (!motion.is_sweep)
        return motion.angle * time;
    return 2 * std::atan2(tau * std::sin(motion.angle / 2), 1 + tau * (std::cos(motion.angle / 2) - 1));
}

} // namespace chasles::view
