// The header of a PLY file: which elements follow, how many, and what numbers each of them has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// One number of an element, or a list of numbers that is led by its length.
struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> length_type; ///< set for lists
};

/// `count` items in a row, each with the same properties.
struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0;  ///< bytes up to the data
    std::size_t lines = 0; ///< lines up to the data
};

/// Throws InvalidInput "line N: WHY".
PlyHeader read_ply_header(std::string_view text);

} // namespace chasles::io
