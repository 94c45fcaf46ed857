// A fast, correctly rounded normalization for quaternions that are already close to unit length, as in most poses.
// Source: docs/derivations/10-error-bounds.md, "Length one".
#pragma once

#include "chasles/algebra/lanes.h"

#include <cmath>

namespace chasles::motion {

/// The four numbers of a quaternion, in any order.
using FourNumbers = algebra::Lanes<4, double>;

/// The numbers of the normalized quaternion. If `is_certain`, they are proven to be rounded to nearest.
struct UnitNumbers {
    FourNumbers numbers;
    bool is_certain;
};

namespace detail {

/// The sum in a fixed order.
inline double sum_of(const FourNumbers& numbers) {
    return (numbers[0] + numbers[1]) + (numbers[2] + numbers[3]);
}

/// (|q|^2 - 1) / 2. If the value is small, its error is at most 2^-76.
inline double half_excess(const FourNumbers& q) {
    const FourNumbers grid =
        FourNumbers::broadcast(0x1.8p26); // rounds to multiples of 2^-26, whose squares have no error
    const FourNumbers near = (q + grid) - grid;
    return 0.5 * ((sum_of(near * near) - 1) + sum_of((q - near) * (q + near)));
}

/// Whether each size is 0 or at least 2^-900. Then no underflow changes the result. s (s - 2^-900) is negative only for
/// sizes in between.
inline bool are_in_range(const FourNumbers& sizes) {
    const FourNumbers scale = FourNumbers::broadcast(0x1p500);
    const FourNumbers beyond = sizes - FourNumbers::broadcast(0x1p-900);
    return all_above((sizes * scale) * (beyond * scale), FourNumbers::broadcast(-0x1p-1000));
}

} // namespace detail

/// Normalizes a quaternion. The result is not certain if the length differs from one by more than rounding errors, or
/// if a number lies next to the middle of two doubles.
inline UnitNumbers unit_of_near_unit(const FourNumbers& quaternion) {
    const FourNumbers numbers = quaternion + FourNumbers::broadcast(0); // turns -0 into 0
    const FourNumbers sizes = magnitude(numbers);
    const double excess = detail::half_excess(numbers);
    const FourNumbers change = numbers * FourNumbers::broadcast(-excess);
    const FourNumbers error = sizes * FourNumbers::broadcast(0x1p-74); // twice the error of the change
    const FourNumbers upper = numbers + (change + error);
    const FourNumbers gap = upper - (numbers + (change - error)); // 0 if both bounds round to one double
    return {upper, std::abs(excess) < 0x1p-46 && all_above(FourNumbers::broadcast(0x1p-1000), gap) &&
                       detail::are_in_range(sizes)};
}

} // namespace chasles::motion
