// Decodes the output of view/base64.h with an independent table.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::tests {

inline std::string unpacked_bytes(std::string_view text) {
    static constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text.substr(0, text.find('='))) {
        bits = bits << 6 | static_cast<unsigned>(letters.find(c));
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += static_cast<char>(bits >> count & 255);
        }
    }
    return bytes;
}

template <class T>
std::vector<T> unpacked(std::string_view text) {
    const std::string bytes = unpacked_bytes(text);
    std::vector<T> numbers(bytes.size() / sizeof(T));
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(T));
    return numbers;
}

} // namespace chasles::tests
