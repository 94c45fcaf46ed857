// Prepares both ends of an interval in single precision, and chooses the kernel for the processor at run time.
// All kernels return the same bits.
#include "chasles/culling/swept_boxes.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi" // on passing vectors: all functions with vector arguments are inlined here
#endif

namespace chasles::culling {

namespace {

/// A computed window is widened by this for the rounding of a quotient in [0, 1] (note 14, "Rounding").
constexpr float window_slack = 0x1p-20F;
constexpr Window never{1, 0};
/// Directions of gaps are made this long, so that rounding makes none longer than 1.
constexpr float direction_length = 1 - 0x1p-20F;

// The kernel is compiled for the target of the library and, on x86-64, also for AVX2. The processor at run time decides
// which kernel runs. No kernel uses fused operations, therefore both return the same bits. tests/bits checks this with
// CHASLES_PLAIN_KERNEL.
namespace plain {
#include "chasles/culling/swept_boxes_lanes.inl"

#include "chasles/culling/swept_boxes_kernel.inl"
} // namespace plain

#if defined(__x86_64__) && defined(__GNUC__) && !defined(CHASLES_PLAIN_KERNEL)
#define CHASLES_KERNEL_AVX2
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
#include "chasles/culling/swept_boxes_lanes.inl"

#include "chasles/culling/swept_boxes_kernel.inl"
} // namespace avx2
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

SweptBoxes::Windows overlap_windows(const TwoNodes& outer, const TwoNodes& inner, const SweptBoxes::View& a_in_b,
                                    const SweptBoxes::View& b_in_a, float margin, const Window& when) {
#if defined(CHASLES_KERNEL_AVX2)
    if (__builtin_cpu_supports("avx2"))
        return avx2::overlap_windows(outer, inner, a_in_b, b_in_a, margin, when);
#endif
    return plain::overlap_windows(outer, inner, a_in_b, b_in_a, margin, when);
}

SweptBoxes::Gaps widest_gaps(const TwoNodes& outer, const TwoNodes& inner, const SweptBoxes::View& a_in_b,
                             const SweptBoxes::View& b_in_a) {
#if defined(CHASLES_KERNEL_AVX2)
    if (__builtin_cpu_supports("avx2"))
        return avx2::widest_gaps(outer, inner, a_in_b, b_in_a);
#endif
    return plain::widest_gaps(outer, inner, a_in_b, b_in_a);
}

/// Sets the four lanes of one end (0: start, 1: end).
void set(SweptBoxes::BothEnds& ends, int end, double value) {
    std::fill_n(&ends.lanes[4 * std::size_t(end)], 4, float(value));
}

/// Sets the map of a view at one end.
void place(SweptBoxes::View& view, int end, const Placement& placed) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            set(view.rotation[i][j], end, placed.rotation(i, j));
        set(view.offset[i], end, placed.offset[i]);
    }
}

/// The placement of the fixed hierarchy in the frame of the moving hierarchy.
Placement inverse(const Placement& placed) {
    return {placed.rotation.transpose(), -(placed.rotation.transpose() * placed.offset)};
}

} // namespace

SweptBoxes::SweptBoxes(const Placement& start, const Placement& end, const BoxSlack& slack)
    : margin_(float(slack.margin)) {
    place(moving_, 0, start);
    place(moving_, 1, end);
    place(fixed_, 0, inverse(start));
    place(fixed_, 1, inverse(end));
    moving_.slack = float(slack.moving);
    fixed_.slack = float(slack.fixed);
}

SweptBoxes::Windows SweptBoxes::overlap_windows(const TwoNodes& moving, const TwoNodes& fixed,
                                                const Window& when) const {
    return culling::overlap_windows(moving, fixed, moving_, fixed_, margin_, when);
}

SweptBoxes::Gaps SweptBoxes::widest_gaps(const TwoNodes& moving, const TwoNodes& fixed) const {
    return culling::widest_gaps(moving, fixed, moving_, fixed_);
}

} // namespace chasles::culling
