// A bounding volume hierarchy (BVH) over the faces of a body, in the body's frame: boxes and slabs.
// Every box and slab encloses its faces; the result does not depend on the number of threads.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/hierarchy/slab.h"

#include <Eigen/Core>
#include <algorithm>
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
    std::uint32_t first : 30; ///< leaf: the face; otherwise the left child, followed by the right child
    std::uint32_t bare : 1;   ///< no face below the node owns a feature
    std::uint32_t leaf : 1;
    PackedSlab slab; ///< encloses the vertices of the faces below the node

    [[nodiscard]] bool is_leaf() const { return leaf != 0; }
    [[nodiscard]] bool is_bare() const { return bare != 0; }
};

/// The centre and half the sides of a node's box, in single precision.
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

/// The longest side of a node's box.
inline float longest_side(const BvhNode& node) {
    return std::max({node.upper[0] - node.lower[0], node.upper[1] - node.lower[1], node.upper[2] - node.lower[2]});
}

/// A BVH, built once by a binned surface area heuristic. Node 0 is the root. There are 2 n - 1 nodes for n faces, with
/// one face per leaf. Every box encloses the boxes of its children and all vertices of its faces.
class Bvh {
public:
    /// The greatest depth of a node below the root, for any boxes. A stack of this size suffices for a traversal.
    static constexpr std::size_t max_depth = 96;

    Bvh() = default;

    /// Builds the tree over faces given by their outlines (lists of vertices; at least one face) on at most `threads`
    /// threads (0: all cores). The result does not depend on the number of threads.
    Bvh(const FlatLists<std::uint32_t>& outlines, std::span<const Eigen::Vector3d> vertices, unsigned threads = 1);

    /// Marks the nodes of faces without features. `is_bare(face)` tells them.
    template <class IsBare>
    void mark_bare(IsBare is_bare) {
        for (std::size_t i = nodes_.size(); i-- > 0;) { // children follow their parent
            BvhNode& node = nodes_[i];
            const bool bare = node.is_leaf() ? is_bare(std::uint32_t(node.first))
                                             : nodes_[node.first].is_bare() && nodes_[node.first + 1].is_bare();
            node.bare = bare ? 1 : 0;
        }
    }

    [[nodiscard]] std::span<const BvhNode> nodes() const { return nodes_; }

    /// The point of the body's frame that the boxes are relative to: the centre of the body's bounding box. Single
    /// precision then represents the body and not its distance from the origin.
    [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }

    /// The radius of a ball around centre() that encloses the body.
    [[nodiscard]] double radius() const { return radius_; }

    /// Bytes held.
    [[nodiscard]] std::size_t memory() const { return nodes_.capacity() * sizeof(BvhNode); }

private:
    std::vector<BvhNode> nodes_;
    Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
    double radius_ = 0;
};

} // namespace chasles
