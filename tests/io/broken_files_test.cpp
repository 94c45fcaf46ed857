// For any bytes, a reader returns a soup with indices in range and finite coordinates, or throws InvalidInput with a
// message of one line. The test reads truncated and damaged versions of valid files, each from a fixed seed.
#include "chasles/io/mesh_files.h"
#include "tests/io/message_of.h"

#include <array>
#include <bit>
#include <random>

namespace chasles::io {
namespace {

struct Sample {
    const char* name;
    PolygonSoup (*read)(std::string_view);
    std::string bytes;
};

template <typename Number>
std::string bytes_of(Number number) {
    const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    return {raw.begin(), raw.end()};
}

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

std::vector<Sample> samples() {
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    return {{"OBJ", read_obj, "# part\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nvn 0 0 1\nf 1/1 2/1 3/1\nf -1 \\\n -2 -3\n"},
            {"OFF", read_off, "OFF # part\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0 255 0 0\n"},
            {"PLY", read_ply,
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
             "face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n"},
            {"binary PLY", read_ply, binary_ply()},
            {"STL", read_stl, "solid part\n" + facet + facet + "endsolid part\n"},
            {"binary STL", read_stl, binary_stl()}};
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
        const bool has_end = std::string_view(sample.name) != "OBJ";
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
