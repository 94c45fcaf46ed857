// The semi-static error bound of the elementary detections: one length and one ratio per motion and pair of bodies.
// Source: docs/derivations/06-first-feasible.md, section "Constants".
#pragma once

#include "chasles/motion/control_maps.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace chasles::elementary {

/// Bounds every coefficient error by error_unit * length * (norms of the directions that enter) * weight.
struct ErrorScale {
    double length = 0;     ///< of positions, differences of positions, and moments of unit directions, over the weight
    double norm_bound = 1; ///< of turned unit directions over the weight; 1 for a rotation, more for its control maps
    double half_angle_secant =
        1; ///< 1 / cos of half of the turn of a screw: the factor by which errors in double-double grow
};

/// Relative error of a coefficient, counted in the notes: most of it is that of the maps themselves
/// (docs/derivations/10-error-bounds.md). In exact scalars there is none.
template <class S>
inline constexpr double error_unit = 0;
template <>
inline constexpr double error_unit<double> = 160 * algebra::unit_roundoff<double>;
template <>
inline constexpr double error_unit<algebra::DoubleDouble> = 1024 * algebra::unit_roundoff<algebra::DoubleDouble>;

/// The same for one motion.
template <class S>
double relative_error(const ErrorScale& scale) {
    return std::is_same_v<S, double> ? error_unit<S> : error_unit<S> * scale.half_angle_secant;
}

/// What underflow adds at most, far below any bound of bodies of size 1e-30 with features of 1e-50. Makes signs of
/// numbers that lost digits to underflow count for nothing, also where subnormal numbers are flushed to zero.
inline constexpr double underflow = 0x1p-760;

/// The bound of a coefficient's error, over the weight.
template <class S>
S with_underflow(const S& relative_part) {
    return error_unit<S> > 0 ? S(relative_part + S(underflow)) : relative_part;
}

/// The scale for moving points with coordinates up to `moving_reach` in the body's frame and fixed points up to
/// `fixed_reach`, both in the mesh's unit, under maps over [0, 1].
inline ErrorScale error_scale(const motion::ControlMaps<double>& maps, double moving_reach, double fixed_reach) {
    ErrorScale scale;
    scale.half_angle_secant = std::sqrt(std::max(1.0, maps.weight[3]));
    for (int lane = 0; lane <= 3; ++lane) {
        const double weight = maps.weight[lane];
        double rows = 0, columns = 0, shift = 0, inverse = 0, moment = 0;
        for (int i = 0; i < 3; ++i) {
            double row = 0, column = 0;
            for (int j = 0; j < 3; ++j) {
                row += std::abs(maps.rotation.row[i][j][lane]);
                column += std::abs(maps.rotation.row[j][i][lane]);
                moment = std::max(moment, std::abs(maps.moment.row[i][j][lane]));
            }
            rows = std::max(rows, row);
            columns = std::max(columns, column);
            shift = std::max(shift, std::abs(maps.translation[i][lane]));
            inverse = std::max(inverse, std::abs(maps.inverse_translation[i][lane]));
        }
        const double turned = std::max(rows, columns) / weight;
        scale.norm_bound = std::max(scale.norm_bound, turned);
        scale.length = std::max({scale.length, turned * moving_reach + shift / weight + fixed_reach,
                                 turned * fixed_reach + inverse / weight + moving_reach,
                                 turned * (moving_reach + fixed_reach) + moment / weight});
    }
    return scale;
}

} // namespace chasles::elementary
