// The faces as given become outlines of distinct vertices; what can't be a face is refused with its reason.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/mesh/polyhedron.h"

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// Outlines, each with the number of the given face it comes from.
struct FaceOutlines {
    FlatLists<std::uint32_t> outlines;
    std::vector<std::uint32_t> source;

    void append(std::span<const std::uint32_t> outline, std::uint32_t face) {
        outlines.append(outline);
        source.push_back(face);
    }
};

struct SortedFaces {
    FaceOutlines proper;    ///< not all corners on one line
    FaceOutlines collapsed; ///< all corners on one line; allowed so far by the options
    std::size_t distinct_vertices = 0;
};

/// Throws InvalidInput unless the coordinates are finite and neither the body nor its distance from the origin is of a
/// size at which arithmetic fails (docs/decisions/0012-range-of-coordinates.md).
void check_vertices(std::span<const Eigen::Vector3d> vertices);

/// Replaces each index by that of the first equal vertex, removes corners that repeat the one before, and tells proper
/// faces from collapsed ones, exactly. Throws InvalidInput for indices out of range, repeated vertices and faces
/// without area that the options don't allow.
[[nodiscard]] SortedFaces sort_faces(std::span<const Eigen::Vector3d> vertices,
                                     std::span<const std::span<const std::uint32_t>> faces,
                                     const PolyhedronOptions& options);

} // namespace chasles
