// The meshes of a file and the nodes that place them, for the formats that have nodes: glTF, COLLADA and 3MF. Their
// readers fill a graph, and `parts_of` makes the parts: one for each node with a mesh and each path to this node.
#pragma once

#include "chasles/io/mesh_files.h"

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace chasles::io {

/// A node. A node without a name gets the name of the nearest node above it.
struct SceneNode {
    std::string name;
    Eigen::Affine3d to_parent = Eigen::Affine3d::Identity();
    std::vector<std::size_t> meshes;   ///< indices of SceneGraph::meshes
    std::vector<std::size_t> children; ///< indices of SceneGraph::nodes
};

/// Nodes may have several parents.
struct SceneGraph {
    std::vector<PolygonSoup> meshes;
    std::vector<SceneNode> nodes;
    std::vector<std::size_t> roots; ///< indices of nodes
    std::size_t file_size = 0;      ///< bytes, of all files together
    std::string unit = "meter";     ///< of the coordinates of the scene
};

/// Counts vertices and corners of faces. A short file can refer to the same numbers again and again.
class SizeBudget {
public:
    /// 2^26, and more for a file that is so large itself.
    explicit SizeBudget(std::size_t file_size);

    /// Throws InvalidInput if more is counted in all than is allowed.
    void spend(std::size_t count);

private:
    std::size_t most_;
    std::size_t spent_ = 0;
};

/// Adds the triangles of a strip or of a fan of vertices. Triangles with equal corners, which join strips, are left
/// out.
void add_triangle_strip(PolygonSoup& mesh, const std::vector<std::uint32_t>& corners);
void add_triangle_fan(PolygonSoup& mesh, const std::vector<std::uint32_t>& corners);

/// The faces of each node in the coordinates of the scene, for each path from a root to the node. A mirrored mesh has
/// its faces the other way round. Names are made unique by "_2", "_3" and so on, without the names of other nodes.
/// Throws InvalidInput for a node that contains itself, for a transform that flattens a mesh, and for more than
/// 1,000,000 nodes on all paths together.
std::vector<MeshPart> parts_of(const SceneGraph& scene);

} // namespace chasles::io
