// A binary tree of axis-aligned boxes over the faces of a body, in the body's own frame.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// A box in double precision, in the body's frame.
struct Box {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
};

/// One node of 32 bytes. The box is relative to BoxHierarchy::centre() and rounded outward to single precision.
struct BoxNode {
    std::array<float, 3> lower;
    std::array<float, 3> upper;
    std::uint32_t first; ///< leaf: the face; otherwise the left child, with the right one behind it
    std::uint32_t faces; ///< number of faces below; 1 for a leaf

    [[nodiscard]] bool is_leaf() const { return faces == 1; }
};

/// Built once by a binned surface-area heuristic. Node 0 is the root; there are 2 n - 1 nodes for n faces, one face
/// a leaf. Every box encloses the boxes of its children and all vertices of its faces.
class BoxHierarchy {
public:
    /// No node lies deeper below the root, whatever the boxes: a stack of this size suffices.
    static constexpr std::size_t max_depth = 96;

    BoxHierarchy() = default;

    /// From the boxes of the faces (n of them, at least one).
    explicit BoxHierarchy(std::span<const Box> faces);

    [[nodiscard]] std::span<const BoxNode> nodes() const { return nodes_; }

    /// The point of the body's frame that the boxes are relative to: the middle of the whole body, so that single
    /// precision is spent on the body and not on its distance from the origin.
    [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }

    [[nodiscard]] std::size_t memory() const { return nodes_.capacity() * sizeof(BoxNode); }

private:
    std::vector<BoxNode> nodes_;
    Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
};

} // namespace chasles
