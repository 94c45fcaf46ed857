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
    double turn = 1;       ///< over the cosine of half a screw's turn: what its numbers in double-double lose by it
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
    return std::is_same_v<S, double> ? error_unit<S> : error_unit<S> * scale.turn;
}

/// What underflow adds at most, far below any bound of bodies of size 1e-30 with features of 1e-50. Makes signs of
/// numbers that lost digits to underflow count for nothing, also where subnormal numbers are flushed to zero.
inline constexpr double underflow = 0x1p-760;

/// The bound of a coefficient's error, over the weight.
template <class S>
S with_underflow(const S& relative_part) {
    return error_unit<S> > 0 ? S(relative_part + S(underflow)) : relative_part;
}

/// The norms of control maps over [0, 1] that error bounds are made of, each over the weight: computed once a piece.
class MapNorms {
public:
    explicit MapNorms(const motion::ControlMaps<double>& maps) : end_weight_(maps.weight[3]) {
        for (int lane = 0; lane <= 3; ++lane)
            lanes_[std::size_t(lane)] = lane_of(maps, lane);
    }

    /// The scale for moving points with coordinates up to `moving_extent` in the body's frame and fixed points up to
    /// `fixed_extent`, both in the mesh's unit.
    [[nodiscard]] ErrorScale error_scale(double moving_extent, double fixed_extent) const {
        ErrorScale scale;
        scale.turn = std::sqrt(std::max(1.0, end_weight_));
        for (const Lane& lane : lanes_) {
            scale.norm_bound = std::max(scale.norm_bound, lane.rotation);
            scale.length = std::max({scale.length, lane.rotation * moving_extent + lane.translation + fixed_extent,
                                     lane.rotation * fixed_extent + lane.inverse_translation + moving_extent,
                                     lane.rotation * (moving_extent + fixed_extent) + lane.moment});
        }
        return scale;
    }

private:
    /// Of one control point.
    struct Lane {
        double rotation = 0; ///< the largest sum of a row or column
        double translation = 0;
        double inverse_translation = 0;
        double moment = 0;
    };

    static Lane lane_of(const motion::ControlMaps<double>& maps, int lane) {
        Lane norms;
        for (int i = 0; i < 3; ++i) {
            double row = 0, column = 0;
            for (int j = 0; j < 3; ++j) {
                row += std::abs(maps.rotation.row[i][j][lane]);
                column += std::abs(maps.rotation.row[j][i][lane]);
                norms.moment = std::max(norms.moment, std::abs(maps.moment.row[i][j][lane]));
            }
            norms.rotation = std::max({norms.rotation, row, column});
            norms.translation = std::max(norms.translation, std::abs(maps.translation[i][lane]));
            norms.inverse_translation = std::max(norms.inverse_translation, std::abs(maps.inverse_translation[i][lane]));
        }
        const double weight = maps.weight[lane];
        return {norms.rotation / weight, norms.translation / weight, norms.inverse_translation / weight,
                norms.moment / weight};
    }

    double end_weight_;
    std::array<Lane, 4> lanes_;
};

/// MapNorms::error_scale for one use.
inline ErrorScale error_scale(const motion::ControlMaps<double>& maps, double moving_extent, double fixed_extent) {
    return MapNorms(maps).error_scale(moving_extent, fixed_extent);
}

} // namespace chasles::elementary
