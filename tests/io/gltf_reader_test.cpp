// glTF: nodes, primitives, accessors and buffers mean what the specification says, and bad files get one line.
#include "chasles/io/mesh_files.h"
#include "tests/io/file_bytes.h"
#include "tests/io/message_of.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace chasles::io {
namespace {

using nlohmann::json;
using tests::bytes_of;
using tests::glb;
using tests::message_of;
using Face = std::vector<std::uint32_t>;

// Four corners of a unit square as floats, then the indices 0 1 2, 0 2 3 as 16-bit numbers.
std::string square_buffer() {
    std::string bytes;
    for (const float x : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})
        bytes += bytes_of(x);
    for (const int corner : {0, 1, 2, 0, 2, 3})
        bytes += bytes_of(std::uint16_t(corner));
    return bytes;
}

json square() {
    return json::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"name": "a", "mesh": 0}],
        "meshes": [{"name": "m", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "buffers": [{"byteLength": 60}]})");
}

std::vector<MeshPart> read(const json& file, const std::string& binary = square_buffer()) {
    return read_gltf(glb(file.dump(), binary));
}

std::string message(const json& file, const std::string& binary = square_buffer()) {
    return message_of([&] { (void)read(file, binary); });
}

TEST(ReadGltf, PlacesMeshesByTheirNodes) {
    json file = square();
    // A quarter turn about z, a scale and a move: (1, 0, 0) goes to (0, 2, 0) and then to (10, 2, 0).
    file["nodes"] = json::parse(R"([{"name": "top", "translation": [10, 0, 0], "children": [1, 2]},
        {"mesh": 0, "rotation": [0, 0, 0.70710678, 0.70710678], "scale": [2, 3, 4]},
        {"name": "flat", "mesh": 0, "matrix": [1,0,0,0, 0,0,1,0, 0,-1,0,0, 5,6,7,1]}])");
    const std::vector<MeshPart> parts = read(file);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].name, "m") << "a node without a name has that of its mesh";
    EXPECT_EQ(parts[1].name, "flat");
    EXPECT_LT((parts[0].polygons.vertices[1] - Eigen::Vector3d(10, 2, 0)).norm(), 1e-12);
    EXPECT_LT((parts[0].polygons.vertices[3] - Eigen::Vector3d(7, 0, 0)).norm(), 1e-12);
    EXPECT_EQ(parts[1].polygons.vertices[2], Eigen::Vector3d(16, 6, 8)) << "matrices are listed by columns";
    const PolygonSoup all = merged(parts);
    EXPECT_EQ(all.vertices.size(), 8U);
    EXPECT_EQ(all.faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}));
}

TEST(ReadGltf, AMirrorTurnsTheFacesRound) {
    json file = square();
    file["nodes"][0]["scale"] = {-1, 1, 1};
    EXPECT_EQ(read(file)[0].polygons.faces[0], (Face{2, 1, 0}));
    file["nodes"][0]["scale"] = {-1, -1e-120, 1};
    EXPECT_EQ(read(file)[0].polygons.faces[0], (Face{0, 1, 2})) << "mirrored twice";
    file["nodes"][0]["scale"] = {1, 0, 1};
    EXPECT_EQ(message(file), "node 'a': its transform flattens the mesh (a scale of 0); remove the node or scale it");
}

TEST(ReadGltf, TakesTheNamedSceneOrTheFirstOrAllNodes) {
    json file = square();
    file["nodes"] =
        json::parse(R"([{"name": "a", "mesh": 0}, {"name": "b", "mesh": 0}, {"name": "c", "children": [1]}])");
    file["scenes"] = json::parse(R"([{"nodes": [0]}, {"nodes": [1]}])");
    EXPECT_EQ(read(file)[0].name, "a");
    file["scene"] = 1;
    EXPECT_EQ(read(file)[0].name, "b");
    EXPECT_EQ(read(file).size(), 1U);
    file.erase("scenes");
    EXPECT_EQ(read(file).size(), 2U) << "a, and b below c";
}

TEST(ReadGltf, ReadsStripsFansAndListsWithoutIndices) {
    json file = square();
    json& primitive = file["meshes"][0]["primitives"][0];
    primitive["mode"] = 6;
    EXPECT_EQ(read(file)[0].polygons.faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}))
        << "0 1 2 0 2 3 as a fan, without triangles of equal corners";
    primitive.erase("indices");
    EXPECT_EQ(read(file)[0].polygons.faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}));
    primitive["mode"] = 5;
    EXPECT_EQ(read(file)[0].polygons.faces, (std::vector<Face>{{0, 1, 2}, {2, 1, 3}})) << "every second one is turned";
    primitive["mode"] = 4;
    EXPECT_EQ(message(file), "mesh 0: primitive 0: 4 corners are no whole triangles");
    for (const int mode : {0, 1, 2, 3}) {
        primitive["mode"] = mode;
        EXPECT_TRUE(read(file).empty()) << "points and lines have no faces";
    }
}

TEST(ReadGltf, PrimitivesShareTheVerticesOfOneAccessor) {
    json file = square();
    file["meshes"][0]["primitives"].push_back(file["meshes"][0]["primitives"][0]);
    EXPECT_EQ(read(file)[0].polygons.vertices.size(), 4U);
    EXPECT_EQ(read(file)[0].polygons.faces.size(), 4U);
}

TEST(ReadGltf, ReadsNormalisedIntegersWithAStride) {
    std::string binary;
    for (const int x : {0, 0, 0, 9, 127, 0, 0, 9, 0, -128, 64, 9})
        binary += bytes_of(std::int8_t(x));
    json file = square();
    file["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_materials_unlit"};
    file["bufferViews"] = json::parse(R"([{"buffer": 0, "byteLength": 12, "byteStride": 4}])");
    file["accessors"] =
        json::parse(R"([{"bufferView": 0, "componentType": 5120, "count": 3, "type": "VEC3", "normalized": true}])");
    file["buffers"][0]["byteLength"] = 12;
    file["meshes"][0]["primitives"][0].erase("indices");
    const std::vector<Eigen::Vector3d> vertices = read(file, binary)[0].polygons.vertices;
    EXPECT_EQ(vertices[1], Eigen::Vector3d(1, 0, 0));
    EXPECT_EQ(vertices[2], Eigen::Vector3d(0, -1, 64 / 127.0));
}

TEST(ReadGltf, ReadsSparseAccessors) {
    json file = square();
    std::string binary = square_buffer();
    binary += bytes_of(std::uint16_t{2}) + std::string(2, '\0');
    for (const float x : {7, 8, 9})
        binary += bytes_of(x);
    file["buffers"][0]["byteLength"] = binary.size();
    file["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", 2}});
    file["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 64}, {"byteLength", 12}});
    file["accessors"][0]["sparse"] = json::parse(
        R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}})");
    EXPECT_EQ(read(file, binary)[0].polygons.vertices[2], Eigen::Vector3d(7, 8, 9));
    EXPECT_EQ(read(file, binary)[0].polygons.vertices[1], Eigen::Vector3d(1, 0, 0));
    file["accessors"][0].erase("bufferView");
    EXPECT_EQ(read(file, binary)[0].polygons.vertices[1], Eigen::Vector3d(0, 0, 0)) << "without bytes: 0";
    file["accessors"][0]["count"] = 2;
    EXPECT_EQ(message(file, binary), "accessor 0: sparse: an index is out of range");
    file["accessors"][0]["count"] = 1e12;
    EXPECT_EQ(message(file, binary), "accessor 0: announces 1000000000000 elements, but has no bufferView");
}

TEST(ReadGltf, ReadsBuffersFromTextAndFromFilesBesideIt) {
    json file = square();
    file["buffers"][0]["uri"] = "data:application/octet-stream;base64," + tests::base64(square_buffer());
    EXPECT_EQ(read_gltf(file.dump())[0].polygons.faces.size(), 2U);
    file["buffers"][0]["uri"] = "my%20square.bin";
    EXPECT_EQ(message_of([&] { (void)read_gltf(file.dump()); }),
              "buffer 0: refers to the file 'my%20square.bin'; embed the buffers, for example as GLB");
    std::string asked;
    const auto beside = [&](const std::string& name) {
        asked = name;
        return square_buffer();
    };
    EXPECT_EQ(read_gltf(file.dump(), beside)[0].polygons.faces.size(), 2U);
    EXPECT_EQ(asked, "my square.bin");
    file["buffers"][0]["uri"] = "https://example.com/a.bin";
    EXPECT_TRUE(message_of([&] { (void)read_gltf(file.dump(), beside); }).find("is no file") != std::string::npos);
}

TEST(ReadGltf, RefusesWhatWouldBeLostByName) {
    json file = square();
    file["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    EXPECT_TRUE(message(file).starts_with("needs the extension 'KHR_draco_mesh_compression', which is not read"));
    file = square();
    file["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = json::object();
    EXPECT_EQ(read(file).size(), 1U) << "the plain bytes are there, too";
    file["accessors"][0].erase("bufferView");
    EXPECT_TRUE(message(file).find("is compressed (KHR_draco_mesh_compression)") != std::string::npos);
    file = square();
    file["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = json::object();
    EXPECT_TRUE(message(file).starts_with("bufferView 0: is compressed (EXT_meshopt_compression)"));
    file = square();
    file["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = json::object();
    EXPECT_TRUE(message(file).starts_with("node 0: copies its mesh (EXT_mesh_gpu_instancing)"));
    file = square();
    file["meshes"][0]["weights"] = {0, 0.5};
    EXPECT_TRUE(message(file).starts_with("mesh 0: is morphed"));
    file = square();
    file["asset"]["version"] = "1.0";
    EXPECT_EQ(message(file), "is glTF 1.0; only glTF 2.0 is read");
}

TEST(ReadGltf, RefusesWhatIsOutOfRangeOrCut) {
    json file = square();
    file["accessors"][1]["count"] = 7;
    EXPECT_EQ(message(file), "accessor 1: announces 7 elements, which are more than its bufferView has");
    file["accessors"][1]["count"] = 9e15;
    EXPECT_EQ(message(file), "accessor 1: count: must be a whole number from 0");
    file = square();
    file["bufferViews"][0]["byteStride"] = 8;
    EXPECT_EQ(message(file), "accessor 0: the byteStride of its bufferView is shorter than one element");
    file = square();
    file["accessors"][0]["count"] = 3;
    EXPECT_EQ(message(file),
              "mesh 0: primitive 0: a vertex index is out of range; there are 3 vertices, counted from 0");
    file = square();
    file["nodes"][0]["mesh"] = 1;
    EXPECT_EQ(message(file), "there is no mesh 1");
    EXPECT_TRUE(message_of([&] { (void)read_gltf("{"); }).starts_with("is no well-formed JSON: "));
    EXPECT_EQ(message_of([&] { (void)read_gltf("{}"); }), "is no glTF: has no asset with a version");
    const std::string whole = glb(square().dump(), square_buffer());
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_FALSE(message_of([&] { (void)read_gltf(whole.substr(0, size)); }).empty()) << size;
    const std::string first =
        "glTF" + bytes_of(std::uint32_t{1}) + bytes_of(std::uint32_t{1000}) + std::string(8, '\0');
    for (const std::size_t size : {8, 12, 19, 20}) // a file of another version that is cut, too
        EXPECT_EQ(message_of([&] { (void)read_gltf(first.substr(0, size)); }),
                  "is GLB of version 1; only version 2 is read");
    std::string binary = square_buffer();
    binary.replace(0, 4, bytes_of(std::numeric_limits<float>::quiet_NaN()));
    EXPECT_EQ(message(square(), binary), "mesh 0: primitive 0: NaN or infinity in its vertices");
}

} // namespace
} // namespace chasles::io
