// Text files may begin with the byte order mark of UTF-8. Binary STL files may begin with any bytes.
#include "chasles/io/mesh_files.h"
#include "chasles/io/text_scan.h"
#include "tests/io/message_of.h"

#include <array>
#include <bit>

namespace chasles::io {
namespace {

const std::string mark = "\xEF\xBB\xBF";
const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string stl = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                        "endfacet\nendsolid\n";

TEST(ByteOrderMark, OfTextIsLeftOut) {
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(read_obj(mark + obj).vertices.size(), 3U);
    EXPECT_EQ(read_obj(mark + obj).face_lines.front(), 4U);
    EXPECT_EQ(read_off(mark + off).faces.size(), 1U);
    EXPECT_EQ(read_ply(mark + ply).faces.size(), 1U);
    EXPECT_EQ(read_stl(mark + stl).faces.size(), 1U);
}

TEST(ByteOrderMark, OccursOnce) {
    EXPECT_TRUE(
        tests::message_of([] { (void)read_obj(mark + mark + obj); }).starts_with("line 1: not an OBJ statement"));
}

TEST(ByteOrderMark, OfOtherEncodingsIsRefused) {
    using namespace std::string_view_literals;
    for (const std::string_view bytes : {"\xFF\xFEv\0 \0"sv, "\xFE\xFF\0v\0 "sv, "\0\0\xFE\xFF\0\0\0v"sv})
        for (const auto read : {read_obj, read_off, read_ply, read_stl})
            EXPECT_EQ(tests::message_of([&] { (void)read(bytes); }), "is text in UTF-16 or UTF-32; save it as UTF-8");
}

TEST(ByteOrderMark, MayBeginTheHeaderOfBinaryStl) {
    for (const std::string_view start : {"\xEF\xBB\xBF", "\xFF\xFE"}) {
        std::string bytes(134, '\0');
        bytes.replace(0, start.size(), start);
        bytes[80] = 1;
        for (const std::size_t corner : {1U, 2U}) { // (1, 0, 0) and (0, 1, 0)
            const auto one = std::bit_cast<std::array<char, 4>>(1.0F);
            bytes.replace(84 + 12 + 12 * corner + 4 * (corner - 1), 4, one.data(), 4);
        }
        EXPECT_EQ(read_stl(bytes).vertices.size(), 3U);
    }
}

} // namespace
} // namespace chasles::io
