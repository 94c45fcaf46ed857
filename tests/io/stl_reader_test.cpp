// STL: the reader distinguishes ASCII from binary for any first bytes, merges equal vertices, and loses no data
// silently.
#include "chasles/io/mesh_files.h"
#include "chasles/mesh/polyhedron.h"
#include "tests/io/message_of.h"

#include <array>
#include <bit>
#include <limits>

namespace chasles::io {
namespace {

using tests::message_of;
using Face = std::vector<std::uint32_t>;

const std::string facet = "facet normal 0 0 1\n  outer loop\n    vertex 0 0 0\n    vertex 1 0 0\n    vertex 0 1 0\n"
                          "  endloop\nendfacet\n";

std::string message(const std::string& bytes) {
    return message_of([&] { (void)read_stl(bytes); });
}

// STL is little-endian, as is every machine that the tests run on.
template <typename Number>
std::string bytes_of(Number number) {
    const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    return {raw.begin(), raw.end()};
}

std::string binary_triangle(const std::array<float, 9>& corners) {
    std::string bytes(12, '\0');
    for (const float coordinate : corners)
        bytes += bytes_of(coordinate);
    return bytes + std::string(2, '\0');
}

std::string binary_stl(const std::string& title, std::uint32_t count, const std::string& triangles) {
    return (title + std::string(80, ' ')).substr(0, 80) + bytes_of(count) + triangles;
}

const std::string two_triangles =
    binary_triangle({0, 0, 0, 1, 0, 0, 0, 1, 0}) + binary_triangle({1, 0, 0, 1, 1, 0, 0, 1, 0});

TEST(ReadStl, FacetsThatCollapseAreLeftToTheMesh) {
    const std::string collapsed =
        "facet normal 0 0 1\n  outer loop\n    vertex 0 0 0\n    vertex 1 0 0\n    vertex 1 0 0\n"
        "  endloop\nendfacet\n";
    const PolygonSoup soup = read_stl("solid s\n" + facet + collapsed + "endsolid s\n");
    ASSERT_EQ(soup.faces.size(), 2u);
    EXPECT_EQ(soup.faces[1], (Face{0, 1, 3}));
    EXPECT_EQ(soup.vertices[3], soup.vertices[1]);
    EXPECT_EQ(Polyhedron::from_polygons(soup.vertices, soup.faces).report().dropped_faces, 1u);
}

TEST(ReadStl, ReadsAsciiAndMergesEqualVertices) {
    const std::string other =
        "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex -0 1.0 0e5\nendloop\nendfacet\n";
    const PolygonSoup soup = read_stl("solid a facet normal\n" + facet + other + "endsolid a facet normal\n");
    EXPECT_EQ(soup.vertices.size(), 4U);
    EXPECT_EQ(soup.faces, (std::vector<Face>{{0, 1, 2}, {1, 3, 2}}));
    EXPECT_EQ(soup.face_lines, (std::vector<std::size_t>{2, 9}));
}

TEST(ReadStl, ReadsAsciiInFullPrecision) {
    const PolygonSoup soup = read_stl("solid\nfacet normal nan nan nan outer loop vertex 0.1 0 0 vertex 1 0 0\n"
                                      "vertex 0 0.30000000000000004 0 endloop endfacet endsolid\n");
    EXPECT_EQ(std::bit_cast<std::uint64_t>(soup.vertices[0].x()), 0x3fb999999999999aU);
    EXPECT_EQ(soup.vertices[2].y(), 0.30000000000000004);
}

TEST(ReadStl, ReadsSeveralSolidsInCapitals) {
    const PolygonSoup soup = read_stl("\n SOLID a\r\n" + facet + "EndSolid\nsolid b\n" + facet + "endsolid b\n");
    EXPECT_EQ(soup.faces, (std::vector<Face>{{0, 1, 2}, {0, 1, 2}}));
}

TEST(ReadStl, ReadsBinaryWhateverItsTitle) {
    for (const char* const title : {"", "part", "solid part", "solid"}) {
        const PolygonSoup soup = read_stl(binary_stl(title, 2, two_triangles));
        EXPECT_EQ(soup.vertices.size(), 4U) << title;
        EXPECT_EQ(soup.faces, (std::vector<Face>{{0, 1, 2}, {1, 3, 2}})) << title;
        EXPECT_TRUE(soup.face_lines.empty());
    }
}

TEST(ReadStl, MergesMinusZeroWithZeroButNoNeighbours) {
    const float next = std::nextafterf(1.0F, 2.0F);
    const PolygonSoup soup = read_stl(binary_stl(
        "", 2, binary_triangle({0, 0, 0, 1, 0, 0, 0, 1, 0}) + binary_triangle({-0.0F, 0, 0, next, 0, 0, 0, 1, 0})));
    EXPECT_EQ(soup.faces, (std::vector<Face>{{0, 1, 2}, {0, 3, 2}}));
}

TEST(ReadStl, RefusesBinaryWhoseCountDisagrees) {
    EXPECT_EQ(message(binary_stl("", 3, two_triangles)), "is truncated: 3 triangles are announced, but 2 are present");
    EXPECT_EQ(message(binary_stl("solid", 4000000000U, two_triangles)),
              "is truncated: 4000000000 triangles are announced, but 2 are present");
    EXPECT_EQ(message(binary_stl("", 1, two_triangles)),
              "1 triangles are announced, but the file has 50 additional bytes, which may be triangles; export it "
              "again, or cut the file after byte 134 if they are none");
    EXPECT_EQ(message(binary_stl("", 2, two_triangles).substr(0, 60)), "too short for an STL file");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(message(binary_stl("", 1, binary_triangle({0, 0, 0, nan, 0, 0, 0, 1, 0}))),
              "triangle 0: NaN or infinity");
}

TEST(ReadStl, ReadsBinaryWithATailThatHidesNoTriangle) {
    for (const std::size_t tail : {1U, 16U, 49U})
        EXPECT_EQ(read_stl(binary_stl("", 2, two_triangles) + std::string(tail, 'x')).faces.size(), 2U) << tail;
}

TEST(ReadStl, CallsTextWithoutSolidText) {
    const std::string why = "is text, but does not begin with 'solid', so it is no STL file: ";
    EXPECT_EQ(message("<!DOCTYPE html>\n" + std::string(200, 'a')), why + "'<!DOCTYPE' comes first");
    EXPECT_EQ(message("<svg/>"), why + "'<svg/>' comes first");
    EXPECT_EQ(message("# a comment\n\tfacets\n" + facet), why + "'#' comes first");
}

TEST(ReadStl, ReadsCommentsBeforeTheFirstSolid) {
    const PolygonSoup soup =
        read_stl("# made by hand\n\n// " + std::string(100, '-') + "\n; solid\nsolid a\n" + facet + "endsolid a\n");
    EXPECT_EQ(soup.faces.size(), 1U);
    EXPECT_EQ(soup.face_lines, (std::vector<std::size_t>{6}));
}

TEST(ReadStl, RefusesBrokenAscii) {
    EXPECT_EQ(message("solid\n"), "line 1: the file ends before its 'endsolid'");
    EXPECT_EQ(message("solid\n" + facet.substr(0, 26)), "line 3: the file ends before its 'loop'");
    EXPECT_EQ(message("solid\nfacett normal 0 0 1\n"), "line 2: expected 'facet', found 'facett normal 0 0 1'");
    EXPECT_EQ(message("solid\n" + facet + "endsolid\n" + facet),
              "line 10: expected 'solid', found 'facet normal 0 0 1'");
    EXPECT_EQ(message("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n"),
              "line 4: a vertex needs three finite numbers: 'vertex 0 nan 0'");
    EXPECT_EQ(
        message("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n"),
        "line 7: expected 'endloop', found 'vertex 0 1 0'");
}

TEST(ReadStl, ReadsTheEndsThatWritersMake) {
    for (const char* const end : {"endsolidAssimpScene\n", "endsolid\n", "end solid x\n", "END SOLID\n", "", "\n \n"})
        EXPECT_EQ(read_stl("solid x\n" + facet + end).faces.size(), 1U) << end;
    EXPECT_EQ(read_stl("solid a\n" + facet + "endsolida\nsolid b\n" + facet).faces.size(), 2U);
    EXPECT_EQ(read_stl("solid a\n" + facet + "solid b\n" + facet + "end solid b").faces.size(), 2U);
    EXPECT_EQ(read_stl("solid a\nendsolid a\nsolid b\n" + facet + "endsolid b").faces.size(), 1U);
    std::string spaced = facet;
    spaced.replace(spaced.find("endloop"), 7, "end loop");
    spaced.replace(spaced.find("endfacet"), 8, "end facet");
    EXPECT_EQ(read_stl("solid x\n" + spaced + "end solid x").faces.size(), 1U);
    EXPECT_EQ(message("solid x\n" + facet + "end of solid"), "line 9: expected 'facet', found 'end of solid'");
}

} // namespace
} // namespace chasles::io
