// Source: docs/derivations/23-coarse-motion.md, "When the test gives up".
#include "chasles/culling/near_nodes.h"

#include <algorithm>

namespace chasles::culling {

namespace {

/// Bodies count as near within this part of the size of the smaller body. Measured with clear_bench and peers_bench.
constexpr double near_distance = 0.28;

/// A descent through one hierarchy.
class Descent {
public:
    Descent(std::span<const BvhNode> nodes, double least_side) : nodes_(nodes), least_side_(least_side) { visit(0); }

    [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; } ///< in the frame of the hierarchy
    [[nodiscard]] double side() const { return side_; }
    [[nodiscard]] bool is_over() const { return nodes_[node_].is_leaf() || side_ < least_side_; }

    /// Goes on to the child whose centre is nearer to a point.
    void towards(const Eigen::Vector3d& point) {
        const std::uint32_t left = nodes_[node_].first;
        visit(distance(nodes_[left], point) < distance(nodes_[left + 1], point) ? left : left + 1);
    }

private:
    static Eigen::Vector3d centre_of(const BvhNode& node) { return middle_of(node).centre.cast<double>(); }
    static double distance(const BvhNode& node, const Eigen::Vector3d& point) {
        return (centre_of(node) - point).squaredNorm();
    }
    void visit(std::uint32_t node) {
        node_ = node;
        centre_ = centre_of(nodes_[node]);
        side_ = double(longest_side(nodes_[node]));
    }

    std::span<const BvhNode> nodes_;
    double least_side_;
    std::uint32_t node_ = 0;
    Eigen::Vector3d centre_;
    double side_ = 0;
};

} // namespace

bool have_near_nodes(const Bvh& moving, const Bvh& fixed, const Placement& placed, double margin) {
    const double size = std::min(size_of(moving), size_of(fixed));
    const double near = near_distance * size + margin;
    Descent a(moving.nodes(), small_side * size);
    Descent b(fixed.nodes(), small_side * size);
    Eigen::Vector3d a_in_fixed = placed.rotation * a.centre() + placed.offset;
    for (;;) {
        const double square = (a_in_fixed - b.centre()).squaredNorm();
        const double reach = a.side() + b.side() + near;
        if ((a.is_over() && b.is_over()) || square > reach * reach)
            return square < near * near;
        if (b.is_over() || (!a.is_over() && a.side() >= b.side())) {
            a.towards(placed.rotation.transpose() * (b.centre() - placed.offset));
            a_in_fixed = placed.rotation * a.centre() + placed.offset;
        } else {
            b.towards(a_in_fixed);
        }
    }
}

} // namespace chasles::culling
