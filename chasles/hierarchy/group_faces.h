// Sorts the faces of a large body into groups of some thousands: each fits a cache, and all can be divided at once.
#pragma once

#include "chasles/hierarchy/rounded_faces.h"
#include "chasles/hierarchy/split_boxes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// Bodies of fewer faces are one group: they fit a cache, and other threads would take longer to wake than they save.
inline constexpr std::size_t fewest_to_group = 1U << 15U;

/// A binary tree of planes. Its leaves are groups, numbered from left to right.
class PlaneTree {
public:
    /// A place in the tree: a number below `group_bit` is a node, beyond it a group.
    using Place = std::uint32_t;
    static constexpr Place group_bit = 0x80000000;

    struct Node {
        Plane plane;
        std::array<Place, 2> parts; ///< what the plane puts first, and the rest
    };

    /// Divides a sample of the boxes, which may be empty, while it is large. Every group holds a part of it.
    explicit PlaneTree(std::vector<PackedBox> sample);

    [[nodiscard]] std::size_t group_count() const { return group_count_; }
    [[nodiscard]] Place root() const { return root_; }
    [[nodiscard]] const Node& node(Place place) const { return nodes_[place]; }
    [[nodiscard]] static bool is_group(Place place) { return (place & group_bit) != 0; }

    [[nodiscard]] std::uint32_t group_of(const PackedBox& box) const {
        Place place = root_;
        while (!is_group(place)) {
            // A jump, as it can be foreseen: faces side by side go the same way.
            if (nodes_[place].plane.puts_first(box)) [[likely]]
                place = nodes_[place].parts[0];
            else
                place = nodes_[place].parts[1];
        }
        return place & ~group_bit;
    }

    /// The leftmost at or below a place.
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

/// All faces of a body, in groups.
struct FaceGroups {
    PlaneTree planes;
    FlatLists<std::uint32_t> faces; ///< of each group, in ascending order
};

/// On at most `threads` threads (0: all cores), which change nothing of the result. Few faces are one group.
[[nodiscard]] FaceGroups group_faces(const RoundedFaces& faces, unsigned threads);

} // namespace chasles
