// What is asked of a scalar: how exact it is, and whether it can be divided.
#pragma once

namespace chasles::algebra {

/// A bound on the relative error of one operation in Scalar; zero for exact types.
template <class Scalar>
inline constexpr double unit_roundoff = 0;
template <>
inline constexpr double unit_roundoff<double> = 0x1p-53;

/// Numbers of the exact stage cannot be.
template <class Scalar>
concept Divisible = requires(Scalar a) { a / a; };

} // namespace chasles::algebra
