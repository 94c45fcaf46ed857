// Rounds the boxes of the faces outward to single precision and divides them from the root down, without recursion.
#include "chasles/mesh/box_hierarchy.h"

#include "chasles/mesh/split_boxes.h"

#include <Eigen/Geometry>
#include <algorithm>
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

/// Nodes of more faces have their box for a slab: hardly a surface is flat over so many. That changes the pairs of
/// nodes in the cases of peers_bench by a few per cent, and halves the work for bodies of a million faces.
constexpr std::uint32_t largest_patch = 1024;

/// Faces side by side in the order of the leaves.
struct FaceRange {
    std::uint32_t begin;
    std::uint32_t count;
};

/// The corners of all faces in the order of the leaves, relative to the middle of the body and in single precision.
class FaceCorners {
public:
    FaceCorners(std::span<const std::uint32_t> faces, const FlatLists<std::uint32_t>& outlines,
                std::span<const Eigen::Vector3d> vertices, const Eigen::Vector3d& centre, float size)
        : unit_(1 / size) {
        begin_.reserve(faces.size() + 1);
        points_.reserve(outlines.items.size());
        for (const std::uint32_t face : faces) {
            begin_.push_back(points_.size());
            for (const std::uint32_t vertex : outlines[face])
                points_.push_back((vertices[vertex] - centre).cast<float>());
        }
        begin_.push_back(points_.size());
    }

    [[nodiscard]] std::span<const Eigen::Vector3f> of(const FaceRange& faces) const {
        return std::span(points_).subspan(begin_[faces.begin], begin_[faces.begin + faces.count] - begin_[faces.begin]);
    }

    /// Of the face at a place, as long as twice its area in terms of the body's size.
    [[nodiscard]] Eigen::Vector3f normal(std::uint32_t place) const {
        const std::span<const Eigen::Vector3f> corners = of({place, 1});
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            sum += (unit_ * (corners[i] - corners[0])).cross(unit_ * (corners[i + 1] - corners[0]));
        return sum;
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<Eigen::Vector3f> points_;
    float unit_;
};

/// The two sides of a thin plate do not cancel.
Eigen::Vector3f aligned_sum(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return a.dot(b) < 0 ? Eigen::Vector3f(a - b) : Eigen::Vector3f(a + b);
}

void add_slab(BoxNode& node, std::span<const Eigen::Vector3f> corners, const Eigen::Vector3f& along) {
    node.slab = PackedSlab(along);
    const Eigen::Vector3f normal = node.slab.normal();
    float lower = std::numeric_limits<float>::infinity();
    float upper = -lower;
    for (const Eigen::Vector3f& corner : corners) {
        const float height = normal.dot(corner);
        lower = std::min(lower, height);
        upper = std::max(upper, height);
    }
    const BoxMiddle box = middle_of(node);
    const float middle = normal.dot(box.centre);
    node.slab.set_heights(lower - middle, upper - middle, box.half);
}

class TreeBuilder {
public:
    TreeBuilder(std::vector<PackedBox> boxes) : boxes_(std::move(boxes)), faces_(boxes_.size()) {
        for (std::uint32_t face = 0; face < faces_.size(); ++face)
            faces_[face] = face;
        nodes_.resize(2 * boxes_.size() - 1);
        ranges_.resize(nodes_.size());
    }

    /// Once, and first.
    void divide_all() {
        std::vector<Subtree> waiting{{0, boxes_.size(), 0, 1, 0}};
        while (!waiting.empty()) {
            const Subtree subtree = waiting.back();
            waiting.pop_back();
            const GroupBounds bounds(group_of(subtree).boxes);
            set_node(subtree, bounds.boxes);
            if (subtree.count > 1)
                divide(subtree, bounds, waiting);
        }
    }

    std::vector<BoxNode> nodes() && { return std::move(nodes_); }

    /// Slabs around all corners of a node's faces, along what their normals add up to.
    void add_slabs(const FlatLists<std::uint32_t>& outlines, std::span<const Eigen::Vector3d> vertices,
                   const Eigen::Vector3d& centre) {
        const float size = std::max(middle_of(nodes_[0]).half.maxCoeff(), std::numeric_limits<float>::min());
        const FaceCorners corners(faces_, outlines, vertices, centre, size);
        std::vector<Eigen::Vector3f> normals(nodes_.size());
        for (std::size_t node = nodes_.size(); node-- > 0;) { // children come behind their parents
            const BoxNode& made = nodes_[node];
            normals[node] = made.is_leaf() ? corners.normal(ranges_[node].begin)
                                           : aligned_sum(normals[made.first], normals[made.first + 1]);
            if (ranges_[node].count <= largest_patch)
                add_slab(nodes_[node], corners.of(ranges_[node]), normals[node]);
        }
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
        node.leaf = subtree.count == 1 ? 1 : 0;
        node.first = (node.is_leaf() ? faces_[subtree.begin] : static_cast<std::uint32_t>(subtree.below)) & 0x7fffffffU;
        ranges_[subtree.node] = {static_cast<std::uint32_t>(subtree.begin), static_cast<std::uint32_t>(subtree.count)};
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
    std::vector<FaceRange> ranges_;
};

std::vector<Box> boxes_of(const FlatLists<std::uint32_t>& outlines, std::span<const Eigen::Vector3d> vertices) {
    std::vector<Box> boxes(outlines.size());
    for (std::size_t face = 0; face < boxes.size(); ++face) {
        const std::span<const std::uint32_t> outline = outlines[face];
        Box box{vertices[outline.front()], vertices[outline.front()]};
        for (const std::uint32_t vertex : outline.subspan(1)) {
            box.lower = box.lower.cwiseMin(vertices[vertex]);
            box.upper = box.upper.cwiseMax(vertices[vertex]);
        }
        boxes[face] = box;
    }
    return boxes;
}

} // namespace

BoxHierarchy::BoxHierarchy(std::span<const Box> faces) : centre_(middle_of(faces)) {
    TreeBuilder builder(pack(faces, centre_));
    builder.divide_all();
    nodes_ = std::move(builder).nodes();
}

BoxHierarchy::BoxHierarchy(const FlatLists<std::uint32_t>& outlines, std::span<const Eigen::Vector3d> vertices) {
    const std::vector<Box> boxes = boxes_of(outlines, vertices);
    centre_ = middle_of(boxes);
    TreeBuilder builder(pack(boxes, centre_));
    builder.divide_all();
    builder.add_slabs(outlines, vertices, centre_);
    nodes_ = std::move(builder).nodes();
}

} // namespace chasles
