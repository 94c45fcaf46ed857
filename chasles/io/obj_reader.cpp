// Reads vertices and polygons from Wavefront OBJ. Groups, materials, normals, textures, points, lines and the
// extensions of common programs are ignored. Parts of the surface that cannot be read are refused with the line number.
#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace chasles::io {
namespace {

// Attributes, groups, points, lines, and statements that have an effect only together with curved surfaces.
constexpr auto ignored_keywords = std::to_array<std::string_view>(
    {"vt",        "vn",       "vp",       "p",      "l",      "o",      "g",   "s",
     "mg",        "usemtl",   "mtllib",   "usemap", "maplib", "bevel",  "lod", "shadow_obj",
     "trace_obj", "c_interp", "d_interp", "ctech",  "stech",  "cstype", "deg", "step",
     "bmat",      "parm",     "trim",     "hole",   "scrv",   "sp",     "con", "end"});

// Statements of material files. Some writers put them into the OBJ file itself.
constexpr auto material_keywords = std::to_array<std::string_view>(
    {"newmtl",    "Ka",   "Kd",   "Ks",    "Ke",   "Km",   "Kt", "Ns", "Ni", "Np", "d",   "Tr",    "Tf",    "illum",
     "sharpness", "bump", "disp", "decal", "refl", "norm", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor"});

// Extensions: tags of subdivision (OpenSubdiv), weights of bones (tinyobjloader), colours of vertices, and another word
// for usemtl. None of them changes the polygons.
constexpr auto extension_keywords = std::to_array<std::string_view>({"t", "vw", "vc", "usemat"});

// Statements that bring in other files, which may hold faces.
constexpr auto calling_keywords = std::to_array<std::string_view>({"call", "csh"});

// Statements that define a curved surface or curve. Ignoring them would lose a part of the surface.
constexpr auto curved_keywords =
    std::to_array<std::string_view>({"surf", "curv", "curv2", "bsp", "bzp", "cdc", "cdp", "res"});

// Whether a list of keywords contains a name.
template <typename Names>
bool contains(const Names& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Reads one statement after another. Statements may extend over several lines.
class ObjReader {
public:
    explicit ObjReader(std::string_view text) : lines_(without_byte_order_mark(text)) {}

    PolygonSoup read() {
        while (next_statement())
            read_statement();
        check_indices();
        return std::move(soup_);
    }

private:
    // Moves to the next line and removes its comment. A line that ends with a backslash is joined with the next line.
    bool next_statement() {
        if (!lines_.next())
            return false;
        line_ = lines_.number();
        statement_ = without_comment(lines_.line());
        if (statement_.ends_with('\\'))
            join_lines();
        return true;
    }

    void join_lines() {
        joined_.clear();
        while (statement_.ends_with('\\')) {
            joined_.append(statement_.substr(0, statement_.size() - 1)).push_back(' ');
            if (!lines_.next())
                fail("the file ends within a continued line");
            statement_ = without_comment(lines_.line());
        }
        statement_ = joined_.append(statement_);
    }

    static std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

    void read_statement() {
        Words words(statement_);
        const std::string_view keyword = words.next();
        if (keyword == "v")
            read_vertex(words);
        else if (keyword == "f" || keyword == "fo")
            read_face(words);
        else if (!keyword.empty())
            check_ignored(keyword);
    }

    void read_vertex(Words words) {
        Eigen::Vector3d vertex;
        for (double& coordinate : vertex) {
            const auto number = parse_finite(words.next());
            if (!number)
                fail("a vertex needs three finite numbers: " + in_quotes(statement_) + decimal_comma_hint(statement_));
            coordinate = *number;
        }
        // A weight or a colour may follow. Any other text indicates that the line does not hold coordinates.
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            if (!parse_number(word))
                fail("not a number: " + in_quotes(word) + " in " + in_quotes(statement_) + decimal_comma_hint(word));
        soup_.vertices.push_back(vertex);
    }

    // Reads the corners of a face in any of the OBJ forms.
    void read_face(Words words) {
        std::vector<std::uint32_t> face;
        face.reserve(4);
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            face.push_back(read_corner(word));
        if (face.size() < 3)
            fail("a face needs at least three vertices: " + in_quotes(statement_));
        soup_.faces.push_back(std::move(face));
        soup_.face_lines.push_back(line_);
    }

    // Reads "7", "7/1", "7//2" or "7/1/2". A negative index counts back from the last vertex read.
    std::uint32_t read_corner(std::string_view word) const {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const auto index = parse_integer(word.substr(0, slash));
        const bool has_odd_tail = word.substr(slash).find_first_not_of("/-0123456789") != std::string_view::npos;
        if (!index || has_odd_tail)
            fail("not a vertex of a face: " + in_quotes(word) + " in " + in_quotes(statement_) +
                 decimal_comma_hint(word));
        if (*index == 0)
            fail("vertex index 0 in " + in_quotes(statement_) + "; OBJ counts from 1");
        // Positive indices are checked at the end, negative indices now.
        const auto from_zero = *index > 0 ? *index - 1 : *index + static_cast<std::int64_t>(soup_.vertices.size());
        if (from_zero < 0 || from_zero >= std::numeric_limits<std::uint32_t>::max())
            fail_index(*index);
        return static_cast<std::uint32_t>(from_zero);
    }

    // Refuses unknown statements and curved surfaces. A typing error in a keyword must not lose a face.
    void check_ignored(std::string_view keyword) const {
        const bool has_nothing_read = soup_.vertices.empty() && soup_.faces.empty();
        if (has_nothing_read && parse_integer(keyword))
            return; // some files start with a line of counts
        if (contains(curved_keywords, keyword))
            fail("curved surfaces cannot be read, only polygons: " + in_quotes(statement_));
        if (contains(calling_keywords, keyword))
            fail("other files and programs cannot be called: " + in_quotes(statement_) +
                 "; put their faces into this file");
        const bool is_material = contains(material_keywords, keyword) || keyword.starts_with("map_");
        if (!is_material && !contains(ignored_keywords, keyword) && !contains(extension_keywords, keyword))
            fail("not an OBJ statement: " + in_quotes(statement_));
    }

    // Checks indices at the end, because a face may come before its vertices.
    void check_indices() {
        for (std::size_t i = 0; i < soup_.faces.size(); ++i)
            for (const std::uint32_t vertex : soup_.faces[i])
                if (vertex >= soup_.vertices.size()) {
                    line_ = soup_.face_lines[i];
                    fail_index(std::int64_t{vertex} + 1);
                }
    }

    [[noreturn]] void fail_index(std::int64_t index) const {
        fail("vertex index " + std::to_string(index) + " is out of range; there are " +
             std::to_string(soup_.vertices.size()) + " vertices" + (index < 0 ? " so far" : ""));
    }

    [[noreturn]] void fail(const std::string& why) const { fail_at_line(line_, why); }

    Lines lines_;
    std::size_t line_ = 0;
    std::string_view statement_;
    std::string joined_;
    PolygonSoup soup_;
};

} // namespace

PolygonSoup read_obj(std::string_view text) {
    return ObjReader(text).read();
}

} // namespace chasles::io
