// Reads glTF, COLLADA, 3MF and other formats through Assimp. Assimp does no post-processing, therefore polygons and
// coordinates stay unchanged. This file applies the node transforms in double.
#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/text_scan.h"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <limits>

namespace chasles::io {
namespace {

// The transform of a node relative to its parent, in double.
Eigen::Affine3d transform_of(const aiNode& node) {
    Eigen::Matrix4d matrix;
    for (unsigned row = 0; row < 4; ++row)
        for (unsigned column = 0; column < 4; ++column)
            matrix(row, column) = static_cast<double>(node.mTransformation[row][column]);
    return Eigen::Affine3d(matrix);
}

// Refuses meshes whose vertices cannot be numbered with 32 bits.
void check_size(std::size_t vertices) {
    if (vertices >= std::numeric_limits<std::uint32_t>::max())
        throw InvalidInput("more than 4,294,967,294 vertices");
}

// Appends the vertices of a mesh in world coordinates.
void add_vertices(PolygonSoup& soup, const aiMesh& mesh, const Eigen::Affine3d& to_world) {
    check_size(soup.vertices.size() + mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D& vertex = mesh.mVertices[i];
        soup.vertices.push_back(to_world * Eigen::Vector3d(vertex.x, vertex.y, vertex.z));
        if (!soup.vertices.back().allFinite())
            throw InvalidInput("mesh '" + one_line(mesh.mName.C_Str()) + "': vertex " + std::to_string(i) +
                               ": NaN or infinity");
    }
}

// Skips points and lines, which Assimp represents as faces with one or two vertices. They have no area.
void add_faces(PolygonSoup& soup, const aiMesh& mesh, std::uint32_t first_vertex) {
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices < 3)
            continue;
        std::vector<std::uint32_t> outline;
        for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
            if (face.mIndices[corner] >= mesh.mNumVertices)
                throw InvalidInput("mesh '" + one_line(mesh.mName.C_Str()) + "': face " + std::to_string(i) +
                                   ": vertex index " + std::to_string(face.mIndices[corner]) + " is out of range");
            outline.push_back(first_vertex + face.mIndices[corner]);
        }
        soup.faces.push_back(std::move(outline));
    }
}

// The depth limit of Assimp bounds the recursion: recursive readers build its tree.
void add_node(PolygonSoup& soup, const aiScene& scene, const aiNode& node, const Eigen::Affine3d& parent) {
    // Meshes are in the frame of their node. A mesh that several nodes use is added once for each node.
    const Eigen::Affine3d to_world = parent * transform_of(node);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
        const auto first_vertex = static_cast<std::uint32_t>(soup.vertices.size());
        add_vertices(soup, mesh, to_world);
        add_faces(soup, mesh, first_vertex);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        add_node(soup, scene, *node.mChildren[i], to_world);
}

} // namespace

PolygonSoup read_with_assimp(const std::filesystem::path& file, bool keeps_axes) {
    // The flags are 0: Assimp does no post-processing, which could merge, reorder or triangulate faces.
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, keeps_axes);
    const std::string extension = file.extension().string();
    if (extension.empty() || !importer.IsExtensionSupported(extension))
        throw InvalidInput("no reader for the extension " + in_quotes(extension) +
                           "; supported are .obj, .off, .ply, .stl, " +
                           ".gltf, .glb, .dae, .3mf and other formats of Assimp");
    const aiScene* const scene = importer.ReadFile(file.string(), 0);
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw InvalidInput("cannot be read: " + one_line(importer.GetErrorString()));
    PolygonSoup soup;
    add_node(soup, *scene, *scene->mRootNode, Eigen::Affine3d::Identity());
    return soup;
}

} // namespace chasles::io
