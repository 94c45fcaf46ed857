// Reads PLY: ASCII, and binary in either byte order, with any number types. It uses x, y, z of the element "vertex" and
// the list vertex_indices (or vertex_index) of the element "face", and skips all other data.
#include "chasles/base/invalid_input.h"
#include "chasles/io/bytes.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/ply_header.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace chasles::io {
namespace {

/// An item of an element, for messages.
struct PlyItem {
    std::string_view element;
    std::size_t number = 0; ///< from 0
    std::size_t count = 0;  ///< items of the element, as the header announces them
};

[[noreturn]] void fail_truncated(const PlyItem& item, const std::string& and_more) {
    throw InvalidInput("is truncated: the header announces " + std::to_string(item.count) + " of the element '" +
                       one_line(item.element) + "', but there are " + std::to_string(item.number) + and_more);
}

/// The numbers of ASCII data, with one item per line.
class AsciiNumbers {
public:
    AsciiNumbers(std::string_view data, std::size_t header_lines) : lines_(data), header_lines_(header_lines) {}

    // Moves to the next item. Returns false at the end of the data.
    bool begin_item(const PlyItem& /*item*/) {
        do {
            if (!lines_.next())
                return false;
            words_ = Words(lines_.line());
        } while (Words(words_).next().empty());
        return true;
    }

    // Reads the next number. ASCII data needs no type.
    double read(PlyType /*type*/) {
        const std::string_view word = words_.next();
        const auto number = parse_number(word);
        if (word.empty())
            fail("has fewer numbers than the header announces: " + in_quotes(lines_.line()));
        if (!number)
            fail("not a number: " + in_quotes(word) + " in " + in_quotes(lines_.line()) + decimal_comma_hint(word));
        return *number;
    }

    // Fails if the line has more numbers.
    void end_item() {
        if (!words_.next().empty())
            fail("has more numbers than the header announces: " + in_quotes(lines_.line()));
    }

    [[noreturn]] void fail(const std::string& why) const { fail_at_line(line(), why); }
    // The line in the file, from 1.
    [[nodiscard]] std::size_t line() const { return header_lines_ + lines_.number(); }

private:
    Lines lines_;
    std::size_t header_lines_;
    Words words_{""};
};

/// The numbers of binary data.
class BinaryNumbers {
public:
    BinaryNumbers(std::string_view data, std::endian order) : data_(data), order_(order) {}

    bool begin_item(const PlyItem& item) {
        item_ = item;
        return !data_.empty();
    }

    // Reads the next number. Every PLY number fits a double exactly.
    double read(PlyType type) {
        switch (type) {
        case PlyType::int8:
            return take<std::int8_t>();
        case PlyType::uint8:
            return take<std::uint8_t>();
        case PlyType::int16:
            return take<std::int16_t>();
        case PlyType::uint16:
            return take<std::uint16_t>();
        case PlyType::int32:
            return take<std::int32_t>();
        case PlyType::uint32:
            return take<std::uint32_t>();
        case PlyType::float32:
            return take<float>();
        case PlyType::float64:
            break;
        }
        return take<double>();
    }

    void end_item() const {}

    [[noreturn]] void fail(const std::string& why) const { throw InvalidInput(why); }
    // Binary data has no lines.
    [[nodiscard]] std::size_t line() const { return 0; }

private:
    // Takes the bytes of one number, or fails at the end of the file.
    template <typename Number>
    Number take() {
        if (data_.size() < sizeof(Number))
            fail_truncated(item_, " and a part of the next one");
        const auto number = load<Number>(data_, order_);
        data_.remove_prefix(sizeof(Number));
        return number;
    }

    std::string_view data_;
    std::endian order_;
    PlyItem item_{};
};

/// The properties of an element that the reader uses.
struct Wanted {
    std::vector<int> coordinate; ///< for each property: 0, 1, 2 for x, y, z; -1 for other properties
    int indices = -1;            ///< the property that lists the vertices of a face; -1 if none
};

// Reads the elements in the order of the header, from ASCII or binary numbers.
template <typename Numbers>
class PlyReader {
public:
    PlyReader(const PlyHeader& header, Numbers numbers) : header_(header), numbers_(numbers) {}

    // Reads all elements. Data after the last element is an error.
    PolygonSoup read() {
        for (const PlyElement& element : header_.elements)
            read_element(element);
        if (numbers_.begin_item({}))
            numbers_.fail("more data than the header announces");
        check_indices();
        return std::move(soup_);
    }

private:
    // Reads all items of an element.
    void read_element(const PlyElement& element) {
        if (element.name == "tristrips")
            throw InvalidInput("triangle strips (the element 'tristrips') are not read; save the mesh with faces");
        // An element without properties takes no bytes: a huge count would loop without end.
        if (element.properties.empty() && element.count > 0)
            throw InvalidInput("the element '" + one_line(element.name) + "' has no properties");
        const bool is_vertex = element.name == "vertex";
        const bool is_face = element.name == "face";
        const Wanted wanted = is_vertex ? find_coordinates(element) : is_face ? find_indices(element) : Wanted{};
        for (std::size_t i = 0; i < element.count; ++i) {
            const PlyItem item{element.name, i, element.count};
            if (!numbers_.begin_item(item))
                fail_truncated(item, "");
            if (is_vertex)
                read_vertex(element, wanted);
            else
                read_item(element, wanted);
            numbers_.end_item();
        }
    }

    // Finds x, y and z. Each must occur once and not as a list.
    static Wanted find_coordinates(const PlyElement& element) {
        Wanted wanted;
        for (const PlyProperty& property : element.properties) {
            const auto axis = std::string_view("xyz").find(property.name);
            const bool is_axis = property.name.size() == 1 && axis != std::string_view::npos && !property.length_type;
            wanted.coordinate.push_back(is_axis ? static_cast<int>(axis) : -1);
        }
        for (int axis = 0; axis < 3; ++axis)
            if (std::count(wanted.coordinate.begin(), wanted.coordinate.end(), axis) != 1)
                throw InvalidInput("the element 'vertex' needs the properties x, y and z");
        return wanted;
    }

    // Finds the list of vertex indices.
    static Wanted find_indices(const PlyElement& element) {
        Wanted wanted;
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            const bool is_named = property.name == "vertex_indices" || property.name == "vertex_index";
            if (is_named && property.length_type)
                wanted.indices = static_cast<int>(i);
        }
        if (wanted.indices < 0)
            throw InvalidInput("the element 'face' needs the list vertex_indices");
        return wanted;
    }

    // Reads one vertex, which must be finite.
    void read_vertex(const PlyElement& element, const Wanted& wanted) {
        Eigen::Vector3d vertex;
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            if (wanted.coordinate[i] < 0)
                skip(element.properties[i]);
            else
                vertex[wanted.coordinate[i]] = numbers_.read(element.properties[i].type);
        }
        if (!vertex.allFinite())
            fail("vertex", soup_.vertices.size(), "NaN or infinity");
        soup_.vertices.push_back(vertex);
    }

    // Reads one item of the element "face", or skips an item of another element.
    void read_item(const PlyElement& element, const Wanted& wanted) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            if (static_cast<int>(i) == wanted.indices)
                read_face(element.properties[i]);
            else
                skip(element.properties[i]);
        }
    }

    // Skips a number or a list.
    void skip(const PlyProperty& property) {
        const std::size_t count = read_length(property);
        for (std::size_t i = 0; i < count; ++i)
            numbers_.read(property.type);
    }

    // Reads the length of a list. The reader reserves no memory for it: a length beyond the data fails at the end of
    // the data. A property that is no list has the length 1.
    std::size_t read_length(const PlyProperty& property) {
        if (!property.length_type)
            return 1;
        const double length = numbers_.read(*property.length_type);
        if (!is_index(length))
            numbers_.fail("the length of the list '" + one_line(property.name) + "' is not a count");
        return static_cast<std::size_t>(length);
    }

    // Reads the vertex indices of one face.
    void read_face(const PlyProperty& property) {
        const std::size_t length = read_length(property);
        if (length < 3)
            fail("face", soup_.faces.size(), "a face needs at least three vertices");
        std::vector<std::uint32_t> face;
        for (std::size_t i = 0; i < length; ++i) {
            const double index = numbers_.read(property.type);
            if (!is_index(index))
                fail("face", soup_.faces.size(), "a vertex index is not a whole number from 0");
            face.push_back(static_cast<std::uint32_t>(index));
        }
        soup_.faces.push_back(std::move(face));
        if (numbers_.line() > 0)
            soup_.face_lines.push_back(numbers_.line());
    }

    // Whether a number is a whole number that fits 32 bits.
    static bool is_index(double number) {
        return number >= 0 && number <= std::numeric_limits<std::uint32_t>::max() && number == std::floor(number);
    }

    // Faces may come before vertices in the file, therefore indices are checked at the end.
    void check_indices() const {
        for (std::size_t i = 0; i < soup_.faces.size(); ++i)
            for (const std::uint32_t vertex : soup_.faces[i])
                if (vertex >= soup_.vertices.size())
                    fail_index(i, vertex);
    }

    // Fails with the line number if the format has lines, otherwise with the number of the face.
    [[noreturn]] void fail_index(std::size_t face, std::uint32_t vertex) const {
        const std::string why = "vertex index " + std::to_string(vertex) + " is out of range; there are " +
                                std::to_string(soup_.vertices.size()) + " vertices, counted from 0";
        if (!soup_.face_lines.empty())
            fail_at_line(soup_.face_lines[face], why);
        fail("face", face, why);
    }

    // Fails with the name of the item: binary data has no lines.
    [[noreturn]] void fail(const std::string& item, std::size_t id, const std::string& why) const {
        numbers_.fail(item + " " + std::to_string(id) + ": " + why);
    }

    const PlyHeader& header_;
    Numbers numbers_;
    PolygonSoup soup_;
};

} // namespace

PolygonSoup read_ply(std::string_view text) {
    text = without_byte_order_mark(text);
    const PlyHeader header = read_ply_header(text);
    const std::string_view data = text.substr(std::min(header.size, text.size()));
    if (header.format == PlyFormat::ascii)
        return PlyReader(header, AsciiNumbers(data, header.lines)).read();
    const std::endian order = header.format == PlyFormat::little_endian ? std::endian::little : std::endian::big;
    return PlyReader(header, BinaryNumbers(data, order)).read();
}

} // namespace chasles::io
