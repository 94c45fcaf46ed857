// Numbers from the bytes of a fuzzer.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace chasles::fuzz {

/// Reads bytes from the front, and zeros after the end. Two calls must not be arguments of one function call, because
/// the compiler chooses their order: kept inputs must mean the same everywhere.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

    std::uint8_t byte() {
        if (rest_.empty())
            return 0;
        const std::uint8_t first = rest_.front();
        rest_ = rest_.subspan(1);
        return first;
    }
    /// A number in [0, count).
    unsigned below(unsigned count) { return byte() % count; }
    std::uint64_t word() {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i)
            bits = bits << 8 | byte();
        return bits;
    }
    /// Any double, including NaN and infinity.
    double any_double() { return std::bit_cast<double>(word()); }
    /// A number in [-1, 1) that uses all bits of a double.
    double fraction() { return double(std::int64_t(word())) * 0x1p-63; }

private:
    std::span<const std::uint8_t> rest_;
};

/// Aborts if `holds` is false. The fuzzer then keeps the input, with `promise` as the reason.
inline void demand(bool holds, const char* promise) {
    if (holds)
        return;
    std::fprintf(stderr, "BROKEN PROMISE: %s\n", promise);
    std::abort();
}

/// The bytes as text.
inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

} // namespace chasles::fuzz
