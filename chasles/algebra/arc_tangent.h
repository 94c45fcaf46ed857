// Arc tangent and arc sine in double and in double-double, with the same bits on every machine.
// Source: docs/derivations/33-angles-in-double.md.
#pragma once

#include "chasles/algebra/sine_cosine.h"

namespace chasles::algebra {

/// The angle of the direction (x, y) in [-pi, pi], with an error of at most 0.51 ulp. Not a number if both are
/// infinite.
double arc_tangent(double y, double x);
inline double arc_tangent(double tangent) {
    return arc_tangent(tangent, 1);
}
/// In [-pi/2, pi/2], with an error of at most 0.51 ulp. Not a number outside of [-1, 1].
double arc_sine(double sine);

/// The angle of a direction of any length.
inline double angle_of(const SineCosine<double>& direction) {
    return arc_tangent(direction.sine, direction.cosine);
}
/// The angle in (-pi, pi] of a direction, for a sine and a cosine whose squares sum up to one, with an error of at most
/// 2^-95.
DoubleDouble angle_of(const SineCosine<DoubleDouble>& direction);

} // namespace chasles::algebra
