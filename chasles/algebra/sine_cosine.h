// Sine, cosine and tangent in double and in double-double, with the same bits on every machine.
// Source: docs/derivations/25-even-motions.md and docs/derivations/33-angles-in-double.md.
#pragma once

#include "chasles/algebra/double_double.h"

namespace chasles::algebra {

template <class S>
struct SineCosine {
    S sine;
    S cosine;
};

/// With errors of at most 2/3 of an ulp for angles up to 2^17 radians. A larger angle counts as one within half an ulp.
SineCosine<double> sine_cosine(double angle);
/// With an error of at most 2^-96 for angles up to 200 radians, and 2^-94 up to 1000.
SineCosine<DoubleDouble> sine_cosine(const DoubleDouble& angle);

inline double sine(double angle) {
    return sine_cosine(angle).sine;
}
inline double cosine(double angle) {
    return sine_cosine(angle).cosine;
}
/// With an error of at most 0.8 ulp, for the same angles.
double tangent(double angle);

} // namespace chasles::algebra
