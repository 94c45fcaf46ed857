// Sorts points along a curve that fills space, so that points which follow each other are near each other.
// Source: docs/derivations/27-scenes.md, "Pairs".
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles::scene {

/// The indices of the points in the order of Morton's curve. A few points that are next to each other may be in the
/// order of their indices.
/// Takes linear time unless places differ in size by more than a factor of a million. Any numbers are allowed.
std::vector<std::uint32_t> curve_order(std::span<const Eigen::Vector3d> points, unsigned threads);

} // namespace chasles::scene
