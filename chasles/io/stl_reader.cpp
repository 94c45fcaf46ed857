// Reads ASCII and binary STL. Equal vertices are merged: vertex ids follow the order of first occurrence.
// The normals in the file are ignored.
#include "chasles/base/invalid_input.h"
#include "chasles/io/bytes.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <unordered_map>

namespace chasles::io {
namespace {

constexpr std::size_t header_size = 84;   ///< bytes: 80 of any content and the number of triangles
constexpr std::size_t triangle_size = 50; ///< bytes

// The bits of a vertex, for comparison and hashing.
using Key = std::array<std::uint64_t, 3>;

struct HashKey {
    std::size_t operator()(const Key& key) const {
        std::uint64_t hash = 0;
        for (const std::uint64_t bits : key)
            hash = (std::rotl(hash, 23) ^ bits) * 0x9e3779b97f4a7c15u;
        return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
};

/// Collects triangles and gives equal vertices one number.
class MergedTriangles {
public:
    // The id of a vertex. Equal coordinates give one id.
    std::uint32_t add_vertex(const Eigen::Vector3d& vertex) {
        const Key key = {bits(vertex.x()), bits(vertex.y()), bits(vertex.z())};
        const auto [place, is_new] = ids_.try_emplace(key, static_cast<std::uint32_t>(soup_.vertices.size()));
        if (is_new)
            soup_.vertices.push_back(vertex);
        return place->second;
    }

    /// Adds a face. If two of its corners are equal, the second corner becomes a new vertex. The mesh layer then
    /// decides about faces that collapse when equal vertices are merged (docs/decisions/0011).
    void add_face(std::vector<std::uint32_t> face) {
        for (std::size_t i = 1; i < face.size(); ++i) {
            if (std::find(face.begin(), face.begin() + std::ptrdiff_t(i), face[i]) == face.begin() + std::ptrdiff_t(i))
                continue;
            const Eigen::Vector3d again = soup_.vertices[face[i]];
            face[i] = static_cast<std::uint32_t>(soup_.vertices.size());
            soup_.vertices.push_back(again);
        }
        soup_.faces.push_back(std::move(face));
    }
    void add_line(std::size_t line) { soup_.face_lines.push_back(line); }
    PolygonSoup take() { return std::move(soup_); }

private:
    // Equal numbers have equal bits: adding 0 turns -0 into 0.
    static std::uint64_t bits(double number) { return std::bit_cast<std::uint64_t>(number + 0.0); } // -0 equals 0

    std::unordered_map<Key, std::uint32_t, HashKey> ids_;
    PolygonSoup soup_;
};

// Whether a line that begins with this word is a comment. STL has none, but writers put some before the first solid.
bool is_comment(std::string_view word) {
    return word.starts_with('#') || word.starts_with("//") || word.starts_with(';');
}

/// Reads "solid NAME", then any number of "facet normal X Y Z, outer loop, vertex X Y Z (three times), endloop,
/// endfacet", then "endsolid NAME". Blanks and line ends separate words. A name extends to the end of its line. Writers
/// also end a solid by "endsolidNAME", by "end solid NAME", by the next "solid", or by the end of the file after a
/// facet; and they write "end loop" and "end facet". Lines of comment may come before the first solid.
class AsciiStlReader {
public:
    explicit AsciiStlReader(std::string_view text) : lines_(text) {}

    // Reads all solids of the file.
    PolygonSoup read() {
        bool has_word = next_word();
        while (has_word && is_comment(word_)) {
            words_ = Words("");
            has_word = next_word();
        }
        while (has_word) {
            expect("solid");
            has_word = read_solid();
        }
        return triangles_.take();
    }

private:
    // Moves to the next word of the file. Returns false at the end.
    bool next_word() {
        word_ = words_.next();
        while (word_.empty()) {
            if (!lines_.next())
                return false;
            words_ = Words(lines_.line());
            word_ = words_.next();
        }
        return true;
    }

    // Reads the facets of a solid and its end. Returns false at the end of the file; otherwise the current word is the
    // first one after the solid.
    bool read_solid() {
        words_ = Words("");
        require_word("endsolid");
        while (!is_end_of_solid()) {
            expect("facet");
            read_facet();
            if (!next_word())
                return false;
        }
        if (lower_case(word_) != "solid") {
            words_ = Words("");
            return next_word();
        }
        return true;
    }

    // Whether the current word ends a solid or begins the next one.
    [[nodiscard]] bool is_end_of_solid() const {
        const std::string word = lower_case(word_);
        return word.starts_with("endsolid") || word == "solid" ||
               (word == "end" && lower_case(Words(words_).next()) == "solid");
    }

    // Reads one facet and skips its normal.
    void read_facet() {
        const std::size_t line = lines_.number();
        require("normal");
        for (int i = 0; i < 3; ++i)
            require_word("normal");
        require("outer");
        require("loop");
        std::vector<std::uint32_t> face(3);
        for (std::uint32_t& vertex : face)
            vertex = read_vertex();
        require_end("loop");
        require_end("facet");
        triangles_.add_face(std::move(face));
        triangles_.add_line(line);
    }

    // Reads "vertex X Y Z".
    std::uint32_t read_vertex() {
        require("vertex");
        Eigen::Vector3d vertex;
        for (double& coordinate : vertex) {
            require_word("vertex");
            const auto number = parse_finite(word_);
            if (!number)
                fail("a vertex needs three finite numbers: " + in_quotes(lines_.line()) +
                     decimal_comma_hint(lines_.line()));
            coordinate = *number;
        }
        return triangles_.add_vertex(vertex);
    }

    // Reads "endKEYWORD" or "end KEYWORD".
    void require_end(const std::string& keyword) {
        require_word("end" + keyword);
        if (lower_case(word_) == "end")
            require(keyword);
        else
            expect("end" + keyword);
    }

    // Reads a word that must be the given keyword.
    void require(std::string_view keyword) {
        require_word(keyword);
        expect(keyword);
    }

    // Moves to the next word, or fails with the missing keyword.
    void require_word(std::string_view wanted) {
        if (!next_word())
            fail("the file ends before its '" + std::string(wanted) + "'");
    }

    // Fails unless the current word is the keyword. Case does not matter.
    void expect(std::string_view keyword) const {
        if (lower_case(word_) != keyword)
            fail("expected '" + std::string(keyword) + "', found " + in_quotes(lines_.line()));
    }

    [[noreturn]] void fail(const std::string& why) const { fail_at_line(lines_.number(), why); }

    Lines lines_;
    Words words_{""};
    std::string_view word_;
    MergedTriangles triangles_;
};

// The number of triangles in the header of a binary file.
std::size_t announced_triangles(std::string_view bytes) {
    return load<std::uint32_t>(bytes.substr(80), std::endian::little);
}

// Reads three floats, which must be finite.
Eigen::Vector3d read_binary_vertex(std::string_view bytes, std::size_t triangle) {
    Eigen::Vector3d vertex;
    for (int axis = 0; axis < 3; ++axis) {
        vertex[axis] = load<float>(bytes.substr(4 * static_cast<std::size_t>(axis)), std::endian::little);
        if (!std::isfinite(vertex[axis]))
            throw InvalidInput("triangle " + std::to_string(triangle) + ": NaN or infinity");
    }
    return vertex;
}

// Whether the header is words. That of a binary file has its number of triangles, and no file has so many that all four
// bytes are letters.
bool has_text_header(std::string_view bytes) {
    const std::string_view header = bytes.substr(0, header_size);
    const auto is_control = [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
    };
    return !Words(header).next().empty() && std::ranges::none_of(header, is_control);
}

// Refuses a binary file that has less, or by a triangle or more, than its number of triangles needs.
void check_binary_size(std::string_view bytes) {
    if (has_text_header(bytes))
        throw InvalidInput("is text, but does not begin with 'solid', so it is no STL file: " +
                           in_quotes(Words(bytes).next()) + " comes first");
    if (bytes.size() < header_size)
        throw InvalidInput("too short for an STL file");
    const std::size_t announced = announced_triangles(bytes);
    const std::size_t present = (bytes.size() - header_size) / triangle_size;
    const std::string counts = std::to_string(announced) + " triangles are announced, but ";
    if (present < announced)
        throw InvalidInput("is truncated: " + counts + std::to_string(present) + " are present");
    // What is shorter than a triangle hides none: some writers append attributes or fill up a block.
    const std::size_t end = header_size + announced * triangle_size;
    if (bytes.size() - end >= triangle_size)
        throw InvalidInput(counts + "the file has " + std::to_string(bytes.size() - end) +
                           " additional bytes, which may be triangles; export it again, or cut the file after byte " +
                           std::to_string(end) + " if they are none");
}

// Reads all triangles of a binary file.
PolygonSoup read_binary_stl(std::string_view bytes) {
    check_binary_size(bytes);
    MergedTriangles triangles;
    for (std::size_t i = 0; i < announced_triangles(bytes); ++i) {
        const std::string_view triangle = bytes.substr(header_size + i * triangle_size, triangle_size);
        std::vector<std::uint32_t> face;
        for (std::size_t corner = 0; corner < 3; ++corner)
            face.push_back(triangles.add_vertex(read_binary_vertex(triangle.substr(12 + 12 * corner), i)));
        triangles.add_face(std::move(face));
    }
    return triangles.take();
}

// Whether the size of the file matches the number of triangles in its header. The 80 bytes before may be any bytes.
bool has_binary_size(std::string_view bytes) {
    return bytes.size() >= header_size && bytes.size() == header_size + announced_triangles(bytes) * triangle_size;
}

// Whether the first line that is neither blank nor a comment begins with "solid".
bool begins_with_solid(std::string_view text) {
    Lines lines(text);
    while (lines.next())
        if (const std::string_view word = Words(lines.line()).next(); !word.empty() && !is_comment(word))
            return lower_case(word) == "solid";
    return false;
}

// A binary file may also begin with "solid". A zero byte in its header identifies it.
bool is_ascii_stl(std::string_view bytes) {
    return bytes.substr(0, header_size).find('\0') == std::string_view::npos && begins_with_solid(bytes);
}

} // namespace

PolygonSoup read_stl(std::string_view text) {
    if (has_binary_size(text))
        return read_binary_stl(text);
    text = without_byte_order_mark(text);
    return is_ascii_stl(text) ? AsciiStlReader(text).read() : read_binary_stl(text);
}

} // namespace chasles::io
