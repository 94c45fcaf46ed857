// OBJ: all statements of polygon files are read, and any invalid line is refused with its number.
#include "chasles/io/mesh_files.h"
#include "tests/io/message_of.h"

#include <bit>
#include <fmt/format.h>
#include <random>

namespace chasles::io {
namespace {

using tests::message_of;
using Face = std::vector<std::uint32_t>;

const std::string three_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string message(const std::string& text) {
    return message_of([&] { (void)read_obj(text); });
}

TEST(ReadObj, KeepsDoublesToTheBit) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> number(-1e3, 1e3);
    std::vector<Eigen::Vector3d> vertices;
    std::string text;
    for (int i = 0; i < 1000; ++i) {
        vertices.emplace_back(number(random), number(random), number(random));
        text += fmt::format("v {} {} {}\n", vertices[i].x(), vertices[i].y(), vertices[i].z());
    }
    const PolygonSoup soup = read_obj(text + "f 1 2 3\n");
    ASSERT_EQ(soup.vertices.size(), vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_EQ(std::bit_cast<std::uint64_t>(soup.vertices[i][axis]),
                      std::bit_cast<std::uint64_t>(vertices[i][axis]));
}

TEST(ReadObj, ReadsPolygonsAndTheirLines) {
    const PolygonSoup soup = read_obj(three_vertices + "v 1 1 0\n\nf 1 2 4 3\nf 1 2 3\n");
    EXPECT_EQ(soup.faces, (std::vector<Face>{{0, 1, 3, 2}, {0, 1, 2}}));
    EXPECT_EQ(soup.face_lines, (std::vector<std::size_t>{6, 7}));
}

TEST(ReadObj, ReadsEveryWayToNameAVertex) {
    for (const char* const face :
         {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/2 3/3/3", "f -3 -2 -1", "f -3/-3 -2/-2 -1/-1",
          "f\t1\t2\t3", "  f 1 2 3  ", "f 1 2 3 # corner", "f 1 2 3\r", "f 1 \\\n2 \\\n3", "fo 1 2 3"})
        EXPECT_EQ(read_obj(three_vertices + face + "\n").faces, (std::vector<Face>{{0, 1, 2}})) << face;
}

TEST(ReadObj, CountsNegativeIndicesFromTheLastVertexSoFar) {
    const PolygonSoup soup = read_obj(three_vertices + "f -3 -2 -1\n" + three_vertices + "f -3 -2 -1\n");
    EXPECT_EQ(soup.faces, (std::vector<Face>{{0, 1, 2}, {3, 4, 5}}));
}

TEST(ReadObj, ReadsFacesBeforeTheirVertices) {
    EXPECT_EQ(read_obj("f 1 2 3\n" + three_vertices).faces, (std::vector<Face>{{0, 1, 2}}));
}

TEST(ReadObj, LeavesOutWhatIsNoSurface) {
    const std::string extras = "# comment\nmtllib a.mtl\no part\ng group\ns off\nusemtl steel\nvt 0 0\nvn 0 0 1\nvp 1\n"
                               "l 1 2\np 1\n";
    EXPECT_EQ(read_obj(extras + three_vertices + extras + "f 1 2 3\n").faces.size(), 1U);
    EXPECT_EQ(read_obj("3 1\n" + three_vertices + "f 1 2 3\n").faces.size(), 1U) << "a line of counts at the start";
}

TEST(ReadObj, LeavesOutMaterialsInTheFile) {
    const std::string material = "newmtl steel\nKa 1 1 1\nKd .5 .5 .5\nKs 0 0 0\nNs 10\nNi 1\nd 1\nTr 0\nillum 2\n"
                                 "map_Kd steel.png\nmap_Bump -bm 1 rough.png\nbump rough.png\n";
    EXPECT_EQ(read_obj(material + three_vertices + "usemtl steel\nf 1 2 3\n").faces.size(), 1U);
    EXPECT_EQ(message("mapp 1\n"), "line 1: not an OBJ statement: 'mapp 1'");
}

TEST(ReadObj, LeavesOutExtensionsThatChangeNoPolygon) {
    const std::string extensions = "t crease 2/1/0 1 2 4.7\nt interpolateboundary 1/0/0 1\nvw 0 0 1.0 1 0.25\n"
                                   "vc 1 0.5 0\nusemat steel\n";
    EXPECT_EQ(read_obj(extensions + three_vertices + extensions + "f 1 2 3\n" + extensions).faces.size(), 1U);
    for (const char* const typing_error : {"tt 1\n", "vv 0 0 0\n", "V 0 0 0\n", "F 1 2 3\n"})
        EXPECT_TRUE(message(typing_error).starts_with("line 1: not an OBJ statement: '")) << typing_error;
}

TEST(ReadObj, ReadsVerticesWithWeightOrColour) {
    const PolygonSoup soup = read_obj("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv +.5 1. -1e-3\nf 1 2 3\n");
    EXPECT_EQ(soup.vertices[2], Eigen::Vector3d(0.5, 1, -1e-3));
}

TEST(ReadObj, RefusesBadVertices) {
    EXPECT_EQ(message("v 0 0\n"), "line 1: a vertex needs three finite numbers: 'v 0 0'");
    EXPECT_EQ(message("\nv 1 nan 0\n"), "line 2: a vertex needs three finite numbers: 'v 1 nan 0'");
    EXPECT_EQ(message("v 1 2 1e999\n"), "line 1: a vertex needs three finite numbers: 'v 1 2 1e999'");
    EXPECT_EQ(message("v 1 2 3x\n"), "line 1: a vertex needs three finite numbers: 'v 1 2 3x'");
    EXPECT_EQ(message("v 1 2 3 x\n"), "line 1: not a number: 'x' in 'v 1 2 3 x'");
    EXPECT_EQ(message("v 1,5 2 3\n"),
              "line 1: a vertex needs three finite numbers: 'v 1,5 2 3'; write a decimal point");
}

TEST(ReadObj, RefusesBadFaces) {
    EXPECT_EQ(message(three_vertices + "f 0 1 2\n"), "line 4: vertex index 0 in 'f 0 1 2'; OBJ counts from 1");
    EXPECT_EQ(message(three_vertices + "f 1 2 4\n"), "line 4: vertex index 4 is out of range; there are 3 vertices");
    EXPECT_EQ(message(three_vertices + "f 1 2 -4\n"),
              "line 4: vertex index -4 is out of range; there are 3 vertices so far");
    EXPECT_EQ(message(three_vertices + "f 1 2 99999999999\n"),
              "line 4: vertex index 99999999999 is out of range; there are 3 vertices");
    EXPECT_EQ(message(three_vertices + "f 1 2\n"), "line 4: a face needs at least three vertices: 'f 1 2'");
    EXPECT_EQ(message(three_vertices + "f 1 x 3\n"), "line 4: not a vertex of a face: 'x' in 'f 1 x 3'");
    EXPECT_EQ(message(three_vertices + "f 1.5 2 3\n"), "line 4: not a vertex of a face: '1.5' in 'f 1.5 2 3'");
    EXPECT_EQ(message(three_vertices + "f 1 2 \\"), "line 4: the file ends within a continued line");
}

TEST(ReadObj, RefusesWhatWouldLoseASurface) {
    EXPECT_EQ(message("surf 0 1 0 1 1 2 3\n"),
              "line 1: curved surfaces cannot be read, only polygons: 'surf 0 1 0 1 1 2 3'");
    EXPECT_EQ(message(three_vertices + "face 1 2 3\n"), "line 4: not an OBJ statement: 'face 1 2 3'");
    for (const std::string statement : {"call part.obj 1", "csh -make_part"})
        EXPECT_EQ(message(three_vertices + statement + "\n"), "line 4: other files and programs cannot be called: '" +
                                                                  statement + "'; put their faces into this file");
}

} // namespace
} // namespace chasles::io
