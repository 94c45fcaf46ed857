// What becomes of each face of more than three corners: kept whole, kept with triangles to cover it, or cut up.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/mesh/face_outlines.h"

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace chasles {

struct PolygonFaces {
    FaceOutlines faces;
    /// For each face that isn't convex: the triangles covering it, as corner positions. Empty where all are convex.
    FlatLists<std::uint32_t> triangles;
};

/// Planar polygons stay whole; others are cut into triangles (options.triangulate) or refused. How far from planar is
/// still planar: docs/decisions/0010-polygon-planarity.md. Throws InvalidInput, naming the given face, also for an
/// outline that crosses itself or turns back onto itself.
[[nodiscard]] PolygonFaces examine_polygons(FaceOutlines given, std::span<const Eigen::Vector3d> vertices,
                                            const PolyhedronOptions& options);

} // namespace chasles
