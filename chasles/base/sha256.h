// The hash SHA-256 (FIPS 180-4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace chasles {

class Sha256 {
public:
    void add(std::span<const unsigned char> bytes);
    /// In hexadecimal. Nothing may be added after it.
    [[nodiscard]] std::string digest();

private:
    void mix_block();

    std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                           0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<unsigned char, 64> block_{};
    std::size_t filled_ = 0;   ///< bytes of the block
    std::uint64_t length_ = 0; ///< bytes in all
};

} // namespace chasles
