// Collapsed faces, whose corners lie on one line: the parts of their line that no edge covers stay as segments.
// Source: docs/decisions/0071-faces-without-area.md; docs/derivations/22-faces-without-area.md.
#pragma once

#include "chasles/mesh/face_outlines.h"
#include "chasles/mesh/mesh_edges.h"

#include <Eigen/Core>
#include <span>

namespace chasles {

/// The parts of the collapsed faces that are not in the kept faces: segments between two corners a and b as outlines
/// a, b, b, and single points p as outlines p, p, p. Each segment occurs once. The kept faces and the segments are the
/// same set of points as all given faces.
[[nodiscard]] FaceOutlines uncovered_segments(const FaceOutlines& collapsed, const FlatLists<std::uint32_t>& kept,
                                              const MeshEdges& edges, std::span<const Eigen::Vector3d> vertices);

} // namespace chasles
