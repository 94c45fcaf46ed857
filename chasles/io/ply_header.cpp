// Reads the header of a PLY file. Source: Greg Turk, "The PLY Polygon File Format", 1994, and the later type names with
// sizes (int8 to float64).
#include "chasles/io/ply_header.h"

#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>

namespace chasles::io {
namespace {

// A name of a number type.
struct TypeName {
    std::string_view name;
    PlyType type;
};

// Each type has an old name and a name with its size in bits.
constexpr std::array<TypeName, 16> type_names = {{{"char", PlyType::int8},
                                                  {"int8", PlyType::int8},
                                                  {"uchar", PlyType::uint8},
                                                  {"uint8", PlyType::uint8},
                                                  {"short", PlyType::int16},
                                                  {"int16", PlyType::int16},
                                                  {"ushort", PlyType::uint16},
                                                  {"uint16", PlyType::uint16},
                                                  {"int", PlyType::int32},
                                                  {"int32", PlyType::int32},
                                                  {"uint", PlyType::uint32},
                                                  {"uint32", PlyType::uint32},
                                                  {"float", PlyType::float32},
                                                  {"float32", PlyType::float32},
                                                  {"double", PlyType::float64},
                                                  {"float64", PlyType::float64}}};

// Reads the header line by line. It keeps statements in the order of the file, which is the order of the data.
class PlyHeaderReader {
public:
    explicit PlyHeaderReader(std::string_view text) : text_(text), lines_(text) {}

    // Reads all lines from "ply" to "end_header".
    PlyHeader read() {
        if (!lines_.next() || lines_.line() != "ply")
            fail_at_line(1, "a PLY file begins with the line 'ply'");
        do {
            if (!lines_.next())
                fail("the file ends before its 'end_header'");
        } while (read_statement());
        if (!has_format_)
            fail("the header does not state its format");
        header_.size = end_of_header();
        header_.lines = lines_.number();
        return std::move(header_);
    }

private:
    // After lines that end with CR alone, a LF is the first byte of binary data.
    [[nodiscard]] std::size_t end_of_header() const {
        const bool ends_with_cr = text_.starts_with("ply\r") && !text_.starts_with("ply\r\n");
        const bool has_taken_lf = text_.substr(0, lines_.position()).ends_with("\r\n");
        return lines_.position() - (ends_with_cr && has_taken_lf ? 1 : 0);
    }

    // Reads one line. Returns false at the end of the header.
    bool read_statement() {
        Words words(lines_.line());
        const std::string_view keyword = words.next();
        if (keyword == "end_header")
            return false;
        if (keyword == "format")
            read_format(words);
        else if (keyword == "element")
            read_element(words);
        else if (keyword == "property")
            read_property(words);
        else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info")
            fail("not a statement of a PLY header: " + in_quotes(lines_.line()));
        return true;
    }

    // Reads "format NAME 1.0".
    void read_format(Words words) {
        const std::string_view name = words.next();
        if (name == "ascii")
            header_.format = PlyFormat::ascii;
        else if (name == "binary_little_endian")
            header_.format = PlyFormat::little_endian;
        else if (name == "binary_big_endian")
            header_.format = PlyFormat::big_endian;
        else
            fail("not a PLY format: " + in_quotes(lines_.line()));
        if (words.next() != "1.0")
            fail("only version 1.0 of PLY is supported: " + in_quotes(lines_.line()));
        has_format_ = true;
    }

    // Reads "element NAME COUNT". Names must be unique.
    void read_element(Words words) {
        const std::string_view name = words.next();
        const auto count = parse_integer(words.next());
        if (!count || *count < 0)
            fail("an element needs a name and a count: " + in_quotes(lines_.line()));
        for (const PlyElement& other : header_.elements)
            if (other.name == name)
                fail("a second element with the same name: " + in_quotes(lines_.line()));
        header_.elements.push_back({std::string(name), static_cast<std::size_t>(*count), {}});
    }

    // Reads "property TYPE NAME" or "property list LENGTH_TYPE TYPE NAME", for the last element.
    void read_property(Words words) {
        if (header_.elements.empty())
            fail("a property before the first element: " + in_quotes(lines_.line()));
        PlyProperty property;
        std::string_view type = words.next();
        if (type == "list") {
            property.length_type = read_type(words.next());
            type = words.next();
        }
        property.type = read_type(type);
        property.name = words.next();
        if (property.name.empty())
            fail("a property needs a type and a name: " + in_quotes(lines_.line()));
        header_.elements.back().properties.push_back(std::move(property));
    }

    // Reads the name of a number type.
    PlyType read_type(std::string_view name) const {
        const auto* const found = std::find_if(type_names.begin(), type_names.end(),
                                               [&](const TypeName& candidate) { return candidate.name == name; });
        if (found == type_names.end())
            fail("not a PLY type: " + in_quotes(name) + " in " + in_quotes(lines_.line()));
        return found->type;
    }

    [[noreturn]] void fail(const std::string& why) const { fail_at_line(lines_.number(), why); }

    std::string_view text_;
    Lines lines_;
    PlyHeader header_;
    bool has_format_ = false;
};

} // namespace

PlyHeader read_ply_header(std::string_view text) {
    return PlyHeaderReader(text).read();
}

} // namespace chasles::io
