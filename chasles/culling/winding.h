// How often does a solid body wind around a point? By the faces that a ray from the point crosses.
// Source: docs/derivations/37-inside.md.
#pragma once

#include "chasles/algebra/vector.h"
#include "chasles/mesh/body.h"

#include <optional>

namespace chasles::culling {

/// A point in the frame of a body: `place` over a positive weight. No component is farther than `error` from the true
/// one.
template <class S>
struct WeightedPoint {
    algebra::Vector3<S> place;
    S weight;
    S error;
};

/// So many rays may be tried. Each has another direction, none of them along an axis.
inline constexpr int ray_count = 4;

/// The winding number of the faces around the volume of a body, 1 for the inside of a closed surface with its normals
/// outward. Empty where the ray passes too near a rim of a face, or the point too near a face: another ray may tell.
/// `near` is the point in double, within `slack`.
template <class S>
std::optional<int> winding_around(const Body& body, const WeightedPoint<S>& point, const Eigen::Vector3d& near,
                                  double slack, int ray);

/// Whether the point is in the volume of the body, by the first ray that tells. Empty next to the surface.
template <class S>
std::optional<bool> is_inside(const Body& body, const WeightedPoint<S>& point, const Eigen::Vector3d& near,
                              double slack) {
    for (int ray = 0; ray < ray_count; ++ray)
        if (const std::optional<int> winding = winding_around(body, point, near, slack, ray))
            return *winding > 0;
    return std::nullopt;
}

} // namespace chasles::culling
