// A binary tree of axis-aligned boxes over the faces of a body, in the body's own frame.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/hierarchy/cache_line.h"
#include "chasles/hierarchy/slab.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// One node of 32 bytes. The box is relative to Bvh::centre() and rounded outward to single precision.
struct BvhNode {
    std::array<float, 3> lower;
    std::array<float, 3> upper;
    std::uint32_t first : 31; ///< leaf: the face; otherwise the left child, with the right one behind it
    std::uint32_t leaf : 1;
    PackedSlab slab; ///< around the vertices of its faces

    [[nodiscard]] bool is_leaf() const { return leaf != 0; }
};

/// The middle of a node's box and half its sides, in single precision.
struct BoxMiddle {
    Eigen::Vector3f centre;
    Eigen::Vector3f half;
};

inline BoxMiddle middle_of(const BvhNode& node) {
    BoxMiddle box;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<Eigen::Index>(i);
        box.centre[axis] = 0.5F * node.lower[i] + 0.5F * node.upper[i];
        box.half[axis] = 0.5F * node.upper[i] - 0.5F * node.lower[i];
    }
    return box;
}

/// Built once by a binned surface-area heuristic. Node 0 is the root; there are 2 n - 1 nodes for n faces, one face
/// a leaf. Every box encloses the boxes of its children and all vertices of its faces.
class Bvh {
public:
    /// No node lies deeper below the root, whatever the boxes: a stack of this size suffices.
    static constexpr std::size_t max_depth = 96;

    Bvh() = default;

    /// From the outlines of the faces (lists of vertices; at least one), on at most `threads` threads (0: all cores),
    /// which change nothing of the result.
    Bvh(const FlatLists<std::uint32_t>& outlines, std::span<const Eigen::Vector3d> vertices, unsigned threads = 1);

    [[nodiscard]] std::span<const BvhNode> nodes() const {
        return nodes_.empty() ? std::span<const BvhNode>() : std::span(nodes_).subspan(1);
    }

    /// The point of the body's frame that the boxes are relative to: the middle of the whole body, so that single
    /// precision is spent on the body and not on its distance from the origin.
    [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }

    /// Of a ball around centre() that holds the body.
    [[nodiscard]] double radius() const { return radius_; }

    [[nodiscard]] std::size_t memory() const { return nodes_.capacity() * sizeof(BvhNode); }

private:
    /// The first one is not used, so that the two children of each node are in one cache line.
    std::vector<BvhNode, CacheLineAllocator<BvhNode>> nodes_;
    Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
    double radius_ = 0;
};

} // namespace chasles
