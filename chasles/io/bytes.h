// Numbers out of raw bytes of either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <string_view>

namespace chasles::io {

/// The number whose bytes stand at the start of `bytes`, which must hold at least sizeof(Number) of them.
template <typename Number>
Number load(std::string_view bytes, std::endian order) {
    std::array<char, sizeof(Number)> raw;
    std::copy_n(bytes.begin(), raw.size(), raw.begin());
    if (order != std::endian::native)
        std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
}

} // namespace chasles::io
