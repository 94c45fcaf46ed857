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

/// The parts of a surface: `face_of` gives the corners of a face, and `joined` the vertices of seams that count as one.
template <typename FaceOf, typename Edges>
ConnectedParts parts_of_surface(std::size_t vertices, std::size_t faces, const FaceOf& face_of, const Edges& joined) {
    ConnectedParts parts(vertices);
    for (std::size_t face = 0; face < faces; ++face)
        for (const std::uint32_t vertex : face_of(face))
            parts.join(face_of(face)[0], vertex);
    for (const auto& [from, to] : joined)
        parts.join(from, to);
    return parts;
}

} // namespace chasles
