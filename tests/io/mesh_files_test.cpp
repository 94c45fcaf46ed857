// Files: the extension selects the reader, and every error names the file.
#include "chasles/io/mesh_files.h"
#include "chasles/mesh/polyhedron_parts.h"
#include "tests/io/message_of.h"
#include "tests/io/post_files.h"

#include <fmt/format.h>

namespace chasles {
namespace {

using tests::message_of;
using Face = std::vector<std::uint32_t>;

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
    EXPECT_EQ(
        message("points.obj", "v 0 0 0\n"),
        "points.obj: has no face; a mesh needs at least one. As a cloud of points, the key \"points\" of a scene file "
        "or, in Python, load_points reads it");
    EXPECT_EQ(
        message("cloud.pcd", "FIELDS x y z\n"),
        "cloud.pcd: is a cloud of points, not a mesh; the key \"points\" of a scene file or, in Python, load_points "
        "reads it");
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

/// Newcomers give the file of a robot to the commands for meshes.
TEST_F(MeshFiles, NameWhatReadsFilesOfRobots) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"a.urdf", "`chasles robot` or, in Python, `Robot.load` reads it"},
        {"a.URDF", "`chasles robot`"},
        {"a.xacro", "xacro FILE > robot.urdf"},
        {"a.urdf.xacro", "xacro FILE > robot.urdf"},
        {"a.srdf", "--srdf FILE"},
        {"a.sdf", "files of SDF (SDFormat) are not read"},
        {"a.xml", "is a robot, not a mesh: name it .urdf; `chasles robot` or, in Python, `Robot.load` reads it"},
        {"a.mjcf", "models of MuJoCo (MJCF) are not read"},
        {"a.yaml", "--path FILE"},
        {"a.yml", "--path FILE"},
    };
    for (const auto& [name, way_out] : cases) {
        EXPECT_TRUE(message(name, "<robot/>").starts_with(name + ": ")) << message(path(name));
        EXPECT_NE(message(name, "<robot/>").find(way_out), std::string::npos) << message(path(name));
    }
}

/// The root element says which program's model it is.
TEST_F(MeshFiles, TellRobotsInXmlFromModelsOfMuJoCo) {
    for (const char* const text :
         {"<?xml version='1.0'?>\n<!-- <mujoco> -> -->\n<robot name='a'>", "<robot\n name='a'>"})
        EXPECT_NE(message("a.xml", text).find("name it .urdf"), std::string::npos) << text;
    for (const char* const text :
         {"<mujoco><!-- <robot/> --></mujoco>", "<!-- <robot/> --><mujoco/>", "<robots/>", "<!--", "<"})
        EXPECT_NE(message("a.xml", text).find("models of MuJoCo (MJCF) are not read"), std::string::npos) << text;
}

TEST_F(MeshFiles, NamesWhatIsReadForOtherFormats) {
    for (const char* const name : {"a.fbx", "a.3ds", "a.x"})
        EXPECT_EQ(message(name, "x"), std::string(name) + ": no reader for the extension '" + (name + 1) +
                                          "'; .obj, .off, .ply, .stl, .gltf, .glb, .dae, .3mf, .bt and .ot are read: "
                                          "export the mesh as glTF, 3MF, STL or OBJ");
    EXPECT_TRUE(message("broken.gltf", "{").starts_with("broken.gltf: is no well-formed JSON: "));
    EXPECT_TRUE(message("broken.dae", "<COLLADA").starts_with("broken.dae: line 1: is no well-formed XML"));
    EXPECT_TRUE(message("broken.3mf", "x").starts_with("broken.3mf: is no ZIP archive"));
    EXPECT_EQ(message("empty.gltf", R"({"asset": {"version": "2.0"}})"),
              "empty.gltf: has no face; a mesh needs at least one");
}

TEST_F(MeshFiles, TellsStepFromIfcWhateverTheExtension) {
    const std::string start = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA((\"";
    const std::string is_step =
        ": is a STEP file, which holds curved surfaces, not polygons; export it as glTF, 3MF, STL "
        "or OBJ, or ask `chasles cad` (pip install \"chasles[cad]\"), which tessellates it with a bound";
    for (const char* const name : {"a.step", "a.STP", "a.obj", "a.p21"})
        EXPECT_EQ(message(name, start + "AUTOMOTIVE_DESIGN\"));\n#1=IFCWALL();"), name + is_step);
    EXPECT_EQ(message("a.ifc", start + "IFC4\"));"),
              "a.ifc: is an IFC file (a building model), which holds curved surfaces, not polygons; export it as glTF, "
              "3MF, STL or OBJ");
    EXPECT_TRUE(message("b.step", "v 0 0 0\n").starts_with("b.step: is no STEP file, though its extension says so"));
}

TEST_F(MeshFiles, NamesTheFormatOfAFileWithAnotherExtension) {
    for (const char* const name : {"a.stl", "a.obj", "a.ply", "a.dae", "a.fbx", "a.glb", "a.gltf"})
        EXPECT_EQ(message(name, "PK\x03\x04 and more"),
                  std::string(name) + ": is a ZIP archive; unpack it first, or name it .3mf if it is one");
    for (const char* const name : {"a.stl", "a.obj", "a.3mf", "a.glb", "a.off"})
        EXPECT_EQ(message(name, "\x1F\x8B\x08"), std::string(name) + ": is compressed by gzip; unpack it first");
    for (const char* const name : {"a.stl", "a.obj", "a.dae", "a.bin"})
        EXPECT_EQ(message(name, "glTF\x02"), std::string(name) + ": is a binary glTF file; name it .glb");
}

TEST_F(MeshFiles, PartsKeepTheirNamesAndErrorsNameThem) {
    const std::vector<NamedPolyhedron> parts = load_parts(write(
        "two.gltf", tests::post_gltf_json(R"(, "uri": "data:;base64,)" + tests::base64(tests::post_buffer()) + "\"")));
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].name, "post");
    write("post.bin", tests::post_buffer());
    EXPECT_EQ(Polyhedron::load(write("beside.gltf", tests::post_gltf_json(R"(, "uri": "post.bin")"))).face_count(),
              12U);
    EXPECT_EQ(message("missing.gltf", tests::post_gltf_json(R"(, "uri": "no.bin")")),
              "missing.gltf: no.bin: no such file");
    const std::string bent = tests::threemf(R"(<model><resources><object id="1" name="far"><mesh><vertices>
<vertex x="0" y="0" z="0"/><vertex x="1e31" y="0" z="0"/><vertex x="0" y="1e31" z="0"/></vertices>
<triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object></resources><build><item objectid="1"/></build></model>)");
    const std::filesystem::path file = write("far.3mf", bent);
    EXPECT_TRUE(without_folder(message_of([&] { (void)load_parts(file); })).starts_with("far.3mf: part 'far': "));
    EXPECT_EQ(load_parts(write("a.b.obj", triangle)).at(0).name, "a.b");
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
