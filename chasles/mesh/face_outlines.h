// Turns the given faces into outlines of distinct vertices and sorts out the faces without area. Refuses invalid faces
// with the reason.
// Source: docs/decisions/0011-equal-vertices-and-collapsed-faces.md.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/mesh/polyhedron.h"

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// Outlines, each with the number of its given face.
struct FaceOutlines {
    FlatLists<std::uint32_t> outlines;
    std::vector<std::uint32_t> source;

    void append(std::span<const std::uint32_t> outline, std::uint32_t face) {
        outlines.append(outline);
        source.push_back(face);
    }
};

/// Faces, sorted by whether they have an area.
struct SortedFaces {
    FaceOutlines proper;    ///< not all corners on one line
    FaceOutlines collapsed; ///< all corners on one line
    std::size_t distinct_vertices = 0;

    /// Removes the corners that repeat the previous corner, and appends the face.
    void append(std::vector<std::uint32_t>& corners, std::uint32_t source, std::span<const Eigen::Vector3d> vertices);
};

/// Throws InvalidInput if a coordinate is not finite or exceeds 1e30, or if the body is smaller than 1e-30 in the
/// length unit. Arithmetic would overflow or underflow there (docs/decisions/0012-range-of-coordinates.md). A round
/// body may be a single point.
void check_vertices(std::span<const Eigen::Vector3d> vertices, bool is_round);

/// Throws InvalidInput: a mesh without area needs a radius.
[[noreturn]] void refuse_without_area();

/// Replaces each index by the index of the first equal vertex, removes corners that repeat the previous corner, and
/// sorts proper faces from collapsed faces by exact tests. Throws InvalidInput for an index out of range, for a face of
/// fewer than three corners, and if no face has an area, unless the body is round.
[[nodiscard]] SortedFaces sort_faces(std::span<const Eigen::Vector3d> vertices,
                                     std::span<const std::span<const std::uint32_t>> faces, bool is_round);

} // namespace chasles
