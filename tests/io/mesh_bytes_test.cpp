// Meshes from the content of files.
#include "chasles/io/mesh_bytes.h"

#include "tests/io/message_of.h"

#include <gtest/gtest.h>

namespace chasles::tests {
namespace {

constexpr const char* tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(MeshBytes, TheExtensionChoosesTheReaderInCapitalsToo) {
    for (const char* const name : {"a.obj", "A.OBJ", "folder/a.b.Obj"}) {
        EXPECT_EQ(io::read_polyhedron(tetrahedron, name).face_count(), 4U) << name;
        EXPECT_EQ(io::read_polygons(tetrahedron, name).vertices.size(), 4U) << name;
    }
    EXPECT_EQ(io::reader_for(".ply"), io::read_ply);
    EXPECT_EQ(io::reader_for(".stl"), io::read_stl);
    EXPECT_EQ(io::reader_for(".off"), io::read_off);
    EXPECT_EQ(io::reader_for(".glb"), nullptr);
}

TEST(MeshBytes, RefusalsNameTheFileTheLineAndTheReason) {
    const auto refusal = [](std::string_view bytes, const std::string& name) {
        return message_of([&] { (void)io::read_polyhedron(bytes, name); });
    };
    EXPECT_EQ(refusal(tetrahedron, "a.png"), "a.png: no reader for the extension '.png'; .obj, .off, .ply, .stl, .bt "
                                             "and .ot are read: export the mesh as OBJ, OFF, PLY or STL");
    EXPECT_TRUE(refusal(tetrahedron, "obj").starts_with("obj: no reader for the extension ''; .obj, "));
    EXPECT_EQ(refusal("", "a.obj"), "a.obj: is empty");
    EXPECT_TRUE(refusal("version https://git-lfs.github.com/spec/v1\n", "a.stl").starts_with("a.stl: is a Git LFS p"));
    EXPECT_TRUE(refusal("v 0 0 0\n", "a.obj").starts_with("a.obj: has no face; a mesh needs at least one"));
    EXPECT_TRUE(refusal("v 0 0 0\nv 1 x 0\n", "a.obj").starts_with("a.obj: line 2: "));
    const std::string bent = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n"; // refused by the mesh layer
    EXPECT_TRUE(refusal(bent, "a.obj").starts_with("a.obj: line 5: face 0: "));
    EXPECT_EQ(io::read_polyhedron(bent, "a.obj", {.triangulate = true}).face_count(), 2U);
}

TEST(MeshBytes, EveryWayOutLeadsToAFormatThatIsReadHere) {
    const std::string step = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA((\"";
    for (const std::string& bytes : {step + "AUTOMOTIVE_DESIGN\"));", step + "IFC4\"));", std::string("glTF\x02"),
                                     std::string("PK\x03\x04"), std::string(tetrahedron)})
        for (const char* const name : {"a.step", "a.ifc", "a.stl", "a.glb", "a.gltf", "a.dae", "a.3mf", "a.fbx"}) {
            const std::string message = message_of([&] { (void)io::read_polyhedron(bytes, name); });
            const std::string way_out = message.substr(std::min(message.find("; "), message.size()));
            for (const char* const format : {".gltf", ".glb", ".dae", ".3mf", "glTF", "3MF"})
                EXPECT_EQ(way_out.find(format), std::string::npos) << message;
        }
    const auto refusal = [](const std::string& bytes, const char* name) {
        return message_of([&] { (void)io::read_polyhedron(bytes, name); });
    };
    EXPECT_EQ(
        refusal(step + "AUTOMOTIVE_DESIGN\"));", "a.step"),
        "a.step: is a STEP file, which holds curved surfaces, not polygons; export it as OBJ, OFF, PLY or STL, or "
        "ask `chasles cad` (pip install \"chasles[cad]\"), which tessellates it with a bound");
    EXPECT_EQ(refusal("v 0 0 0\n", "a.step"),
              "a.step: is no STEP file, though its extension says so; .obj, .off, .ply, "
              ".stl, .bt and .ot are read");
    EXPECT_EQ(refusal("glTF\x02", "a.stl"), "a.stl: is a binary glTF file; export it as OBJ, OFF, PLY or STL");
    EXPECT_EQ(refusal("PK\x03\x04", "a.stl"), "a.stl: is a ZIP archive; unpack it first");
}

// These readers are those of the npm package: it has no command line, no scene files and no robots.
TEST(MeshBytes, NoWayOutNamesWhatOtherPackagesHave) {
    const auto refusal = [](const std::string& bytes, const std::string& name) {
        return message_of([&] { (void)io::read_polyhedron(bytes, name); });
    };
    EXPECT_EQ(refusal("v 0 0 0\n", "a.obj"), "a.obj: has no face; a mesh needs at least one. As a cloud of points, "
                                             "chasles.points(points, radius) makes a body of its numbers");
    EXPECT_EQ(refusal("0 0 0\n", "a.xyz"), "a.xyz: is a cloud of points, not a mesh; chasles.points(points, radius) "
                                           "makes a body of its numbers");
    EXPECT_EQ(refusal("<robot/>", "a.urdf"),
              "a.urdf: is a robot, not a mesh; the command line or the Python package of Chasles reads it");
    for (const std::string name : {"a.obj", "a.off", "a.ply", "a.stl", "a.bt", "a.pcd", "a.xyz", "a.urdf", "a.xacro",
                                   "a.srdf", "a.sdf", "a.xml", "a.mjcf", "a.yaml", "a.yml", "a.glb", "a.fbx"})
        for (const std::string bytes : {"v 0 0 0\n", "OFF\n1 0 0\n0 0 0\n", "solid a\nendsolid a\n", "", "<robot/>"})
            for (const char* const other :
                 {"scene file", "load_points", "`chasles ", "chasles robot", "Robot.load", "--"})
                EXPECT_EQ(refusal(bytes, name).find(other), std::string::npos) << refusal(bytes, name);
}

} // namespace
} // namespace chasles::tests
