// Gathers the corners in the order of the leaves first. The corners of each node are then contiguous.
// Then computes the slab of each node along the sum of its face normals.
#include "chasles/hierarchy/patch_slabs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace chasles {
namespace {

/// a + b or a - b, whichever is longer: the normals of the two sides of a thin plate must not cancel.
Eigen::Vector3f aligned_sum(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return a.dot(b) < 0 ? Eigen::Vector3f(a - b) : Eigen::Vector3f(a + b);
}

} // namespace

/// Gathers the corners and normals of all faces, then descends from the root.
void PatchSlabs::add(std::span<BvhNode> nodes, std::size_t root, std::span<const PackedBox> boxes) {
    corners_.clear();
    gathered_.clear();
    corners_.reserve(boxes.size());
    gathered_.reserve(boxes.size());
    for (const PackedBox& box : boxes)
        gather(box.face());
    used_ = 0;
    add_below(nodes, root);
}

/// Stores the corners of a face in groups of four, and its normal by Newell's method.
void PatchSlabs::gather(std::size_t face) {
    const std::span<const std::uint32_t> outline = faces_.outlines[face];
    const auto corner = [&](std::size_t i) -> const Eigen::Array4f& {
        return faces_.vertices[outline[std::min(i, outline.size() - 1)]].lower;
    };
    for (std::size_t i = 0; i < outline.size(); i += 4) {
        const Eigen::Array4f& a = corner(i);
        const Eigen::Array4f& b = corner(i + 1);
        const Eigen::Array4f& c = corner(i + 2);
        const Eigen::Array4f& d = corner(i + 3);
        corners_.push_back({{a[0], b[0], c[0], d[0]}, {a[1], b[1], c[1], d[1]}, {a[2], b[2], c[2], d[2]}});
    }
    const auto side = [&](std::size_t i) -> Eigen::Vector3f { return (unit_ * (corner(i) - corner(0))).head<3>(); };
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        normal += side(i).cross(side(i + 1));
    gathered_.push_back({normal, static_cast<std::uint32_t>(corners_.size())});
}

/// Sets the slabs of all nodes of a subtree. Returns the aligned sum of the face normals.
Eigen::Vector3f PatchSlabs::add_below(std::span<BvhNode> nodes, std::size_t root) {
    BvhNode& node = nodes[root];
    const std::size_t begin = used_ == 0 ? 0 : gathered_[used_ - 1].end;
    Eigen::Vector3f along;
    if (node.is_leaf()) {
        along = gathered_[used_++].normal;
    } else {
        along = add_below(nodes, node.first);
        along = aligned_sum(along, add_below(nodes, node.first + 1U));
    }
    const std::size_t end = gathered_[used_ - 1].end;
    node.slab = around(std::span(corners_).subspan(begin, end - begin), along, middle_of(node));
    return along;
}

/// Encloses the corners between two planes normal to `along`, with heights relative to the box centre.
PackedSlab PatchSlabs::around(std::span<const FourCorners> corners, const Eigen::Vector3f& along,
                              const BoxMiddle& box) const {
    PackedSlab slab(along);
    const Eigen::Vector3f normal = slab.normal();
    constexpr float infinite = std::numeric_limits<float>::infinity();
    Eigen::Array4f lower = Eigen::Array4f::Constant(infinite);
    Eigen::Array4f upper = Eigen::Array4f::Constant(-infinite);
    for (const FourCorners& four : corners) {
        const Eigen::Array4f height = normal.x() * four.x + normal.y() * four.y + normal.z() * four.z;
        lower = lower.min(height);
        upper = upper.max(height);
    }
    const float middle = normal.dot(box.centre);
    slab.set_heights(lower.minCoeff() - middle, upper.maxCoeff() - middle, box.half);
    return slab;
}

} // namespace chasles
