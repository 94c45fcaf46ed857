// The header of a PLY file: the elements, their counts, and the properties of each element.
// Every message has the form "line N: WHY".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// A number of an element, or a list of numbers that starts with its length.
struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> length_type; ///< set for lists
};

/// `count` consecutive items with the same properties.
struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

/// The content of the header.
struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0;  ///< in bytes
    std::size_t lines = 0; ///< number of lines
};

/// Reads the header at the start of `text`. Throws InvalidInput "line N: WHY".
PlyHeader read_ply_header(std::string_view text);

} // namespace chasles::io
