// Sheets of triangles for tests of surfaces with many faces.
#pragma once

#include <cstdint>
#include <vector>

namespace chasles::test {

/// A grid with two triangles per cell. Vertex (i, j) has the number i * (width + 1) + j, with i up to `length`.
inline std::vector<std::vector<std::uint32_t>> grid_triangles(std::uint32_t length, std::uint32_t width) {
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t i = 0; i < length; ++i)
        for (std::uint32_t j = 0; j < width; ++j) {
            const std::uint32_t at = i * (width + 1) + j;
            const std::uint32_t next = at + width + 1;
            faces.push_back({at, next, next + 1});
            faces.push_back({at, next + 1, at + 1});
        }
    return faces;
}

} // namespace chasles::test
