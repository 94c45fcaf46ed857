// Whether all gradients at a minimum are one. Source: docs/derivations/41-gradients.md, "Where it is defined".
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <span>

namespace chasles::query {

/// Whether all are the first one, up to the rounding of its time and points.
inline bool all_agree(std::span<const Eigen::VectorXd> gradients) {
    constexpr double rounding = 0x1p-20;
    return std::ranges::all_of(gradients, [&](const Eigen::VectorXd& other) {
        const double size = std::max(gradients.front().norm(), other.norm());
        return (other - gradients.front()).norm() <= rounding * size;
    });
}

} // namespace chasles::query
