// The faces of one body in coordinates that a helical motion leaves as they are: the distance from the axis, and the
// height less pitch times turn. Source: docs/derivations/32-orbits.md.
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/orbit.h"

#include <array>
#include <span>
#include <vector>

namespace chasles::memory {

/// A place in orbit coordinates, both in the length unit.
struct OrbitPoint {
    double radius = 0; ///< distance from the axis
    double rise = 0;   ///< height along the axis, less pitch times turn
};

/// A node: what is below it lies within the hull of its corners, widened by its slacks.
struct OrbitNode {
    double first_turn = 0; ///< around the axis, in radians; the last one may be above pi
    double last_turn = 0;
    double nearest = 0;            ///< at most the least distance from the axis
    OrbitPoint lower, upper;       ///< the box of the hull, slacks included
    double inward = 0;             ///< slack of radii towards the axis
    double rising = 0;             ///< slack of rises, up and down
    double around = 0;             ///< slack in every direction
    std::uint32_t first = 0;       ///< leaf: the leaf's index in the body's hierarchy; otherwise the left child
    std::uint32_t corner = 0;      ///< the first one
    std::uint8_t corner_count = 0; ///< counter-clockwise
    bool is_leaf = false;
};

/// A binary tree over all faces of a body. Node 0 is the root; the right child follows the left one.
class OrbitTree {
public:
    static constexpr std::size_t most_corners = 12; ///< of a node

    OrbitTree(const Body& body, const motion::AxisFrame& axis, double pitch);

    [[nodiscard]] std::span<const OrbitNode> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const OrbitPoint> corners(const OrbitNode& node) const {
        return std::span(corners_).subspan(node.corner, node.corner_count);
    }

private:
    class Builder;
    std::vector<OrbitNode> nodes_;
    std::vector<OrbitPoint> corners_;
};

} // namespace chasles::memory
