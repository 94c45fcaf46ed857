// Reads ASCII OFF: a header line, the counts, one vertex per line, one polygon per line. The counts must be correct.
// The variants COFF, NOFF and STOFF are accepted; their colours, normals and texture coordinates are ignored.
#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <limits>
#include <string>

namespace chasles::io {
namespace {

// Reads header, vertices and faces in the order of the file.
class OffReader {
public:
    explicit OffReader(std::string_view text) : lines_(without_byte_order_mark(text)), text_size_(text.size()) {}

    PolygonSoup read() {
        read_header();
        soup_.vertices.reserve(bounded(vertex_count_));
        for (std::size_t i = 0; i < vertex_count_; ++i)
            read_vertex(i);
        soup_.faces.reserve(bounded(face_count_));
        for (std::size_t i = 0; i < face_count_; ++i)
            read_face(i);
        if (next_content())
            fail("more lines than the header announces: " + in_quotes(content_));
        return std::move(soup_);
    }

private:
    // Moves to the next line that is not blank after its comment is removed. Returns false at the end of the text.
    bool next_content() {
        while (lines_.next()) {
            content_ = lines_.line().substr(0, lines_.line().find('#'));
            if (!Words(content_).next().empty())
                return true;
        }
        return false;
    }

    // Moves to the next line with content, or fails with the missing part.
    void require_content(const std::string& wanted) {
        if (!next_content())
            fail("the file ends before " + wanted);
    }

    // The keyword "OFF" may be on a separate line, on the line of the counts, or missing.
    void read_header() {
        require_content("its header");
        Words words(content_);
        std::string_view word = words.next();
        if (word.ends_with("OFF")) {
            check_variant(word, words);
            word = words.next();
        }
        if (word.empty()) {
            require_content("the numbers of vertices and faces");
            words = Words(content_);
            word = words.next();
        }
        vertex_count_ = read_count(word);
        face_count_ = read_count(words.next());
    }

    // Refuses the variants with more or fewer than three dimensions, and binary files.
    void check_variant(std::string_view keyword, Words words) const {
        const bool is_known = keyword == "OFF" || keyword == "COFF" || keyword == "NOFF" || keyword == "CNOFF" ||
                              keyword == "STOFF" || keyword == "STCOFF" || keyword == "STNOFF" || keyword == "STCNOFF";
        if (!is_known)
            fail("only three-dimensional OFF can be read, not " + in_quotes(keyword));
        if (words.next() == "BINARY")
            fail("binary OFF cannot be read; convert it to ASCII");
    }

    // Reads a count below 2^32 - 1.
    std::size_t read_count(std::string_view word) const {
        const auto count = parse_integer(word);
        const bool is_valid = count && *count >= 0 && *count < std::numeric_limits<std::uint32_t>::max();
        if (!is_valid)
            fail("needs the numbers of vertices and faces: " + in_quotes(content_));
        return static_cast<std::size_t>(*count);
    }

    // Limits a count of the header: every vertex or face takes at least two bytes.
    std::size_t bounded(std::size_t count) const { return std::min(count, text_size_ / 2); }

    // Reads three coordinates and checks the attributes after them.
    void read_vertex(std::size_t index) {
        require_content("vertex " + std::to_string(index) + " of the " + std::to_string(vertex_count_) + " announced");
        Words words(content_);
        Eigen::Vector3d vertex;
        for (double& coordinate : vertex) {
            const auto number = parse_finite(words.next());
            if (!number)
                fail("a vertex needs three finite numbers: " + in_quotes(content_));
            coordinate = *number;
        }
        check_attributes(words);
        soup_.vertices.push_back(vertex);
    }

    // Reads the number of corners, the corners, and the attributes after them.
    void read_face(std::size_t index) {
        require_content("face " + std::to_string(index) + " of the " + std::to_string(face_count_) + " announced");
        Words words(content_);
        const auto corners = parse_integer(words.next());
        if (!corners || *corners < 3)
            fail("a face needs at least three vertices: " + in_quotes(content_));
        std::vector<std::uint32_t> face;
        for (std::int64_t i = 0; i < *corners; ++i)
            face.push_back(read_index(words.next()));
        check_attributes(words);
        soup_.faces.push_back(std::move(face));
        soup_.face_lines.push_back(lines_.number());
    }

    // Reads one vertex index, which must be below the number of vertices.
    std::uint32_t read_index(std::string_view word) const {
        if (word.empty())
            fail("a face has fewer vertices than it announces: " + in_quotes(content_));
        const auto index = parse_integer(word);
        if (!index)
            fail("not a vertex index: " + in_quotes(word) + " in " + in_quotes(content_) + decimal_comma_hint(word));
        if (*index < 0 || *index >= static_cast<std::int64_t>(vertex_count_))
            fail("vertex index " + std::to_string(*index) + " is out of range; there are " +
                 std::to_string(vertex_count_) + " vertices, counted from 0");
        return static_cast<std::uint32_t>(*index);
    }

    // Checks that the remaining words of a line, for example colours, are numbers.
    void check_attributes(Words words) const {
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            if (!parse_number(word))
                fail("not a number: " + in_quotes(word) + " in " + in_quotes(content_) + decimal_comma_hint(word));
    }

    [[noreturn]] void fail(const std::string& why) const {
        fail_at_line(std::max<std::size_t>(lines_.number(), 1), why);
    }

    Lines lines_;
    std::size_t text_size_;
    std::string_view content_;
    std::size_t vertex_count_ = 0;
    std::size_t face_count_ = 0;
    PolygonSoup soup_;
};

} // namespace

PolygonSoup read_off(std::string_view text) {
    return OffReader(text).read();
}

} // namespace chasles::io
