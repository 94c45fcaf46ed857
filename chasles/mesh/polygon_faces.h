// The treatment of each face with more than three corners: kept, kept with covering triangles, cut into faces, or
// refused. With the option triangulate no polygon is refused. Source: docs/decisions/0010-polygon-planarity.md.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/mesh/face_outlines.h"

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace chasles {

/// The faces of a body after all checks.
struct PolygonFaces {
    FaceOutlines faces;
    /// For each face that is not convex: the triangles that cover it, as positions of corners. Empty if all faces are
    /// convex.
    FlatLists<std::uint32_t> triangles;
    FaceOutlines collapsed; ///< the faces without area
};

/// Keeps planar polygons. Cuts other polygons into triangles (options.triangulate) or refuses them. The tolerance for
/// planar polygons is in docs/decisions/0010-polygon-planarity.md. Throws InvalidInput with the number of the given
/// face, also for an outline that crosses itself or turns back onto itself; options.triangulate accepts all of them.
[[nodiscard]] PolygonFaces examine_polygons(SortedFaces given, std::span<const Eigen::Vector3d> vertices,
                                            const PolyhedronOptions& options);

} // namespace chasles
