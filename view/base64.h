// Arrays of numbers as text: the bytes in little-endian order, in base64 (RFC 4648).
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace chasles::view {

std::string base64(std::span<const std::byte> bytes);

} // namespace chasles::view
