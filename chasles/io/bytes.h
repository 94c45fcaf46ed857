// Reads numbers from raw bytes in either byte order.
// The bytes need no alignment.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <string_view>

namespace chasles::io {

/// The number at the start of `bytes`. There must be at least sizeof(Number) bytes.
template <typename Number>
Number load(std::string_view bytes, std::endian order) {
    std::array<char, sizeof(Number)> raw;
    std::copy_n(bytes.begin(), raw.size(), raw.begin());
    if (order != std::endian::native)
        std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
}

} // namespace chasles::io
