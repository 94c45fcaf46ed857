// Sine and cosine in double and in double-double.
// Source: docs/derivations/25-even-motions.md, "Sine and cosine".
#pragma once

#include "chasles/algebra/double_double.h"

namespace chasles::algebra {

template <class S>
struct SineCosine {
    S sine;
    S cosine;
};

/// By the C library.
inline SineCosine<double> sine_cosine(double angle) {
    return {std::sin(angle), std::cos(angle)};
}

inline double angle_of(const SineCosine<double>& direction) {
    return std::atan2(direction.sine, direction.cosine);
}

/// With an error of at most 2^-96 for angles up to 200 radians, and 2^-94 up to 1000.
SineCosine<DoubleDouble> sine_cosine(const DoubleDouble& angle);

/// The angle in (-pi, pi] of a direction, for a sine and a cosine whose squares sum up to one, with an error of at most
/// 2^-95.
DoubleDouble angle_of(const SineCosine<DoubleDouble>& direction);

} // namespace chasles::algebra
