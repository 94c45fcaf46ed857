// Properties of a scalar type: the rounding error of one operation, and whether the type has a division.
#pragma once

namespace chasles::algebra {

/// A bound on the relative error of one operation in Scalar; zero for exact types.
template <class Scalar>
inline constexpr double unit_roundoff = 0;
template <>
inline constexpr double unit_roundoff<double> = 0x1p-53;

/// Scalars with a division. Dyadic and ExactNumber have none.
template <class Scalar>
concept Divisible = requires(Scalar a) { a / a; };

} // namespace chasles::algebra
