// Eight boxes side by side in single precision, tested at once against one box.
// Source: docs/derivations/27-scenes.md, "Pairs".
#pragma once

#include "chasles/scene/swept_body.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace chasles::scene {

/// A box whose numbers are rounded. Rounding keeps the order of numbers: boxes that overlap still overlap.
struct FloatBox {
    std::array<float, 3> lower;
    std::array<float, 3> upper;
};

inline FloatBox rounded(const Box& box) {
    const auto& lower = box.min();
    const auto& upper = box.max();
    return {{float(lower[0]), float(lower[1]), float(lower[2])}, {float(upper[0]), float(upper[1]), float(upper[2])}};
}

class BoxBlock {
public:
    static constexpr std::size_t size = 8;

    /// Empty boxes, which overlap with nothing.
    BoxBlock() {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower_[axis].fill(std::numeric_limits<float>::infinity());
            upper_[axis].fill(-std::numeric_limits<float>::infinity());
        }
    }

    void set(std::size_t i, const FloatBox& box) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower_[axis][i] = box.lower[axis];
            upper_[axis][i] = box.upper[axis];
        }
    }
    [[nodiscard]] FloatBox operator[](std::size_t i) const {
        return {{lower_[0][i], lower_[1][i], lower_[2][i]}, {upper_[0][i], upper_[1][i], upper_[2][i]}};
    }
    /// The box around all boxes.
    [[nodiscard]] FloatBox hull() const {
        FloatBox hull = (*this)[0];
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 1; i < size; ++i) {
                hull.lower[axis] = std::min(hull.lower[axis], lower_[axis][i]);
                hull.upper[axis] = std::max(hull.upper[axis], upper_[axis][i]);
            }
        return hull;
    }
    /// One bit for each box that overlaps with this one, or touches it.
    [[nodiscard]] unsigned overlapping(const FloatBox& box) const { return half(box, 0) | half(box, 4) << 4U; }

private:
#if defined(__SSE2__)
    /// Four boxes, from the first one on.
    [[nodiscard]] unsigned half(const FloatBox& box, std::size_t first) const {
        const auto along = [&](std::size_t axis) {
            const __m128 below = _mm_cmple_ps(_mm_load_ps(&lower_[axis][first]), _mm_set1_ps(box.upper[axis]));
            const __m128 above = _mm_cmpge_ps(_mm_load_ps(&upper_[axis][first]), _mm_set1_ps(box.lower[axis]));
            return _mm_and_ps(below, above);
        };
        return unsigned(_mm_movemask_ps(_mm_and_ps(_mm_and_ps(along(0), along(1)), along(2))));
    }
#else
    [[nodiscard]] unsigned half(const FloatBox& box, std::size_t first) const {
        unsigned bits = 0xf;
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < 4; ++i) {
                const bool overlap =
                    int(lower_[axis][first + i] <= box.upper[axis]) & int(upper_[axis][first + i] >= box.lower[axis]);
                bits &= ~(unsigned(!overlap) << i);
            }
        return bits;
    }
#endif

    alignas(16) std::array<std::array<float, size>, 3> lower_;
    alignas(16) std::array<std::array<float, size>, 3> upper_;
};

} // namespace chasles::scene
