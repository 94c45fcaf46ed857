// Divides boxes into two parts with a low expected number of tests in a traversal (surface area heuristic).
// Source: I. Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace chasles {

/// The box of a face in single precision on SIMD lanes. The fourth lanes hold the two halves of the face's number,
/// which therefore moves with the box. They are stored as whole numbers, which do not slow down arithmetic. The fourth
/// lane of an arithmetic result is meaningless.
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

/// The bounding boxes of a group: of its boxes, and of the doubled centres (lower + upper) of its boxes.
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

/// A dividing plane. Boxes with a doubled centre below `bound` along `axis` come first.
struct Plane {
    int axis;
    float bound;

    [[nodiscard]] bool puts_first(const PackedBox& box) const { return box.lower[axis] + box.upper[axis] < bound; }
};

/// The best of some planes by the surface area heuristic: the sum over both parts of the surface area of the part's box
/// times its number of boxes is least. Empty if no plane divides the group.
[[nodiscard]] std::optional<Plane> best_plane(std::span<const PackedBox> group, const GroupBounds& bounds);

/// A group in two parts.
struct Division {
    std::size_t first; ///< number of boxes in the first part
    std::array<GroupBounds, 2> bounds;
};

/// Reorders the boxes by a plane. One part can be empty.
[[nodiscard]] Division divide_by(const Plane& plane, std::span<PackedBox> group);

/// Divides at least two boxes in the middle and keeps their order.
[[nodiscard]] Division halve(std::span<const PackedBox> group);

/// Reorders at least two boxes into two non-empty parts of low cost. Halves them if no plane divides them.
[[nodiscard]] Division divide(std::span<PackedBox> group, const GroupBounds& bounds);

} // namespace chasles
