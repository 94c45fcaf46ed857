// A face whose corners lie on one line may go only where other faces hold every point of it.
#pragma once

#include "chasles/mesh/face_outlines.h"
#include "chasles/mesh/mesh_edges.h"

#include <Eigen/Core>
#include <span>

namespace chasles {

/// Throws InvalidInput, naming the face, unless each collapsed face is covered by the edges of the faces kept (or,
/// shrunk to a point, is a vertex of one). So leaving them out doesn't change the surface as a set of points. Why:
/// docs/decisions/0011-equal-vertices-and-collapsed-faces.md.
void check_covered(const FaceOutlines& collapsed, const FlatLists<std::uint32_t>& kept, const MeshEdges& edges,
                   std::span<const Eigen::Vector3d> vertices);

} // namespace chasles
