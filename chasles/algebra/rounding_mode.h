// Does this thread round to nearest? Everything that is derived here assumes so.
#pragma once

namespace chasles::algebra {

/// Asks the arithmetic itself: a few sums whose exact values lie off the middle between two doubles.
inline bool rounds_to_nearest() {
    const volatile double one = 1; // not to be folded by a compiler, which assumes rounding to nearest
    const volatile double less_than_half_up = 0x1p-54;
    const volatile double less_than_half_down = 0x1p-55;
    return one + less_than_half_up == one && one - less_than_half_down == one;
}

} // namespace chasles::algebra
