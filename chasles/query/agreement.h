// Whether all gradients at a minimum are one. Source: docs/derivations/41-gradients.md, "Where it is defined".
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <span>

namespace chasles::query {

/// Whether all are the first one, up to the rounding of its time and points, and that of differences of places of this
/// size.
inline bool all_agree(std::span<const Eigen::VectorXd> gradients, double lever) {
    constexpr double rounding = 0x1p-20, rounding_of_steps = 0x1p-28;
    const double noise = rounding_of_steps * std::max(1.0, lever);
    return std::ranges::all_of(gradients, [&](const Eigen::VectorXd& other) {
        const double size = std::max(gradients.front().norm(), other.norm());
        return (other - gradients.front()).norm() <= rounding * size + noise;
    });
}

} // namespace chasles::query
