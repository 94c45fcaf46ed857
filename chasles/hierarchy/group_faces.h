// Sorts the faces of a large body into groups of some thousand faces. One group fits a cache, and threads can build the
// subtrees of different groups at the same time.
#pragma once

#include "chasles/hierarchy/rounded_faces.h"
#include "chasles/hierarchy/split_boxes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// Bodies with fewer faces are one group. They fit a cache, and waking other threads would cost more time than it
/// saves.
inline constexpr std::size_t fewest_to_group = 1U << 15U;

/// A binary tree of planes. Its leaves are groups, numbered from left to right.
class PlaneTree {
public:
    /// A place in the tree: a node, or a group if `group_bit` is set.
    using Place = std::uint32_t;
    static constexpr Place group_bit = 0x80000000;

    struct Node {
        Plane plane;
        std::array<Place, 2> parts; ///< the part that the plane puts first, and the rest
    };

    /// Divides a sample of the boxes until each part is small. The sample may be empty. Every group contains a part of
    /// a non-empty sample.
    explicit PlaneTree(std::vector<PackedBox> sample);

    [[nodiscard]] std::size_t group_count() const { return group_count_; }
    [[nodiscard]] Place root() const { return root_; }
    [[nodiscard]] const Node& node(Place place) const { return nodes_[place]; }
    [[nodiscard]] static bool is_group(Place place) { return (place & group_bit) != 0; }

    /// The group of a box.
    [[nodiscard]] std::uint32_t group_of(const PackedBox& box) const {
        Place place = root_;
        while (!is_group(place)) {
            // A branch is faster than a select: it is well predicted, because adjacent faces take the same branches.
            if (nodes_[place].plane.puts_first(box)) [[likely]]
                place = nodes_[place].parts[0];
            else
                place = nodes_[place].parts[1];
        }
        return place & ~group_bit;
    }

    /// The leftmost group at or below a place.
    [[nodiscard]] std::uint32_t first_group(Place place) const {
        while (!is_group(place))
            place = nodes_[place].parts[0];
        return place & ~group_bit;
    }

private:
    Place grow(std::span<PackedBox> sample, const GroupBounds& bounds, std::size_t depth);

    std::vector<Node> nodes_;
    std::uint32_t group_count_ = 0;
    Place root_;
};

/// All faces of a body, sorted into groups.
struct FaceGroups {
    PlaneTree planes;
    FlatLists<std::uint32_t> faces; ///< the faces of each group, in ascending order
};

/// Sorts the faces on at most `threads` threads (0: all cores). The result does not depend on the number of threads.
[[nodiscard]] FaceGroups group_faces(const RoundedFaces& faces, unsigned threads);

} // namespace chasles
