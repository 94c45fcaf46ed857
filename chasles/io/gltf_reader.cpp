// Reads glTF 2.0 as text (.gltf) and as binary (.glb), which its first bytes tell apart. Only nodes, meshes and what
// they need are read: colours, textures, normals, cameras, lights and animations are ignored. Skinned meshes are taken
// in their bind pose. Source: glTF 2.0 specification (Khronos).
#include "chasles/io/bytes.h"
#include "chasles/io/gltf_buffers.h"
#include "chasles/io/scene_graph.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace chasles::io {
namespace {

// The JSON and the binary chunk of a file.
struct GltfChunks {
    std::string_view json;
    std::string_view binary;
};

std::uint32_t word_at(std::string_view bytes, std::size_t position) {
    return load<std::uint32_t>(bytes.substr(position), std::endian::little);
}

// Takes a GLB file apart. Chunks of other types are skipped, as the specification demands.
GltfChunks glb_chunks(std::string_view bytes) {
    constexpr std::uint32_t json_type = 0x4E4F534A, binary_type = 0x004E4942;
    if (bytes.size() >= 8 && word_at(bytes, 4) != 2)
        throw InvalidInput("is GLB of version " + std::to_string(word_at(bytes, 4)) + "; only version 2 is read");
    if (bytes.size() < 20 || word_at(bytes, 8) > bytes.size())
        throw InvalidInput("is truncated: the file is shorter than its header announces");
    const std::size_t end = word_at(bytes, 8);
    GltfChunks chunks;
    std::size_t position = 12;
    while (position <= end && end - position >= 8) {
        const std::size_t length = word_at(bytes, position);
        const std::uint32_t type = word_at(bytes, position + 4);
        position += 8;
        if (length > end - position)
            throw InvalidInput("is truncated: a chunk is longer than the file");
        std::string_view* const chunk = type == json_type     ? &chunks.json
                                        : type == binary_type ? &chunks.binary
                                                              : nullptr;
        if (chunk && chunk->empty())
            *chunk = bytes.substr(position, length);
        position += length;
    }
    return chunks;
}

// The local transform of a node. Quaternions are normalised, because files hold them as rounded floats.
Eigen::Affine3d gltf_transform(const GltfItem& node) {
    if (const std::vector<double> matrix = node.numbers("matrix", 16); !matrix.empty()) {
        const Eigen::Matrix4d transform = Eigen::Map<const Eigen::Matrix4d>(matrix.data());
        if (transform.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
            node.fail("matrix: the last row must be 0 0 0 1");
        return Eigen::Affine3d(transform);
    }
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (const std::vector<double> move = node.numbers("translation", 3); !move.empty())
        transform.translate(Eigen::Vector3d(move[0], move[1], move[2]));
    if (const std::vector<double> turn = node.numbers("rotation", 4); !turn.empty()) {
        const Eigen::Quaterniond rotation(turn[3], turn[0], turn[1], turn[2]);
        if (!(rotation.squaredNorm() > 0))
            node.fail("rotation: must not be 0");
        transform.rotate(rotation.normalized());
    }
    if (const std::vector<double> scale = node.numbers("scale", 3); !scale.empty())
        transform.scale(Eigen::Vector3d(scale[0], scale[1], scale[2]));
    return transform;
}

class GltfReader {
public:
    GltfReader(const Json& file, const GltfChunks& chunks, const FileBeside& file_beside)
        : file_(file), buffers_(file, chunks.binary, file_beside), budget_(chunks.json.size() + chunks.binary.size()) {
        scene_.file_size = chunks.json.size() + chunks.binary.size();
    }

    SceneGraph read() {
        refuse_unknown_extensions();
        const std::size_t count = root_item().list("nodes").size();
        for (std::size_t node = 0; node < count; ++node)
            scene_.nodes.push_back(node_of(gltf_item(file_, "node", node), count));
        scene_.roots = roots(count);
        return std::move(scene_);
    }

private:
    [[nodiscard]] GltfItem root_item() const { return {file_, "file"}; }

    // A required extension may change what a mesh is. Those of materials and textures do not.
    void refuse_unknown_extensions() const {
        for (const Json& name : root_item().list("extensionsRequired")) {
            const std::string text = name.is_string() ? name.get<std::string>() : "";
            const bool changes_no_mesh = text.starts_with("KHR_materials_") || text.starts_with("KHR_texture_") ||
                                         text.starts_with("EXT_texture_") || text.starts_with("KHR_lights_") ||
                                         text.starts_with("KHR_xmp") || text == "KHR_mesh_quantization";
            if (!changes_no_mesh)
                throw InvalidInput("needs the extension " + in_quotes(text) +
                                   ", which is not read; export without it (or without compression)");
        }
    }

    // The nodes of the scene that the file names, of the first scene, or all that are no children.
    std::vector<std::size_t> roots(std::size_t node_count) const {
        if (root_item().list("scenes").empty())
            return nodes_without_parent();
        const GltfItem scene = gltf_item(file_, "scene", root_item().count("scene", 0));
        return node_indices(scene, "nodes", node_count);
    }

    std::vector<std::size_t> nodes_without_parent() const {
        std::vector<bool> is_child(scene_.nodes.size(), false);
        for (const SceneNode& node : scene_.nodes)
            for (const std::size_t child : node.children)
                is_child[child] = true;
        std::vector<std::size_t> nodes;
        for (std::size_t node = 0; node < is_child.size(); ++node)
            if (!is_child[node])
                nodes.push_back(node);
        return nodes;
    }

    static std::vector<std::size_t> node_indices(const GltfItem& item, const char* key, std::size_t node_count) {
        std::vector<std::size_t> indices;
        for (const Json& index : item.list(key)) {
            indices.push_back(item.count_in(index, key));
            if (indices.back() >= node_count)
                item.fail("there is no node " + std::to_string(indices.back()));
        }
        return indices;
    }

    SceneNode node_of(const GltfItem& item, std::size_t node_count) {
        SceneNode node;
        node.name = item.text("name");
        node.to_parent = gltf_transform(item);
        node.children = node_indices(item, "children", node_count);
        if (item.has_extension("EXT_mesh_gpu_instancing"))
            item.fail("copies its mesh (EXT_mesh_gpu_instancing), which is not read; export one node for each copy");
        if (item.find("mesh")) {
            refuse_morphed(item);
            const GltfItem mesh = gltf_item(file_, "mesh", item.count("mesh"));
            node.meshes = {mesh_of(mesh, item.count("mesh"))};
            if (node.name.empty())
                node.name = mesh.text("name");
        }
        return node;
    }

    // The base of a morphed mesh is another shape than the one that the scene shows.
    static void refuse_morphed(const GltfItem& item) {
        for (const Json& weight : item.list("weights"))
            if (!weight.is_number() || weight.get<double>() != 0)
                item.fail("is morphed (weights that are not 0), which is not read; apply the morph targets first");
    }

    std::size_t mesh_of(const GltfItem& item, std::size_t index) {
        const auto [known, is_new] = meshes_.try_emplace(index, scene_.meshes.size());
        if (is_new) {
            refuse_morphed(item);
            scene_.meshes.emplace_back();
            std::map<std::size_t, std::uint32_t> first_vertices; // by accessor: primitives often share their vertices
            std::size_t number = 0;
            for (const Json& primitive : item.list("primitives"))
                add_primitive({primitive, item.place + ": primitive " + std::to_string(number++)}, first_vertices);
        }
        return known->second;
    }

    void add_primitive(const GltfItem& primitive, std::map<std::size_t, std::uint32_t>& first_vertices) {
        const std::size_t mode = primitive.json.is_object() ? primitive.count("mode", 4) : 99;
        if (mode > 6)
            primitive.fail("mode: must be 0 to 6");
        if (mode < 4)
            return; // points and lines
        PolygonSoup& mesh = scene_.meshes.back();
        const std::vector<std::uint32_t> corners = corners_of(primitive, first_vertices);
        if (mode == 5)
            add_triangle_strip(mesh, corners);
        else if (mode == 6)
            add_triangle_fan(mesh, corners);
        else
            add_triangles(primitive, corners);
    }

    std::size_t position_accessor(const GltfItem& primitive) const {
        const Json* const attributes = primitive.find("attributes");
        if (!attributes || !attributes->is_object() || !attributes->contains("POSITION"))
            primitive.fail("has no POSITION");
        const std::size_t accessor = GltfItem{*attributes, primitive.place}.count("POSITION");
        const bool is_compressed = primitive.has_extension("KHR_draco_mesh_compression") &&
                                   !gltf_item(file_, "accessor", accessor).find("bufferView");
        if (is_compressed)
            primitive.fail("is compressed (KHR_draco_mesh_compression), which is not read; export without compression");
        return accessor;
    }

    // Vertices of the mesh.
    struct VertexRange {
        std::uint32_t first;
        std::size_t count;
    };

    VertexRange vertices_of(const GltfItem& primitive, std::map<std::size_t, std::uint32_t>& first_vertices) {
        std::vector<Eigen::Vector3d>& vertices = scene_.meshes.back().vertices;
        const std::size_t accessor = position_accessor(primitive);
        const auto [known, is_new] = first_vertices.try_emplace(accessor, static_cast<std::uint32_t>(vertices.size()));
        if (is_new) {
            const std::vector<double> numbers = buffers_.numbers(accessor, "VEC3", budget_);
            counts_[accessor] = numbers.size() / 3;
            for (std::size_t i = 0; i < numbers.size(); i += 3)
                vertices.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
            if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); }))
                primitive.fail("NaN or infinity in its vertices");
        }
        return {known->second, counts_.at(accessor)};
    }

    // The indices of the primitive; without indices, all vertices in order.
    std::vector<std::uint32_t> corners_of(const GltfItem& primitive,
                                          std::map<std::size_t, std::uint32_t>& first_vertices) {
        const auto [first, count] = vertices_of(primitive, first_vertices);
        std::vector<std::uint32_t> corners;
        if (!primitive.find("indices")) {
            budget_.spend(count);
            corners.resize(count);
            std::iota(corners.begin(), corners.end(), first);
            return corners;
        }
        for (const double index : buffers_.numbers(primitive.count("indices"), "SCALAR", budget_)) {
            if (!(index >= 0 && index < double(count)) || index != std::floor(index))
                primitive.fail("a vertex index is out of range; there are " + std::to_string(count) +
                               " vertices, counted from 0");
            corners.push_back(first + static_cast<std::uint32_t>(index));
        }
        return corners;
    }

    void add_triangles(const GltfItem& primitive, const std::vector<std::uint32_t>& corners) {
        if (corners.size() % 3 != 0)
            primitive.fail(std::to_string(corners.size()) + " corners are no whole triangles");
        for (std::size_t i = 0; i < corners.size(); i += 3)
            scene_.meshes.back().faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }

    const Json& file_;
    GltfBuffers buffers_;
    SizeBudget budget_;
    std::map<std::size_t, std::size_t> meshes_; ///< place in the scene by place in the file
    std::map<std::size_t, std::size_t> counts_; ///< vertices by accessor
    SceneGraph scene_;
};

} // namespace

std::vector<MeshPart> read_gltf(std::string_view bytes, const FileBeside& file_beside) {
    const GltfChunks chunks =
        bytes.starts_with("glTF") ? glb_chunks(bytes) : GltfChunks{without_byte_order_mark(bytes), {}};
    Json file;
    try {
        file = Json::parse(chunks.json);
    } catch (const Json::exception& error) {
        const std::string why = error.what(); // "[json.exception.parse_error.101] parse error at ..."
        throw InvalidInput("is no well-formed JSON: " + one_line(why.substr(why.find(']') + 2)).substr(0, 200));
    }
    const auto asset = file.find("asset");
    const bool has_asset = file.is_object() && asset != file.end() && asset->is_object();
    const std::string version = has_asset ? GltfItem{*asset, "asset"}.text("version") : "";
    if (!version.starts_with("2."))
        throw InvalidInput(version.empty() ? "is no glTF: has no asset with a version"
                                           : "is glTF " + one_line(version) + "; only glTF 2.0 is read");
    return parts_of(GltfReader(file, chunks, file_beside).read());
}

} // namespace chasles::io
