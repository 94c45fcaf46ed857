// Numbers out of the bytes that a fuzzer makes up.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace chasles::fuzz {

/// Takes bytes from the front; when they run out, zeros follow. Two calls must not be arguments of one function, whose
/// order is up to the compiler: kept inputs mean the same everywhere.
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
    /// In [0, count).
    unsigned below(unsigned count) { return byte() % count; }
    std::uint64_t word() {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i)
            bits = bits << 8 | byte();
        return bits;
    }
    /// Any double at all, NaN and infinity among them.
    double any_double() { return std::bit_cast<double>(word()); }
    /// In [-1, 1), with all bits of a double in use.
    double fraction() { return double(std::int64_t(word())) * 0x1p-63; }

private:
    std::span<const std::uint8_t> rest_;
};

/// What the fuzzer is to find: the input is kept, with `promise` as the reason.
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
