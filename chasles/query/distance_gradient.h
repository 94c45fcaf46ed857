// How does the least distance over a motion change with its goal? Source: docs/derivations/41-gradients.md.
#pragma once

#include "chasles/query/least_distance.h"

#include <optional>

namespace chasles {

/// Of the least distance by the goal pose of the moving body.
struct [[nodiscard]] DistanceGradient {
    using Vector = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;

    /// Of the goal (R, p) in the world, the neighbours are (exp(w) R, p + v): v translates it, and the rotation vector
    /// w, in radians and in the world, turns it about the origin of the body. The entries are the derivatives by v,
    /// then by w (mesh unit per radian). Empty where the bodies touch.
    std::optional<Vector> by_goal;
    /// Whether the least distance has this gradient: one pair of points is nearest at one time, or all that are have
    /// the same gradient. False, too, where that cannot be told: where others come as near up to a part of 1e-9, where
    /// the rounding of places is more than 1e-6 of the distance, within 1e-3 radians of a half turn, and at the limit
    /// of the thread. Then `by_goal` is that of one of them.
    bool isolated = false;
};

/// The gradient of an answer. Throws InvalidInput for a motion that has no goal pose.
///
/// It is computed in double. At isolated minima its error is at most a part of 1e-5 (docs/promises.md).
CHASLES_EXPORT DistanceGradient least_distance_gradient(const LeastDistanceQuery& query, const LeastDistance& answer);

} // namespace chasles
