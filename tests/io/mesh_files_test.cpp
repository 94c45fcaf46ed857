// Files: the extension selects the reader, every error names the file, and Assimp reads other formats.
#include "chasles/io/mesh_files.h"
#include "chasles/mesh/polyhedron.h"
#include "tests/io/message_of.h"

#include <fmt/format.h>

namespace chasles {
namespace {

using tests::message_of;
using Face = std::vector<std::uint32_t>;

#ifdef CHASLES_TESTS_ASSIMP
constexpr bool has_assimp = true;
#else
constexpr bool has_assimp = false;
#endif

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class MeshFiles : public tests::FileTest {
protected:
    [[nodiscard]] std::string message(const std::filesystem::path& file) const {
        return without_folder(message_of([&] { (void)Polyhedron::load(file); }));
    }
    [[nodiscard]] std::string message(const std::string& name, const std::string& content) const {
        return message(write(name, content));
    }
};

TEST_F(MeshFiles, LoadsByExtensionWhateverItsCase) {
    EXPECT_EQ(Polyhedron::load(write("a.OBJ", triangle)).face_count(), 1U);
    EXPECT_EQ(Polyhedron::load(write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).face_count(), 1U);
}

TEST_F(MeshFiles, NamesFilesThatCannotBeRead) {
    EXPECT_EQ(message(path("no.obj")), "no.obj: no such file");
    std::filesystem::create_directory(path("folder.obj"));
    EXPECT_EQ(message(path("folder.obj")), "folder.obj: is a directory, not a file");
    EXPECT_EQ(message("empty.obj", ""), "empty.obj: is empty");
    EXPECT_EQ(message("blank.obj", "\n"), "blank.obj: has no face; a mesh needs at least one");
    EXPECT_EQ(message("points.obj", "v 0 0 0\n"), "points.obj: has no face; a mesh needs at least one");
    EXPECT_EQ(message("mesh", triangle).substr(0, 33), "mesh: no reader for the extension");
    EXPECT_EQ(message("mesh.txt", triangle).substr(0, 44), "mesh.txt: no reader for the extension '.txt'");
}

TEST_F(MeshFiles, NamesFileAndLineOfWhatCannotBeRead) {
    EXPECT_EQ(message("part.obj", "v 0 0 0\nv 1 nan 0\n"),
              "part.obj: line 2: a vertex needs three finite numbers: 'v 1 nan 0'");
    EXPECT_EQ(message("part.ply", "ply\n"), "part.ply: line 1: the file ends before its 'end_header'");
}

TEST_F(MeshFiles, NamesTheLineOfFacesThatTheMeshRefuses) {
    const std::string bent = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4\n";
    EXPECT_TRUE(message("bent.obj", bent).starts_with("bent.obj: line 5: face 0: ")) << message(path("bent.obj"));
    EXPECT_EQ(Polyhedron::load(path("bent.obj"), {.triangulate = true}).face_count(), 2U);
    const std::string tie = "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3 4\n";
    EXPECT_TRUE(message("tie.obj", tie).starts_with("tie.obj: line 6: face 1: has no area"))
        << message(path("tie.obj"));
    EXPECT_EQ(Polyhedron::load(path("tie.obj"), {.triangulate = true}).face_count(), 3U);
}

TEST_F(MeshFiles, PutsLineBreaksInNamesOnOneLine) {
    const std::string text = message_of([&] { (void)Polyhedron::load("no\nsuch\nfile.obj"); });
    EXPECT_EQ(text, "no such file.obj: no such file");
}

TEST_F(MeshFiles, ReadsGltfWithTheTransformsOfItsNodes) {
    if (!has_assimp)
        GTEST_SKIP() << "built without Assimp";
    const std::string gltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "translation": [10, 0, 0], "children": [2]}, {"mesh": 0},
                  {"mesh": 0, "scale": [2, 2, 2]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "buffers": [{"byteLength": 42, "uri": "data:application/octet-stream;base64,)"
                             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"
                             R"("}]})";
    const io::PolygonSoup soup = io::load_polygons(write("three.gltf", gltf));
    ASSERT_EQ(soup.faces.size(), 3U);
    EXPECT_EQ(soup.vertices[1], Eigen::Vector3d(11, 0, 0));
    EXPECT_EQ(soup.vertices[4], Eigen::Vector3d(12, 0, 0)) << "scaled below the moved node";
    EXPECT_EQ(soup.vertices[7], Eigen::Vector3d(1, 0, 0));
}

const char* const collada = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><translate>0 0 5</translate>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

TEST_F(MeshFiles, ReadsColladaWithItsPolygons) {
    if (!has_assimp)
        GTEST_SKIP() << "built without Assimp";
    const io::PolygonSoup soup = io::load_polygons(write("square.dae", collada));
    ASSERT_EQ(soup.faces.size(), 1U);
    EXPECT_EQ(soup.faces[0].size(), 4U) << "polygons are not cut";
    EXPECT_EQ(soup.vertices[soup.faces[0][2]], Eigen::Vector3d(1, 1, 5));
}

TEST_F(MeshFiles, NamesFilesThatAssimpCannotRead) {
    if (!has_assimp)
        GTEST_SKIP() << "built without Assimp";
    EXPECT_TRUE(message("broken.gltf", "{").starts_with("broken.gltf: cannot be read: "))
        << message(path("broken.gltf"));
    EXPECT_TRUE(message("broken.dae", "<COLLADA").starts_with("broken.dae: ")) << message(path("broken.dae"));
}

// A grid of 200 by 200 squares, twice as many triangles.
std::string large_obj() {
    std::string text;
    constexpr int n = 200;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            text += fmt::format("v {} {} {}\n", 0.1 * i, 0.1 * j, 0.01 * ((i * 7 + j * 3) % 11));
    for (int i = 0; i < n; ++i)
        for (int j = 1; j <= n; ++j) {
            const int corner = i * (n + 1) + j;
            text += fmt::format("f {} {} {}\nf {} {} {}\n", corner, corner + 1, corner + n + 1, corner + 1,
                                corner + n + 2, corner + n + 1);
        }
    return text;
}

TEST_F(MeshFiles, ReadsLargeFiles) {
    const io::PolygonSoup soup = io::load_polygons(write("large.obj", large_obj()));
    EXPECT_EQ(soup.vertices.size(), 201U * 201U);
    EXPECT_EQ(soup.faces.size(), 2U * 200U * 200U);
}

} // namespace
} // namespace chasles
