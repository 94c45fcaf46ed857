// What a surface encloses: its connected parts, and which of them are closed and belong to a solid.
// Source: docs/derivations/37-inside.md.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/mesh/edge.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/mesh/seams.h"

#include <span>
#include <vector>

namespace chasles {

/// Some points of the parts of a surface, and a box around them, in the body's frame.
struct PartBlock {
    std::uint32_t begin; ///< in Volume::part_points
    std::uint32_t end;
    Eigen::Vector3d centre; ///< of the box
    Eigen::Vector3d half;   ///< of its sides, rounded outwards
};

/// The inside of a body.
struct Volume {
    std::vector<std::uint32_t> part_points; ///< a vertex of each connected part, one of its farthest from the middle
    std::vector<PartBlock> blocks;          ///< of these points
    std::vector<char> in_solid_part;        ///< for each face; empty if the same holds for all faces
    std::size_t solid_parts = 0;
    std::size_t unpaired_edges = 0;
    std::vector<Edge> joined; ///< vertices of seams, ascending: from each one to that in whose place it counts
    double seam = 0;          ///< no two of these are farther from each other, mesh unit

    [[nodiscard]] bool is_solid() const { return solid_parts > 0; }
    /// Whether a face of a solid body bounds its volume.
    [[nodiscard]] bool is_bounded_by(std::size_t face) const { return in_solid_part.empty() || in_solid_part[face]; }
    /// The vertex in whose place a vertex counts: itself, but at seams.
    [[nodiscard]] std::uint32_t place_of(std::uint32_t vertex) const {
        return joined.empty() ? vertex : place_in(joined, vertex);
    }
    /// Bytes held.
    [[nodiscard]] std::size_t memory() const;
};

/// The faces of a body, and its unpaired edges.
struct Surface {
    std::span<const Eigen::Vector3d> vertices;
    const FlatLists<std::uint32_t>& outlines; ///< a, b, b for a segment, which bounds nothing
    std::span<const UnpairedEdge> unpaired;
    Eigen::Vector3d middle;
};

/// A part is solid if none of its edges is unpaired, once vertices of the rim at the same place up to rounding count as
/// one, and one of its faces has an area. Throws InvalidInput if all parts
/// have to be solid and one is not.
[[nodiscard]] Volume find_volume(const Surface& surface, Solid solid);

/// The volume that the solid parts enclose, cubic mesh unit: negative for surfaces turned inwards.
[[nodiscard]] double signed_volume(const Surface& surface, const Volume& volume);

} // namespace chasles
