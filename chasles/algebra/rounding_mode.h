// A test of the rounding mode of the current thread. All error bounds of the library assume rounding to nearest.
#pragma once

namespace chasles::algebra {

/// Whether this thread rounds to nearest. Computes two sums whose exact values are no ties between two doubles.
inline bool rounds_to_nearest() {
    const volatile double one = 1; // volatile: a compiler would fold the sums and assume rounding to nearest
    const volatile double less_than_half_up = 0x1p-54;
    const volatile double less_than_half_down = 0x1p-55;
    return one + less_than_half_up == one && one - less_than_half_down == one;
}

} // namespace chasles::algebra
