// Rounds the boxes of the faces outward to single precision and divides them from the root down, without recursion.
#include "chasles/mesh/box_hierarchy.h"

#include "chasles/mesh/split_boxes.h"

#include <cmath>
#include <limits>

namespace chasles {
namespace {

/// What is left of a - b when `difference` is the rounded value (D. Knuth, "The Art of Computer Programming", 4.2.2).
double lost(double a, double b, double difference) {
    const double b_used = a - difference;
    const double a_used = difference + b_used;
    return (a - a_used) + (b_used - b);
}

/// The greatest float that is at most a - b; exactly so, not up to rounding.
float difference_below(double a, double b) {
    const double difference = a - b;
    const auto nearest = static_cast<float>(difference);
    const bool is_above = nearest > difference || (nearest == difference && lost(a, b, difference) < 0.0);
    return is_above ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}

/// The smallest float that is at least a - b.
float difference_above(double a, double b) {
    return -difference_below(b, a);
}

Eigen::Vector3d middle_of(std::span<const Box> boxes) {
    Eigen::Vector3d lower = boxes.front().lower;
    Eigen::Vector3d upper = boxes.front().upper;
    for (const Box& box : boxes) {
        lower = lower.cwiseMin(box.lower);
        upper = upper.cwiseMax(box.upper);
    }
    return 0.5 * lower + 0.5 * upper;
}

std::vector<PackedBox> pack(std::span<const Box> boxes, const Eigen::Vector3d& centre) {
    std::vector<PackedBox> packed(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (int axis = 0; axis < 4; ++axis) {
            const bool is_used = axis < 3;
            packed[i].lower[axis] = is_used ? difference_below(boxes[i].lower[axis], centre[axis]) : 0.0F;
            packed[i].upper[axis] = is_used ? difference_above(boxes[i].upper[axis], centre[axis]) : 0.0F;
        }
    return packed;
}

/// The boxes [begin, begin + count) are to become the subtree at `node`, whose other nodes begin at `below`.
struct Subtree {
    std::size_t begin;
    std::size_t count;
    std::size_t node;
    std::size_t below;
    std::size_t depth;
};

class TreeBuilder {
public:
    TreeBuilder(std::vector<PackedBox> boxes) : boxes_(std::move(boxes)), faces_(boxes_.size()) {
        for (std::uint32_t face = 0; face < faces_.size(); ++face)
            faces_[face] = face;
        nodes_.resize(2 * boxes_.size() - 1);
    }

    std::vector<BoxNode> run() && {
        std::vector<Subtree> waiting{{0, boxes_.size(), 0, 1, 0}};
        while (!waiting.empty()) {
            const Subtree subtree = waiting.back();
            waiting.pop_back();
            const GroupBounds bounds(group_of(subtree).boxes);
            set_node(subtree, bounds.boxes);
            if (subtree.count > 1)
                divide(subtree, bounds, waiting);
        }
        return std::move(nodes_);
    }

private:
    [[nodiscard]] BoxGroup group_of(const Subtree& subtree) {
        return BoxGroup{boxes_, faces_}.part(subtree.begin, subtree.count);
    }

    void set_node(const Subtree& subtree, const PackedBox& box) {
        BoxNode& node = nodes_[subtree.node];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.lower[axis] = box.lower[static_cast<Eigen::Index>(axis)];
            node.upper[axis] = box.upper[static_cast<Eigen::Index>(axis)];
        }
        node.faces = static_cast<std::uint32_t>(subtree.count);
        node.first = subtree.count == 1 ? faces_[subtree.begin] : static_cast<std::uint32_t>(subtree.below);
    }

    void divide(const Subtree& subtree, const GroupBounds& bounds, std::vector<Subtree>& waiting) {
        // Uneven divisions in a row could make the tree as deep as it has faces.
        const bool may_be_uneven = subtree.depth < BoxHierarchy::max_depth - 32;
        const std::size_t first = may_be_uneven ? split_boxes(group_of(subtree), bounds) : subtree.count / 2;
        // Two nodes for the children, then all 2 first - 2 nodes below the left one, then those below the right one.
        const std::size_t left = subtree.below;
        waiting.push_back(
            {subtree.begin + first, subtree.count - first, left + 1, left + 2 * first, subtree.depth + 1});
        waiting.push_back({subtree.begin, first, left, left + 2, subtree.depth + 1});
    }

    std::vector<PackedBox> boxes_;
    std::vector<std::uint32_t> faces_;
    std::vector<BoxNode> nodes_;
};

} // namespace

BoxHierarchy::BoxHierarchy(std::span<const Box> faces) : centre_(middle_of(faces)) {
    nodes_ = TreeBuilder(pack(faces, centre_)).run();
}

} // namespace chasles
