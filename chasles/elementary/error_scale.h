// The semi-static error bound of the elementary tests: one length and two factors per motion and pair of bodies.
// Source: docs/derivations/06-first-feasible.md, section "Constants".
#pragma once

#include "chasles/motion/control_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace chasles::elementary {

/// Bounds every coefficient error by error_unit * length * (norms of the directions in the product) * weight. Where the
/// motion is only enclosed by the maps, the last two numbers are added: they bound how far the true motion is from the
/// maps (docs/derivations/24-enclosures.md).
struct ErrorScale {
    double length = 0; ///< bound of positions, their differences, and moments of unit directions, over the weight
    double norm_bound =
        1; ///< bound of rotated unit directions over the weight; 1 for a rotation, more for control maps
    double half_angle_secant =
        1;                ///< 1 / cos of half of the turn of a screw: the factor by which errors in double-double grow
    double deviation = 0; ///< of points of the moving body from their true places, in the length unit
    double turn_deviation = 0; ///< of the orientation, in radians
    double axis_deviation = 0; ///< of points along the axis, at most `deviation`
    algebra::Vector3<algebra::DoubleDouble>
        axis{}; ///< of unit length up to rounding, in the frame of the planes and directions; or zero
};

/// The relative error of a coefficient, counted in docs/derivations/10-error-bounds.md. Most of it is the error of the
/// control maps. Exact scalars have no error.
template <class S>
inline constexpr double error_unit = 0;
template <>
inline constexpr double error_unit<double> = 160 * algebra::unit_roundoff<double>;
template <>
inline constexpr double error_unit<algebra::DoubleDouble> = 1024 * algebra::unit_roundoff<algebra::DoubleDouble>;

/// The relative error of a coefficient under one motion.
template <class S>
double relative_error(const ErrorScale& scale) {
    return std::is_same_v<S, double> ? error_unit<S> : error_unit<S> * scale.half_angle_secant;
}

/// The error of a position, in the length unit: rounding, and the distance to the true motion.
template <class S>
S position_error(const ErrorScale& scale) {
    return S(relative_error<S>(scale) * scale.length + scale.deviation);
}

/// The share of it that is rounding.
template <class S>
S rounding_error(const ErrorScale& scale) {
    return S(relative_error<S>(scale) * scale.length);
}

/// The length of a vector across an axis, rounded outward. Only a vector that is nearly along the axis needs more than
/// double.
template <class S>
double length_across(const algebra::Vector3<S>& vector, const algebra::Vector3<algebra::DoubleDouble>& axis) {
    constexpr double rounding = 0x1p-46, nearly_along = 0x1p-36, refined_rounding = 0x1p-94;
    const auto across = [](const auto& v, const auto& e) { return v - algebra::scale(e, dot(v, e)); };
    const auto v = algebra::cast<double>(vector);
    const double size = norm1(v);
    const double found = length(across(v, algebra::cast<double>(axis)));
    if (std::is_same_v<S, double> || found > nearly_along * size)
        return found + rounding * size;
    const auto refined = across(algebra::cast<algebra::DoubleDouble>(vector), axis);
    return (1 + rounding) * length(algebra::cast<double>(refined)) + refined_rounding * size;
}

/// By how much the product of a position and a vector differs from the true one, without rounding. Source:
/// docs/derivations/36-heights.md, "Heights".
template <class S>
S height_deviation(const ErrorScale& scale, const algebra::Vector3<S>& vector) {
    if constexpr (error_unit<S> == 0) {
        return S(0);
    } else {
        if (scale.deviation == 0)
            return S(0);
        constexpr double rounding = 0x1p-46;
        const double along = dot(algebra::cast<double>(vector), algebra::cast<double>(scale.axis));
        const double across = length_across(vector, scale.axis);
        return S((1 + rounding) * (std::abs(along) * scale.axis_deviation + across * scale.deviation));
    }
}

/// The error of the product of a position and a vector, whose largest terms are `size` times a length.
template <class S>
S height_error(const ErrorScale& scale, const algebra::Vector3<S>& vector, const S& size) {
    return S(rounding_error<S>(scale) * size + height_deviation<S>(scale, vector));
}

/// The same bounds for positions and vectors in the frame of the moving body.
template <class S>
ErrorScale in_moving_frame(ErrorScale scale, const motion::ControlMaps<S>& maps) {
    if constexpr (error_unit<S> > 0) {
        if (scale.deviation == 0)
            return scale;
        const algebra::Vector3<S> axis = algebra::cast<S>(scale.axis);
        algebra::Vector3<S> seen;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                seen[i] = seen[i] + maps.rotation.row[j][i][0] * axis[j] / maps.weight[0];
        scale.axis = algebra::cast<algebra::DoubleDouble>(seen);
    }
    return scale;
}

/// The error of a rotated unit direction, likewise.
template <class S>
S direction_error(const ErrorScale& scale) {
    return S(relative_error<S>(scale) * scale.norm_bound + scale.turn_deviation);
}

/// The greatest error by underflow. It is far below any other bound for bodies of size 1e-30 with features of 1e-46. It
/// invalidates the signs of numbers that lost digits to underflow, also where subnormal numbers are flushed to zero.
inline constexpr double underflow = 0x1p-760;

/// The error bound of a coefficient over the weight: the relative part and underflow.
template <class S>
S with_underflow(const S& relative_part) {
    return error_unit<S> > 0 ? S(relative_part + S(underflow)) : relative_part;
}

/// Norms of one coefficient of the control maps, over its weight.
struct CoefficientNorms {
    double rotation = 0; ///< the greater of the maximal row sum and the maximal column sum
    double translation = 0;
    double inverse_translation = 0;
    double moment = 0;
};

/// The norms of coefficient `lane`. All but the rotation are maximum norms.
inline CoefficientNorms coefficient_norms(const motion::ControlMaps<double>& maps, int lane) {
    const double weight = maps.weight[lane];
    double rows = 0, columns = 0, translation = 0, inverse = 0, moment = 0;
    for (int i = 0; i < 3; ++i) {
        double row = 0, column = 0;
        for (int j = 0; j < 3; ++j) {
            row += std::abs(maps.rotation.row[i][j][lane]);
            column += std::abs(maps.rotation.row[j][i][lane]);
            moment = std::max(moment, std::abs(maps.moment.row[i][j][lane]));
        }
        rows = std::max(rows, row);
        columns = std::max(columns, column);
        translation = std::max(translation, std::abs(maps.translation[i][lane]));
        inverse = std::max(inverse, std::abs(maps.inverse_translation[i][lane]));
    }
    return {std::max(rows, columns) / weight, translation / weight, inverse / weight, moment / weight};
}

/// The norms of all coefficients of control maps over [0, 1]: computed once for a piece of motion.
class MapNorms {
public:
    explicit MapNorms(const motion::ControlMaps<double>& maps) : end_weight_(maps.weight[3]) {
        for (int lane = 0; lane <= 3; ++lane)
            norms_[std::size_t(lane)] = coefficient_norms(maps, lane);
    }

    /// The scale for moving points with coordinates up to `moving_extent` in the frame of the moving body and fixed
    /// points up to `fixed_extent`, both in the length unit of the mesh.
    [[nodiscard]] ErrorScale error_scale(double moving_extent, double fixed_extent) const {
        ErrorScale scale;
        scale.half_angle_secant = std::sqrt(std::max(1.0, end_weight_));
        for (const CoefficientNorms& norms : norms_) {
            scale.norm_bound = std::max(scale.norm_bound, norms.rotation);
            scale.length = std::max({scale.length, norms.rotation * moving_extent + norms.translation + fixed_extent,
                                     norms.rotation * fixed_extent + norms.inverse_translation + moving_extent,
                                     norms.rotation * (moving_extent + fixed_extent) + norms.moment});
        }
        return scale;
    }

private:
    double end_weight_;
    std::array<CoefficientNorms, 4> norms_;
};

/// The scale of one set of maps.
inline ErrorScale error_scale(const motion::ControlMaps<double>& maps, double moving_extent, double fixed_extent) {
    return MapNorms(maps).error_scale(moving_extent, fixed_extent);
}

} // namespace chasles::elementary
