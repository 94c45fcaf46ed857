// The check that collapsed faces, whose corners lie on one line, can be dropped without changing the surface.
// Source: docs/decisions/0011-equal-vertices-and-collapsed-faces.md.
#pragma once

#include "chasles/mesh/face_outlines.h"
#include "chasles/mesh/mesh_edges.h"

#include <Eigen/Core>
#include <span>

namespace chasles {

/// Checks that edges of the kept faces cover each collapsed face. A face that is collapsed to a point must be a vertex
/// of a kept face. Then dropping the collapsed faces does not change the surface as a set of points. Throws
/// InvalidInput with the number of the face.
void check_covered(const FaceOutlines& collapsed, const FlatLists<std::uint32_t>& kept, const MeshEdges& edges,
                   std::span<const Eigen::Vector3d> vertices);

} // namespace chasles
