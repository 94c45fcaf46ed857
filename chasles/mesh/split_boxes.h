// Divides boxes into two groups so that tests descending into the groups are expected to be few.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace chasles {

/// A box in single precision on SIMD lanes; the fourth lane is zero.
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
};

/// Boxes and the faces they enclose, side by side.
struct BoxGroup {
    std::span<PackedBox> boxes;
    std::span<std::uint32_t> faces;

    [[nodiscard]] std::size_t size() const { return boxes.size(); }
    [[nodiscard]] BoxGroup part(std::size_t begin, std::size_t count) const {
        return {boxes.subspan(begin, count), faces.subspan(begin, count)};
    }
};

/// What encloses a group, and what encloses the centres of its boxes (doubled: the sum of both corners).
struct GroupBounds {
    PackedBox boxes = PackedBox::empty();
    PackedBox centres = PackedBox::empty();

    explicit GroupBounds(std::span<const PackedBox> group);
    [[nodiscard]] float unit() const;
};

/// Reorders at least two boxes and returns how many come first; both groups have some. The cost that is made small is
/// the surface area of each group's box times its number of boxes (I. Wald, "On fast construction of SAH-based
/// bounding volume hierarchies", 2007). Where no such division exists, halves.
[[nodiscard]] std::size_t split_boxes(BoxGroup group, const GroupBounds& bounds);

} // namespace chasles
