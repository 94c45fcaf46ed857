// For any bytes, a reader returns a soup with indices in range and finite coordinates, or throws InvalidInput with a
// message of one line. The test reads truncated and damaged versions of valid files, each from a fixed seed.
#include "chasles/io/mesh_files.h"
#include "tests/io/file_bytes.h"
#include "tests/io/message_of.h"

#include <functional>
#include <random>

namespace chasles::io {
namespace {

struct Sample {
    const char* name;
    std::function<PolygonSoup(std::string_view)> read;
    std::string bytes;
};

using tests::bytes_of;

std::string binary_stl() {
    std::string bytes = std::string(80, 's') + bytes_of(std::uint32_t{2});
    for (int triangle = 0; triangle < 2; ++triangle) {
        for (int i = 0; i < 12; ++i)
            bytes += bytes_of(static_cast<float>((i * 5 + triangle) % 7));
        bytes += std::string(2, '\0');
    }
    return bytes;
}

std::string binary_ply() {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                        "property double z\nelement face 2\nproperty list uint int vertex_indices\nend_header\n";
    for (int i = 0; i < 9; ++i)
        bytes += bytes_of(static_cast<double>(i * 5 % 7));
    for (int face = 0; face < 2; ++face) {
        bytes += bytes_of(std::uint32_t{3});
        for (const int index : {0, 1, 2})
            bytes += bytes_of(index);
    }
    return bytes;
}

constexpr const char* two_triangles_3mf =
    R"(<model><resources><object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/>
<vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh>
</object></resources><build><item objectid="1"/><item objectid="1" transform="2 0 0 0 1 0 0 0 1 0 0 0"/></build></model>)";

constexpr const char* two_triangles_gltf = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"mesh": 0}, {"mesh": 0, "scale": [2, 1, 1]}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36)";

constexpr const char* two_triangles_collada = R"(<COLLADA><library_geometries><geometry id="g"><mesh><source id="p">
<float_array count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor count="3" stride="3"/></technique_common>
</source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="2">
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 2 1 0</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
</COLLADA>)";

// The samples of formats with nodes.
std::vector<Sample> scene_samples() {
    std::string triangle;
    for (const float x : {0, 0, 0, 1, 0, 0, 0, 1, 0})
        triangle += bytes_of(x);
    const std::string embedded = R"(, "uri": "data:;base64,)" + tests::base64(triangle) + R"("}]})";
    std::string gltf(two_triangles_gltf);
    gltf.append("}]}"); // GCC 12 warns of "+" here
    return {{"GLB", [](std::string_view bytes) { return merged(read_gltf(bytes)); }, tests::glb(gltf, triangle)},
            {"glTF", [](std::string_view bytes) { return merged(read_gltf(bytes)); }, two_triangles_gltf + embedded},
            {"COLLADA", [](std::string_view bytes) { return merged(read_collada(bytes)); }, two_triangles_collada},
            {"3MF", [](std::string_view bytes) { return merged(read_3mf(bytes)); }, tests::threemf(two_triangles_3mf)}};
}

std::vector<Sample> samples() {
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    std::vector<Sample> samples = scene_samples();
    const std::vector<Sample> plain = {
        {"OBJ", read_obj, "# part\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nvn 0 0 1\nf 1/1 2/1 3/1\nf -1 \\\n -2 -3\n"},
        {"OFF", read_off, "OFF # part\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0 255 0 0\n"},
        {"PLY", read_ply,
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
         "face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n"},
        {"binary PLY", read_ply, binary_ply()},
        {"STL", read_stl, "solid part\n" + facet + facet + "endsolid part\n"},
        {"binary STL", read_stl, binary_stl()}};
    samples.insert(samples.end(), plain.begin(), plain.end());
    return samples;
}

enum class Outcome : std::uint8_t { refused, read };

// Fails the test if the reader does neither.
Outcome outcome_of(const Sample& sample, const std::string& bytes) {
    try {
        const PolygonSoup soup = sample.read(bytes);
        for (const Eigen::Vector3d& vertex : soup.vertices)
            EXPECT_TRUE(vertex.allFinite()) << sample.name;
        for (const auto& face : soup.faces)
            for (const std::uint32_t vertex : face)
                EXPECT_LT(vertex, soup.vertices.size()) << sample.name;
        return Outcome::read;
    } catch (const InvalidInput& error) {
        EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << sample.name;
        return Outcome::refused;
    }
}

TEST(BrokenFiles, GoodSamplesAreRead) {
    for (const Sample& sample : samples())
        EXPECT_EQ(sample.read(sample.bytes).faces.size(), 2U) << sample.name;
}

// The beginning of a file may be a valid file. It may then have fewer faces only if its format has neither a count nor
// an end mark.
TEST(BrokenFiles, CutFilesAreRefusedWhereTheFormatCanTell) {
    for (const Sample& sample : samples()) {
        // ASCII STL may end after any facet.
        const bool has_end = std::string_view(sample.name) != "OBJ" && std::string_view(sample.name) != "STL";
        for (std::size_t size = 0; size + 1 < sample.bytes.size(); ++size) {
            const std::string part = sample.bytes.substr(0, size);
            const bool is_complete = outcome_of(sample, part) == Outcome::read && !sample.read(part).faces.empty();
            const bool lost_only_the_end = sample.bytes.size() - size < 12; // of a title, a colour, a line
            EXPECT_TRUE(!has_end || !is_complete || lost_only_the_end) << sample.name << " cut to " << size;
        }
    }
}

std::string damaged(std::string bytes, std::mt19937& random) {
    const std::size_t changes = 1 + random() % 3;
    for (std::size_t i = 0; i < changes; ++i) {
        const std::size_t at = random() % bytes.size();
        if (random() % 4 == 0)
            bytes.erase(at, random() % 5);
        else
            bytes[at] = static_cast<char>(random() % 3 == 0 ? random() : "0123456789 -.e\n/"[random() % 16]);
        if (bytes.empty())
            bytes.push_back(' ');
    }
    return bytes;
}

TEST(BrokenFiles, DamagedFilesAreReadOrRefused) {
    constexpr int rounds = 4000;
    for (const Sample& sample : samples()) {
        std::mt19937 random(7);
        int refused = 0;
        for (int i = 0; i < rounds; ++i)
            refused += outcome_of(sample, damaged(sample.bytes, random)) == Outcome::refused;
        EXPECT_GT(refused, rounds / 20) << sample.name << ": the damage almost never matters";
        EXPECT_LT(refused, rounds) << sample.name << ": the damage is always fatal";
    }
}

} // namespace
} // namespace chasles::io
