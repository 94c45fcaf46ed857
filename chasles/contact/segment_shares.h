// Where two segments are nearest to each other, up to rounding.
#pragma once

#include <algorithm>
#include <utility>

namespace chasles::contact {

/// The shares of two segments at which their nearest points are: one from p along u, the other from q along v, where
/// `apart` is p - q. `dot` is the scalar product of the vectors.
template <class Vector, class Dot>
std::pair<double, double> nearest_shares(const Vector& apart, const Vector& u, const Vector& v, const Dot& dot) {
    const double a = dot(u, u), e = dot(v, v), f = dot(v, apart);
    const double b = dot(u, v), c = dot(u, apart), determinant = a * e - b * b;
    double s = determinant > 0 ? std::clamp((b * f - c * e) / determinant, 0.0, 1.0) : 0;
    double t = e > 0 ? (b * s + f) / e : 0;
    if (t < 0 || t > 1 || e == 0) {
        t = std::clamp(t, 0.0, 1.0);
        s = a > 0 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0;
    }
    return {s, t};
}

} // namespace chasles::contact
