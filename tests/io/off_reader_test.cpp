// OFF: the variants of the header are read, and counts that disagree with the data are refused.
#include "chasles/io/mesh_files.h"
#include "tests/io/message_of.h"

#include <bit>

namespace chasles::io {
namespace {

using tests::message_of;
using Face = std::vector<std::uint32_t>;

const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string message(const std::string& text) {
    return message_of([&] { (void)read_off(text); });
}

TEST(ReadOff, ReadsTheVariantsOfItsHeader) {
    for (const char* const header : {"OFF\n3 1 0\n", "OFF 3 1 0\n", "3 1 0\n", "OFF\n3 1\n", "OFF\r\n3 1 0\r\n",
                                     "# made by hand\nOFF # format\n\n# counts\n3 1 0\n\n", "COFF\n3 1 0\n"}) {
        const PolygonSoup soup = read_off(header + body);
        EXPECT_EQ(soup.vertices.size(), 3U) << header;
        EXPECT_EQ(soup.faces, (std::vector<Face>{{0, 1, 2}})) << header;
    }
}

TEST(ReadOff, ReadsCommentsColoursAndPolygons) {
    const PolygonSoup soup =
        read_off("COFF\n4 2 0\n0 0 0 255 0 0 255 # red\n1 0 0 1 1 1 1\n\n1 1 0\n0 1 0\n4 0 1 2 3 0.5 0.5 0.5\n# last\n"
                 "3 0 1 2 7\n# end\n");
    EXPECT_EQ(soup.faces, (std::vector<Face>{{0, 1, 2, 3}, {0, 1, 2}}));
    EXPECT_EQ(soup.face_lines, (std::vector<std::size_t>{8, 10}));
}

TEST(ReadOff, KeepsDoublesToTheBit) {
    const PolygonSoup soup = read_off("OFF\n3 1 0\n0.1 1e-320 -0\n0.30000000000000004 1e300 2.5e-17\n0 1 0\n3 0 1 2\n");
    EXPECT_EQ(std::bit_cast<std::uint64_t>(soup.vertices[0].x()), 0x3fb999999999999aU);
    EXPECT_EQ(soup.vertices[0].y(), 1e-320);
    EXPECT_TRUE(std::signbit(soup.vertices[0].z()));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(soup.vertices[1].x()), 0x3fd3333333333334U);
}

TEST(ReadOff, RefusesCountsThatDisagree) {
    EXPECT_EQ(message("OFF\n4 1 0\n0 0 0\n1 0 0\n"), "line 4: the file ends before vertex 2 of the 4 announced");
    EXPECT_EQ(message("OFF\n3 2 0\n" + body), "line 6: the file ends before face 1 of the 2 announced");
    EXPECT_EQ(message("OFF\n3 1 0\n" + body + "3 0 1 2\n"), "line 7: more lines than the header announces: '3 0 1 2'");
    EXPECT_EQ(message("OFF\n4000000000 1 0\n0 0 0\n"),
              "line 3: the file ends before vertex 1 of the 4000000000 announced");
}

TEST(ReadOff, RefusesBadHeaders) {
    EXPECT_EQ(message("# nothing\n"), "line 1: the file ends before its header");
    EXPECT_EQ(message("OFF\n"), "line 1: the file ends before the numbers of vertices and faces");
    EXPECT_EQ(message("OFF\n3\n"), "line 2: needs the numbers of vertices and faces: '3'");
    EXPECT_EQ(message("OFF\n-3 1 0\n"), "line 2: needs the numbers of vertices and faces: '-3 1 0'");
    EXPECT_EQ(message("OFF\n99999999999999999999 1 0\n"),
              "line 2: needs the numbers of vertices and faces: '99999999999999999999 1 0'");
    EXPECT_EQ(message("4OFF\n3 1 0\n"), "line 1: only three-dimensional OFF can be read, not '4OFF'");
    EXPECT_EQ(message("OFF BINARY\n"), "line 1: binary OFF cannot be read; convert it to ASCII");
}

TEST(ReadOff, RefusesBadVerticesAndFaces) {
    const std::string head = "OFF\n3 1 0\n";
    const std::string vertices = head + "0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_EQ(message(head + "0 0\n"), "line 3: a vertex needs three finite numbers: '0 0'");
    EXPECT_EQ(message(head + "0 inf 0\n"), "line 3: a vertex needs three finite numbers: '0 inf 0'");
    EXPECT_EQ(message(vertices + "3 0 1 3\n"),
              "line 6: vertex index 3 is out of range; there are 3 vertices, counted from 0");
    EXPECT_EQ(message(vertices + "3 0 1 -1\n"),
              "line 6: vertex index -1 is out of range; there are 3 vertices, counted from 0");
    EXPECT_EQ(message(vertices + "3 0 1.5 2\n"), "line 6: not a vertex index: '1.5' in '3 0 1.5 2'");
    EXPECT_EQ(message(vertices + "4 0 1 2\n"), "line 6: a face has fewer vertices than it announces: '4 0 1 2'");
    EXPECT_EQ(message(vertices + "4000000000 0 1 2\n"),
              "line 6: a face has fewer vertices than it announces: '4000000000 0 1 2'");
    EXPECT_EQ(message(vertices + "2 0 1\n"), "line 6: a face needs at least three vertices: '2 0 1'");
    EXPECT_EQ(message(vertices + "3 0 1 2 red\n"), "line 6: not a number: 'red' in '3 0 1 2 red'");
}

} // namespace
} // namespace chasles::io
