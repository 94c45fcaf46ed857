// Builds a BVH: rounds the vertices outward to single precision and divides the boxes of the faces from the root down.
// Large bodies are divided into groups first, and threads build the subtrees of the groups.
#include "chasles/hierarchy/bvh.h"

#include "chasles/base/parallel_for.h"
#include "chasles/hierarchy/group_faces.h"
#include "chasles/hierarchy/patch_slabs.h"
#include "chasles/hierarchy/split_boxes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <limits>
#include <ranges>

namespace chasles {
namespace {

/// The exact a - b minus `difference`, its rounded value (D. Knuth, "The Art of Computer Programming", 4.2.2).
double rounding_error(double a, double b, double difference) {
    const double b_used = a - difference;
    const double a_used = difference + b_used;
    return (a - a_used) + (b_used - b);
}

/// The next smaller float of a finite float. Floats of one sign have the order of their bits.
float next_below(float value) {
    const auto bits = std::bit_cast<std::int32_t>(value == 0 ? -0.0F : value);
    return std::bit_cast<float>(bits < 0 ? bits + 1 : bits - 1);
}

/// The greatest float <= a - b. The comparison is exact.
float difference_below(double a, double b) {
    const double difference = a - b;
    const auto nearest = static_cast<float>(difference);
    const bool is_above = nearest > difference || (nearest == difference && rounding_error(a, b, difference) < 0.0);
    return is_above ? next_below(nearest) : nearest;
}

/// The least float >= a - b. The comparison is exact.
float difference_above(double a, double b) {
    return -difference_below(b, a);
}

/// The number of vertices or corners in one chunk of work.
constexpr std::size_t many_vertices = 1U << 15U;

/// The bounding box of all vertices that are corners of faces.
Eigen::AlignedBox3d extent_of(std::span<const std::uint32_t> corners, std::span<const Eigen::Vector3d> vertices,
                              unsigned threads) {
    std::vector<Eigen::AlignedBox3d> parts(corners.size() / many_vertices + 1);
    parallel_chunks(threads, corners.size(), many_vertices, [&](std::size_t index, std::size_t begin, std::size_t end) {
        Eigen::AlignedBox3d part;
        for (const std::uint32_t corner : corners.subspan(begin, end - begin))
            part.extend(vertices[corner]);
        parts[index] = part;
    });
    Eigen::AlignedBox3d whole;
    for (const Eigen::AlignedBox3d& part : parts)
        whole.extend(part);
    return whole;
}

/// The box of one vertex relative to `centre`, rounded outward.
PackedBox round_outward(const Eigen::Vector3d& vertex, const Eigen::Vector3d& centre) {
    PackedBox box{Eigen::Array4f::Zero(), Eigen::Array4f::Zero()};
    for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = difference_below(vertex[axis], centre[axis]);
        box.upper[axis] = difference_above(vertex[axis], centre[axis]);
    }
    return box;
}

/// The boxes of all vertices relative to `centre`, rounded outward.
std::vector<PackedBox> round_outward(std::span<const Eigen::Vector3d> vertices, const Eigen::Vector3d& centre,
                                     unsigned threads) {
    std::vector<PackedBox> rounded(vertices.size());
    parallel_chunks(threads, vertices.size(), many_vertices, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            rounded[i] = round_outward(vertices[i], centre);
    });
    return rounded;
}

/// A subtree of `count` faces with its root at `node`. Its other nodes begin at `below`.
struct Subtree {
    std::size_t begin; ///< index of its first box among the boxes of the group
    std::size_t count;
    std::size_t node;
    std::size_t below;
    std::size_t depth;

    /// The two children are at `below`. The 2 first - 2 nodes below the left child follow, then the nodes below the
    /// right child.
    [[nodiscard]] Subtree left(std::size_t first) const { return {begin, first, below, below + 2, depth + 1}; }
    [[nodiscard]] Subtree right(std::size_t first) const {
        return {begin + first, count - first, below + 1, below + 2 * first, depth + 1};
    }
};

/// Sets the box of a node.
void set_box(BvhNode& node, const PackedBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.lower[axis] = box.lower[static_cast<Eigen::Index>(axis)];
        node.upper[axis] = box.upper[static_cast<Eigen::Index>(axis)];
    }
}

/// Sets the box of a node to the box around both children.
void set_box(BvhNode& node, const BvhNode& left, const BvhNode& right) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.lower[axis] = std::min(left.lower[axis], right.lower[axis]);
        node.upper[axis] = std::max(left.upper[axis], right.upper[axis]);
    }
}

/// Sets the face of a leaf or the left child of an inner node, in 30 bits.
void set_first(BvhNode& node, std::size_t face_or_child) {
    node.bare = 0;
    node.first = static_cast<std::uint32_t>(face_or_child) & 0x3fffffffU;
}

/// Builds the subtrees of groups, one after another. It reuses its memory.
class GroupBuilder {
public:
    GroupBuilder(const RoundedFaces& faces, float size, std::span<BvhNode> nodes)
        : faces_(faces), slabs_(faces, size), nodes_(nodes) {}

    /// Builds the subtree of a group of faces.
    void build(const Subtree& subtree, std::span<const std::uint32_t> group) {
        boxes_.clear();
        boxes_.reserve(group.size());
        GroupBounds bounds;
        for (const std::uint32_t face : group) {
            boxes_.push_back(faces_.box(face));
            bounds.extend(boxes_.back());
        }
        build(subtree, bounds);
    }

private:
    /// Divides boxes down to patches. Slabs exist only within patches.
    void build(const Subtree& subtree, const GroupBounds& bounds) {
        if (subtree.count <= PatchSlabs::largest_patch) {
            build_patch(subtree, bounds);
            slabs_.add(nodes_, subtree.node, boxes_of(subtree));
            return;
        }
        const Division division = divide(subtree, bounds);
        build(subtree.left(division.first), division.bounds[0]);
        build(subtree.right(division.first), division.bounds[1]);
    }

    /// Divides the boxes of a patch down to single faces.
    void build_patch(const Subtree& subtree, const GroupBounds& bounds) {
        if (subtree.count == 1) {
            BvhNode& leaf = nodes_[subtree.node];
            set_box(leaf, bounds.boxes);
            leaf.leaf = 1;
            set_first(leaf, boxes_[subtree.begin].face());
            return;
        }
        const Division division = divide(subtree, bounds);
        build_patch(subtree.left(division.first), division.bounds[0]);
        build_patch(subtree.right(division.first), division.bounds[1]);
    }

    /// Makes an inner node and divides its boxes.
    Division divide(const Subtree& subtree, const GroupBounds& bounds) {
        BvhNode& node = nodes_[subtree.node];
        set_box(node, bounds.boxes);
        node.leaf = 0;
        set_first(node, subtree.below);
        // Without this limit, uneven divisions could make the tree as deep as its number of faces.
        const bool may_be_uneven = subtree.depth < Bvh::max_depth - 32;
        const std::span<PackedBox> boxes = boxes_of(subtree);
        return may_be_uneven ? chasles::divide(boxes, bounds) : halve(boxes);
    }

    /// The boxes of a subtree.
    std::span<PackedBox> boxes_of(const Subtree& subtree) {
        return std::span(boxes_).subspan(subtree.begin, subtree.count);
    }

    RoundedFaces faces_;
    PatchSlabs slabs_;
    std::span<BvhNode> nodes_;
    std::vector<PackedBox> boxes_;
};

/// The nodes above the groups, and the subtree of each group.
class GroupPlaces {
public:
    GroupPlaces(const FaceGroups& groups, std::span<BvhNode> nodes)
        : groups_(groups), nodes_(nodes), subtrees_(groups.planes.group_count()) {
        place(groups.planes.root(), {0, groups.faces.items.size(), 0, 1, 0});
    }

    [[nodiscard]] const Subtree& operator[](std::size_t group) const { return subtrees_[group]; }

    /// Sets the boxes of the nodes above the groups. Call it after all groups are built.
    void enclose_groups() {
        for (const Subtree& subtree : std::views::reverse(above_)) { // children come after their parents
            BvhNode& node = nodes_[subtree.node];
            set_box(node, nodes_[subtree.below], nodes_[subtree.below + 1]);
            node.leaf = 0;
            set_first(node, subtree.below);
        }
    }

private:
    /// Assigns node indices from the root down. Counts of faces determine all indices, independently of threads.
    void place(PlaneTree::Place place_in_planes, const Subtree& subtree) {
        const PlaneTree& planes = groups_.planes;
        if (PlaneTree::is_group(place_in_planes)) {
            Subtree& group = subtrees_[planes.first_group(place_in_planes)];
            group = subtree;
            group.begin = 0;
            return;
        }
        above_.push_back(subtree);
        const auto [left, right] = planes.node(place_in_planes).parts;
        const std::size_t first = groups_.faces.offsets[planes.first_group(right)] - subtree.begin;
        place(left, subtree.left(first));
        place(right, subtree.right(first));
    }

    const FaceGroups& groups_;
    std::span<BvhNode> nodes_;
    std::vector<Subtree> subtrees_; ///< of the groups
    std::vector<Subtree> above_;    ///< parents come first
};

/// Builds all nodes. Threads build different groups; the nodes above the groups follow at the end.
void build_tree(const RoundedFaces& faces, float size, unsigned threads, std::span<BvhNode> nodes) {
    const FaceGroups groups = group_faces(faces, threads);
    GroupPlaces places(groups, nodes);
    parallel_for(threads, groups.faces.size(), [&](std::size_t begin, std::size_t end) {
        GroupBuilder builder(faces, size, nodes);
        for (std::size_t group = begin; group < end; ++group)
            builder.build(places[group], groups.faces[group]);
    });
    places.enclose_groups();
}

/// The radius of a ball around the centre of the hierarchy that encloses the root's box.
double radius_of(const BvhNode& root) {
    Eigen::Vector3d extent;
    for (int i = 0; i < 3; ++i)
        extent[i] = std::max(std::abs(double(root.lower[i])), std::abs(double(root.upper[i])));
    return extent.norm() * (1 + 1e-14);
}

} // namespace

Bvh::Bvh(const FlatLists<std::uint32_t>& outlines, std::span<const Eigen::Vector3d> vertices, unsigned threads) {
    // Small bodies are built faster than other threads wake.
    if (outlines.size() < fewest_to_group)
        threads = 1;
    const Eigen::AlignedBox3d extent = extent_of(outlines.items, vertices, threads);
    centre_ = 0.5 * extent.min() + 0.5 * extent.max();
    const std::vector<PackedBox> rounded = round_outward(vertices, centre_, threads);
    // The size must be positive and representable, because normals are divided by it.
    const auto size = std::max(static_cast<float>(extent.sizes().maxCoeff()), std::numeric_limits<float>::min());
    nodes_.resize(2 * outlines.size() - 1);
    build_tree({outlines, rounded}, size, threads, nodes_);
    radius_ = radius_of(nodes().front());
}

} // namespace chasles
