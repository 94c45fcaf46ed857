// The orbits of a motion: where it turns about one axis and slides along it in proportion, each point of the moving
// body stays on one helix. Source: docs/derivations/32-orbits.md.
#pragma once

#include "chasles/motion/matrix_pose.h"
#include "chasles/motion/rational_motion.h"

#include <optional>

namespace chasles::motion {

/// An axis in the frame of a body, with two directions across it. The directions are unit, at right angles and
/// right-handed up to rounding.
struct AxisFrame {
    Vector3<double> origin{};
    Vector3<double> across{};
    Vector3<double> beside{};
    Vector3<double> along{};
};

/// A helical motion, with the distance of a cubic motion from it. At the turn `phi` the frame of the moving body is at
/// the turn phi about the axis, and at the height `pitch` phi along it, relative to the frame of the fixed body.
struct Orbit {
    MatrixPose start; ///< of the moving body in the frame of the fixed body
    AxisFrame moving;
    AxisFrame fixed;
    double pitch = 0;      ///< length per radian
    double turn = 0;       ///< of the whole motion, which begins at turn 0, in radians; positive
    double deviation = 0;  ///< of any point of the moving body from its helix at the motion's turn, in the length unit
    double unevenness = 0; ///< bound of |tau - phi / turn|
};

/// The orbit of a cubic motion, in double. Empty if it turns by less than a thousandth of a radian or slides across its
/// axis by more than `most_deviation`.
std::optional<Orbit> orbit_of(const RationalMotion<algebra::DoubleDouble>& motion, double most_deviation);

} // namespace chasles::motion
