// Three bytes become four letters. If the last group has fewer than three bytes, '=' pads its four letters.
#include "view/base64.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string_view>

namespace chasles::view {
namespace {

static_assert(std::endian::native == std::endian::little, "pages hold numbers with the little end first");

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

} // namespace

std::string base64(std::span<const std::byte> bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? letters[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

} // namespace chasles::view
