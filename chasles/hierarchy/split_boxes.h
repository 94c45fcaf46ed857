// Divides boxes into two groups so that tests descending into the groups are expected to be few.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace chasles {

/// A face's box in single precision on SIMD lanes. The fourth lanes are the halves of the face's number, so that both
/// move as one; as whole numbers they do not slow down arithmetic on all lanes, whose result there means nothing.
struct PackedBox {
    Eigen::Array4f lower;
    Eigen::Array4f upper;

    [[nodiscard]] static PackedBox empty() {
        constexpr float infinite = std::numeric_limits<float>::infinity();
        return {Eigen::Array4f::Constant(infinite), Eigen::Array4f::Constant(-infinite)};
    }

    void extend(const PackedBox& box) {
        lower = lower.min(box.lower);
        upper = upper.max(box.upper);
    }

    void set_face(std::uint32_t face) {
        lower[3] = static_cast<float>(face & 0xffffU);
        upper[3] = static_cast<float>(face >> 16U);
    }
    [[nodiscard]] std::uint32_t face() const {
        return static_cast<std::uint32_t>(lower[3]) | static_cast<std::uint32_t>(upper[3]) << 16U;
    }
};

/// What encloses a group, and what encloses the centres of its boxes (doubled: the sum of both corners).
struct GroupBounds {
    PackedBox boxes = PackedBox::empty();
    PackedBox centres = PackedBox::empty();

    GroupBounds() = default;
    explicit GroupBounds(std::span<const PackedBox> group) {
        for (const PackedBox& box : group)
            extend(box);
    }

    void extend(const PackedBox& box) {
        const Eigen::Array4f centre = box.lower + box.upper;
        centres.extend({centre, centre});
        boxes.extend(box);
    }
};

/// Boxes come first whose doubled centre is below `bound` along `axis`.
struct Plane {
    int axis;
    float bound;

    [[nodiscard]] bool puts_first(const PackedBox& box) const { return box.lower[axis] + box.upper[axis] < bound; }
};

/// The plane for which the surface area of each part's box times its number of boxes is least (I. Wald, "On fast
/// construction of SAH-based bounding volume hierarchies", 2007), of some planes; none if none divides the group.
[[nodiscard]] std::optional<Plane> best_plane(std::span<const PackedBox> group, const GroupBounds& bounds);

/// A group in two parts.
struct Division {
    std::size_t first; ///< number of boxes in the first part
    std::array<GroupBounds, 2> bounds;
};

/// Reorders the boxes. A part can be empty.
[[nodiscard]] Division divide_by(const Plane& plane, std::span<PackedBox> group);

/// At least two boxes, in the order as it is.
[[nodiscard]] Division halve(std::span<const PackedBox> group);

/// Reorders at least two boxes into parts of little cost, neither of them empty. Halves where no plane divides them.
[[nodiscard]] Division divide(std::span<PackedBox> group, const GroupBounds& bounds);

} // namespace chasles
