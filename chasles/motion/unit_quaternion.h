// Quaternions of length one, for less where they nearly are already, as those of poses mostly are.
// Source: docs/derivations/10-error-bounds.md, "Length one".
#pragma once

#include "chasles/algebra/lanes.h"

#include <cmath>

namespace chasles::motion {

/// The numbers of a quaternion, in any order.
using FourNumbers = algebra::Lanes<4, double>;

/// Those of the quaternion of length one, rounded to nearest, if `is_certain`.
struct UnitNumbers {
    FourNumbers numbers;
    bool is_certain;
};

namespace detail {

inline double sum_of(const FourNumbers& numbers) {
    return (numbers[0] + numbers[1]) + (numbers[2] + numbers[3]);
}

/// Half of |q|^2 - 1; if that is little, to within 2^-76.
inline double half_excess(const FourNumbers& q) {
    const FourNumbers grid =
        FourNumbers::broadcast(0x1.8p26); // rounds to multiples of 2^-26, whose squares have no error
    const FourNumbers near = (q + grid) - grid;
    return 0.5 * ((sum_of(near * near) - 1) + sum_of((q - near) * (q + near)));
}

/// All are 0 or at least 2^-900, so that nothing underflows that matters: s (s - 2^-900) is negative in between only.
inline bool are_in_range(const FourNumbers& sizes) {
    const FourNumbers scale = FourNumbers::broadcast(0x1p500);
    const FourNumbers beyond = sizes - FourNumbers::broadcast(0x1p-900);
    return all_above((sizes * scale) * (beyond * scale), FourNumbers::broadcast(-0x1p-1000));
}

} // namespace detail

/// Not sure of a length that differs from one by more than roundings, nor of numbers next to the middle of two doubles.
inline UnitNumbers unit_of_near_unit(const FourNumbers& quaternion) {
    const FourNumbers numbers = quaternion + FourNumbers::broadcast(0); // there is no -0 in answers
    const FourNumbers sizes = magnitude(numbers);
    const double excess = detail::half_excess(numbers);
    const FourNumbers change = numbers * FourNumbers::broadcast(-excess);
    const FourNumbers doubt = sizes * FourNumbers::broadcast(0x1p-74); // twice as much as the change may be off
    const FourNumbers upper = numbers + (change + doubt);
    const FourNumbers gap = upper - (numbers + (change - doubt)); // 0, or that of two doubles
    return {upper, std::abs(excess) < 0x1p-46 && all_above(FourNumbers::broadcast(0x1p-1000), gap) &&
                       detail::are_in_range(sizes)};
}

} // namespace chasles::motion
