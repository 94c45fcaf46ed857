// Source: docs/derivations/21-coarse-motion.md, "When the test gives up".
#include "chasles/culling/near_nodes.h"

#include <algorithm>

namespace chasles::culling {

namespace {

/// Bodies count as near within this part of the size of the smaller body. Measured with clear_bench and peers_bench.
constexpr double near_distance = 0.2;

/// A node of one body and the centre of its box, relative to the centre of the fixed hierarchy.
struct PlacedNode {
    std::uint32_t index;
    Eigen::Vector3d centre;
};

/// The child of a node that is nearer to a point. `place` carries points of the body's frame to the frame of the point.
template <class Place>
PlacedNode nearer_child(std::span<const BvhNode> nodes, std::uint32_t parent, const Eigen::Vector3d& point,
                        Place place) {
    const auto child = [&](std::uint32_t index) -> PlacedNode {
        return {index, place(middle_of(nodes[index]).centre.cast<double>())};
    };
    const PlacedNode left = child(nodes[parent].first);
    const PlacedNode right = child(nodes[parent].first + 1);
    return (left.centre - point).squaredNorm() < (right.centre - point).squaredNorm() ? left : right;
}

} // namespace

bool have_near_nodes(const Bvh& moving, const Bvh& fixed, const Placement& placed, double margin) {
    const double size = std::min(size_of(moving), size_of(fixed));
    const double near = near_distance * size + margin;
    const auto in_place = [](const Eigen::Vector3d& point) { return point; };
    const auto moved = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d {
        return placed.rotation * point + placed.offset;
    };
    PlacedNode a{0, moved(middle_of(moving.nodes()[0]).centre.cast<double>())};
    PlacedNode b{0, middle_of(fixed.nodes()[0]).centre.cast<double>()};
    for (;;) {
        const BvhNode& a_node = moving.nodes()[a.index];
        const BvhNode& b_node = fixed.nodes()[b.index];
        const double a_side = longest_side(a_node), b_side = longest_side(b_node);
        const bool a_ends = a_node.is_leaf() || a_side < small_side * size;
        const bool b_ends = b_node.is_leaf() || b_side < small_side * size;
        const double distance = (a.centre - b.centre).norm();
        if ((a_ends && b_ends) || distance > a_side + b_side + near)
            return distance < near;
        if (b_ends || (!a_ends && a_side >= b_side))
            a = nearer_child(moving.nodes(), a.index, b.centre, moved);
        else
            b = nearer_child(fixed.nodes(), b.index, a.centre, in_place);
    }
}

} // namespace chasles::culling
