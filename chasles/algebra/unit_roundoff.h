// How exact a scalar is.
#pragma once

namespace chasles::algebra {

/// A bound on the relative error of one operation in Scalar; zero for exact types.
template <class Scalar>
inline constexpr double unit_roundoff = 0;
template <>
inline constexpr double unit_roundoff<double> = 0x1p-53;

} // namespace chasles::algebra
