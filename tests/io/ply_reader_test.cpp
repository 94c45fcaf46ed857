// PLY: ASCII and both byte orders, any number types, elements in any order; broken headers and data are refused.
#include "chasles/io/mesh_files.h"
#include "tests/io/message_of.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace chasles::io {
namespace {

using tests::message_of;
using Face = std::vector<std::uint32_t>;

std::string message(const std::string& text) {
    return message_of([&] { (void)read_ply(text); });
}

std::string header(const std::string& format, const std::string& real, const std::string& length,
                   const std::string& index, int faces = 1) {
    return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex 3\nproperty " + real +
           " x\nproperty " + real + " y\nproperty " + real + " z\nelement face " + std::to_string(faces) +
           "\nproperty list " + length + " " + index + " vertex_indices\nend_header\n";
}

std::string ascii_header(int faces = 1) {
    return header("ascii", "double", "uchar", "int", faces);
}
const std::string ascii_vertices = "0 0 0\n1 0 0\n0 1 0\n";

template <typename Number>
std::string bytes_of(Number number, std::endian order) {
    const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    std::string bytes(raw.begin(), raw.end());
    if (order != std::endian::native)
        std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

template <typename Real, typename Length, typename Index>
std::string binary_data(std::endian order) {
    std::string data;
    for (const double number : {0.1, 0.0, 0.0, 1.0, 0.2, 0.0, 0.0, 1.0, 0.3})
        data += bytes_of(static_cast<Real>(number), order);
    data += bytes_of(static_cast<Length>(3), order);
    for (const int index : {2, 0, 1})
        data += bytes_of(static_cast<Index>(index), order);
    return data;
}

template <typename Real, typename Length, typename Index>
void expect_reads(const std::string& real, const std::string& length, const std::string& index) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const std::string format = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
        const PolygonSoup soup =
            read_ply(header(format, real, length, index) + binary_data<Real, Length, Index>(order));
        EXPECT_EQ(soup.vertices[0].x(), static_cast<double>(static_cast<Real>(0.1))) << format;
        EXPECT_EQ(soup.vertices[2].z(), static_cast<double>(static_cast<Real>(0.3))) << format;
        EXPECT_EQ(soup.faces, (std::vector<Face>{{2, 0, 1}})) << format;
        EXPECT_TRUE(soup.face_lines.empty());
    }
}

TEST(ReadPly, ReadsBinaryOfBothByteOrdersAndAllTypes) {
    expect_reads<double, std::uint8_t, std::int32_t>("double", "uchar", "int");
    expect_reads<float, std::uint8_t, std::uint32_t>("float", "uint8", "uint32");
    expect_reads<double, std::int32_t, std::uint16_t>("float64", "int32", "ushort");
    expect_reads<float, std::uint16_t, std::uint8_t>("float32", "uint16", "uchar");
    expect_reads<double, std::int8_t, std::int16_t>("double", "char", "short");
}

TEST(ReadPly, ReadsAsciiInFullPrecision) {
    const PolygonSoup soup = read_ply(ascii_header() + "0.1 1e-320 0\n1 0.30000000000000004 0\n0 1 0\n\n3 0 1 2\n");
    EXPECT_EQ(std::bit_cast<std::uint64_t>(soup.vertices[0].x()), 0x3fb999999999999aU);
    EXPECT_EQ(soup.vertices[0].y(), 1e-320);
    EXPECT_EQ(soup.vertices[1].y(), 0.30000000000000004);
    EXPECT_EQ(soup.face_lines, (std::vector<std::size_t>{15}));
}

TEST(ReadPly, ReadsOverOtherElementsAndProperties) {
    const PolygonSoup soup = read_ply("ply\r\nformat ascii 1.0\r\nobj_info none\r\nelement camera 1\r\nproperty list "
                                      "uchar float rays\r\nelement face 1\r\nproperty uchar red\r\nproperty list uchar "
                                      "int vertex_index\r\nelement vertex 3\r\nproperty float nx\r\nproperty int z\r\n"
                                      "property int y\r\nproperty int x\r\nend_header\r\n"
                                      "2 0.5 0.5\r\n255 3 0 1 2\r\n9 0 0 7\r\n9 1 2 3\r\n9 0 1 0\r\n");
    EXPECT_EQ(soup.vertices[1], Eigen::Vector3d(3, 2, 1));
    EXPECT_EQ(soup.faces, (std::vector<Face>{{0, 1, 2}}));
}

TEST(ReadPly, RefusesTruncatedAndOverlongData) {
    EXPECT_EQ(message(ascii_header(3) + ascii_vertices + "3 0 1 2\n"),
              "is truncated: the header announces 3 of the element 'face', but there are 1");
    EXPECT_EQ(message(ascii_header() + "0 0 0\n"),
              "is truncated: the header announces 3 of the element 'vertex', but there are 1");
    EXPECT_EQ(message(ascii_header() + ascii_vertices + "3 0 1 2\n3 0 1 2\n"),
              "line 15: more data than the header announces");
    const std::string binary = header("binary_little_endian", "double", "uchar", "int") +
                               binary_data<double, std::uint8_t, std::int32_t>(std::endian::little);
    EXPECT_EQ(message(binary.substr(0, binary.size() - 1)),
              "is truncated: the header announces 1 of the element 'face', but there are 0 and a part of the next one");
    EXPECT_EQ(
        message(binary.substr(0, binary.size() - 14)),
        "is truncated: the header announces 3 of the element 'vertex', but there are 2 and a part of the next one");
    EXPECT_EQ(message(binary.substr(0, binary.size() - 13)),
              "is truncated: the header announces 1 of the element 'face', but there are 0");
    EXPECT_EQ(message(binary + "x"), "more data than the header announces");
}

TEST(ReadPly, RefusesAbsurdCountsWithoutReservingMemory) {
    EXPECT_EQ(message(header("ascii", "double", "uint", "int") + ascii_vertices + "4000000000 0 1 2\n"),
              "line 14: has fewer numbers than the header announces: '4000000000 0 1 2'");
    EXPECT_EQ(message("ply\nformat ascii 1.0\nelement vertex 999999999999999999\nproperty float x\nproperty float y\n"
                      "property float z\nend_header\n1 2 3\n"),
              "is truncated: the header announces 999999999999999999 of the element 'vertex', but there are 1");
    EXPECT_EQ(message("ply\nformat ascii 1.0\nelement nothing 999999999999999999\nend_header\n"),
              "the element 'nothing' has no properties");
    EXPECT_EQ(message(header("ascii", "double", "char", "int") + ascii_vertices + "-3 0 1 2\n"),
              "line 14: the length of the list 'vertex_indices' is not a count");
}

TEST(ReadPly, RefusesBadNumbersAndIndices) {
    EXPECT_EQ(message(ascii_header() + "0 0 nan\n"), "line 11: vertex 0: NaN or infinity");
    EXPECT_EQ(message(ascii_header() + "0 0 x\n"), "line 11: not a number: 'x' in '0 0 x'");
    EXPECT_EQ(message(ascii_header() + "0 0 0 0\n"), "line 11: has more numbers than the header announces: '0 0 0 0'");
    EXPECT_EQ(message(ascii_header() + ascii_vertices + "3 0 1 3\n"),
              "line 14: vertex index 3 is out of range; there are 3 vertices, counted from 0");
    EXPECT_EQ(message(ascii_header() + ascii_vertices + "3 0 1 -1\n"),
              "line 14: face 0: a vertex index is not a whole number from 0");
    EXPECT_EQ(message(ascii_header() + ascii_vertices + "2 0 1\n"),
              "line 14: face 0: a face needs at least three vertices");
    std::string binary = header("binary_little_endian", "double", "uchar", "int") +
                         binary_data<double, std::uint8_t, std::int32_t>(std::endian::little);
    binary[binary.size() - 4] = 9;
    EXPECT_EQ(message(binary), "face 0: vertex index 9 is out of range; there are 3 vertices, counted from 0");
}

TEST(ReadPly, RefusesBadHeaders) {
    EXPECT_EQ(message("plx\n"), "line 1: a PLY file begins with the line 'ply'");
    EXPECT_EQ(message("ply\nformat ascii 1.0\n"), "line 2: the file ends before its 'end_header'");
    EXPECT_EQ(message("ply\nend_header\n"), "line 2: the header does not state its format");
    EXPECT_EQ(message("ply\nformat ascii 2.0\n"), "line 2: only version 1.0 of PLY is supported: 'format ascii 2.0'");
    EXPECT_EQ(message("ply\nformat text 1.0\n"), "line 2: not a PLY format: 'format text 1.0'");
    EXPECT_EQ(message("ply\nproperty float x\n"), "line 2: a property before the first element: 'property float x'");
    EXPECT_EQ(message("ply\nelement vertex -1\n"), "line 2: an element needs a name and a count: 'element vertex -1'");
    EXPECT_EQ(message("ply\nelement vertex 1\nproperty real x\n"),
              "line 3: not a PLY type: 'real' in 'property real x'");
    EXPECT_EQ(message("ply\nelement vertex 1\nelement vertex 1\n"),
              "line 3: a second element with the same name: 'element vertex 1'");
    EXPECT_EQ(message("ply\nfromat ascii 1.0\n"), "line 2: not a statement of a PLY header: 'fromat ascii 1.0'");
    EXPECT_EQ(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"),
              "the element 'vertex' needs the properties x, y and z");
    EXPECT_EQ(message("ply\nformat ascii 1.0\nelement face 1\nproperty float area\nend_header\n0\n"),
              "the element 'face' needs the list vertex_indices");
    EXPECT_EQ(message("ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"),
              "triangle strips (the element 'tristrips') are not read; save the mesh with faces");
}

} // namespace
} // namespace chasles::io
