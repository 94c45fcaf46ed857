// The connected parts of a surface: vertices that share a face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace chasles {

/// Disjoint sets of vertices. At first each vertex is a set of its own.
class ConnectedParts {
public:
    explicit ConnectedParts(std::size_t vertices) : above_(vertices) { std::iota(above_.begin(), above_.end(), 0U); }

    /// A vertex that stands for all vertices of the same part.
    std::uint32_t of(std::uint32_t vertex) {
        while (above_[vertex] != vertex)
            vertex = above_[vertex] = above_[above_[vertex]];
        return vertex;
    }
    void join(std::uint32_t a, std::uint32_t b) { above_[of(a)] = of(b); }

private:
    std::vector<std::uint32_t> above_;
};

} // namespace chasles
