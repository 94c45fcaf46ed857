// Reads the corners of polygons and the vertices that they refer to.
// Source: COLLADA 1.4.1 specification, chapter 5, "Geometry".
#include "chasles/io/collada_primitives.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <map>

namespace chasles::io {
namespace {

using VertexIds = std::vector<std::uint32_t>;

// The vertices of one <source> in the soup.
struct ColladaVertices {
    std::uint32_t first = 0;
    std::size_t count = 0;
};

// Where the vertex indices lie in the list <p> of a primitive.
struct ColladaInput {
    ColladaVertices vertices;
    std::size_t stride = 1;
    std::size_t offset = 0;
};

class ColladaMesh {
public:
    ColladaMesh(const XmlElement& mesh, SizeBudget& budget) : mesh_(mesh), budget_(budget) {
        for (const XmlElement* child = mesh_.FirstChildElement(); child; child = child->NextSiblingElement())
            by_id_.try_emplace(attribute_of(*child, "id"), child);
    }

    PolygonSoup read() {
        for (const XmlElement* child = mesh_.FirstChildElement(); child; child = child->NextSiblingElement())
            read_primitive(*child);
        return std::move(soup_);
    }

private:
    void read_primitive(const XmlElement& primitive) {
        const std::string_view name = local_name(primitive);
        if (name == "triangles")
            read_triangles(primitive);
        else if (name == "polylist")
            read_polylist(primitive);
        else if (name == "polygons")
            read_polygons(primitive);
        else if (name == "tristrips")
            read_strips(primitive);
        else if (name == "trifans")
            read_fans(primitive);
    }

    void read_triangles(const XmlElement& primitive) {
        const VertexIds corners = corners_of_only(primitive);
        if (corners.size() % 3 != 0)
            fail_at(primitive, std::to_string(corners.size()) + " corners are no whole triangles");
        check_count(primitive, corners.size() / 3);
        for (std::size_t i = 0; i < corners.size(); i += 3)
            soup_.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }

    void read_polylist(const XmlElement& primitive) {
        const VertexIds corners = corners_of_only(primitive);
        const XmlElement* const counts = child_of(primitive, "vcount");
        std::size_t at = 0, faces = 0;
        for (const double count : counts ? numbers_in(*counts, text_of(*counts)) : std::vector<double>()) {
            if (!(count >= 0 && count <= double(corners.size() - at) && count == double(std::size_t(count))))
                fail_at(primitive, "<vcount> announces more corners than there are");
            add_face(VertexIds(corners.begin() + std::ptrdiff_t(at), corners.begin() + std::ptrdiff_t(at + count)));
            at += std::size_t(count);
            ++faces;
        }
        if (at != corners.size())
            fail_at(primitive, "<vcount> announces " + std::to_string(at) + " corners, but there are " +
                                   std::to_string(corners.size()));
        check_count(primitive, faces);
    }

    void read_polygons(const XmlElement& primitive) {
        if (child_of(primitive, "ph"))
            fail_at(primitive, "polygons with holes are not read; triangulate them");
        for (VertexIds& outline : corners_of_each(primitive))
            add_face(std::move(outline));
    }

    void read_strips(const XmlElement& primitive) {
        for (const VertexIds& strip : corners_of_each(primitive))
            add_triangle_strip(soup_, strip);
    }

    void read_fans(const XmlElement& primitive) {
        for (const VertexIds& fan : corners_of_each(primitive))
            add_triangle_fan(soup_, fan);
    }

    // Polygons of one or two corners are points and lines.
    void add_face(VertexIds corners) {
        if (corners.size() >= 3)
            soup_.faces.push_back(std::move(corners));
    }

    static void check_count(const XmlElement& primitive, std::size_t found) {
        const std::size_t announced = count_of(primitive, "count", found);
        if (announced != found)
            fail_at(primitive,
                    "announces " + std::to_string(announced) + " items, but there are " + std::to_string(found));
    }

    // The corners in each <p>.
    std::vector<VertexIds> corners_of_each(const XmlElement& primitive) {
        std::vector<VertexIds> all;
        const std::vector<const XmlElement*> lists = children_of(primitive, "p");
        check_count(primitive, lists.size());
        const ColladaInput input = lists.empty() ? ColladaInput() : input_of(primitive);
        for (const XmlElement* const list : lists)
            all.push_back(corners_of(*list, input));
        return all;
    }

    // The corners in the only <p>, if there is one.
    VertexIds corners_of_only(const XmlElement& primitive) {
        const std::vector<const XmlElement*> lists = children_of(primitive, "p");
        if (lists.size() > 1)
            fail_at(primitive, "has more than one <p>");
        return lists.empty() ? VertexIds() : corners_of(*lists[0], input_of(primitive));
    }

    // Each corner has one index for each offset.
    VertexIds corners_of(const XmlElement& list, const ColladaInput& input) {
        const std::string text = text_of(list);
        Words words(text);
        VertexIds corners;
        std::size_t position = 0;
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            if (position++ % input.stride == input.offset)
                corners.push_back(input.vertices.first + vertex_in(list, word, input.vertices.count));
        if (position % input.stride != 0)
            fail_at(list, std::to_string(position) + " indices are no multiple of " + std::to_string(input.stride));
        budget_.spend(corners.size());
        return corners;
    }

    static std::uint32_t vertex_in(const XmlElement& list, std::string_view word, std::size_t count) {
        const auto index = parse_integer(word);
        if (!index)
            fail_at(list, "not a vertex index: " + in_quotes(word));
        if (*index < 0 || static_cast<std::uint64_t>(*index) >= count)
            fail_at(list, "vertex index " + std::to_string(*index) + " is out of range; there are " +
                              std::to_string(count) + " vertices, counted from 0");
        return static_cast<std::uint32_t>(*index);
    }

    ColladaInput input_of(const XmlElement& primitive) {
        ColladaInput input;
        const XmlElement* vertices = nullptr;
        for (const XmlElement* const element : children_of(primitive, "input")) {
            const std::size_t offset = count_of(*element, "offset");
            input.stride = std::max(input.stride, offset + 1);
            if (attribute_of(*element, "semantic") == "VERTEX") {
                vertices = &part_of_mesh(*element, "vertices");
                input.offset = offset;
            }
        }
        if (!vertices)
            fail_at(primitive, "has no <input> of VERTEX");
        for (const XmlElement* const element : children_of(*vertices, "input"))
            if (attribute_of(*element, "semantic") == "POSITION") {
                input.vertices = vertices_of(part_of_mesh(*element, "source"));
                return input;
            }
        fail_at(*vertices, "has no <input> of POSITION");
    }

    // The element of the mesh that an input refers to.
    const XmlElement& part_of_mesh(const XmlElement& input, std::string_view name) const {
        const std::string_view reference = required_attribute_of(input, "source");
        const auto found = by_id_.find(reference.substr(1));
        if (found != by_id_.end() && local_name(*found->second) == name)
            return *found->second;
        fail_at(input, "the mesh has no <" + std::string(name) + "> with the id " + in_quotes(reference.substr(1)));
    }

    ColladaVertices vertices_of(const XmlElement& source) {
        const auto [known, is_new] = sources_.try_emplace(&source);
        if (is_new)
            known->second = read_vertices(source);
        return known->second;
    }

    ColladaVertices read_vertices(const XmlElement& source) {
        const XmlElement& array = required_child_of(source, "float_array");
        const std::vector<double> numbers = numbers_in(array, text_of(array));
        const XmlElement& accessor = required_child_of(required_child_of(source, "technique_common"), "accessor");
        const std::size_t count = count_of(accessor, "count"), stride = count_of(accessor, "stride", 1),
                          offset = count_of(accessor, "offset", 0);
        const auto axes = axes_of(accessor);
        const std::size_t last_axis = *std::ranges::max_element(axes);
        // Each vertex takes `stride` numbers, of which the last vertex may have fewer.
        if (last_axis >= stride || offset > numbers.size() || count > (numbers.size() - offset + stride - 1) / stride ||
            (count > 0 && offset + (count - 1) * stride + last_axis >= numbers.size()))
            fail_at(accessor, "announces more numbers than there are");
        budget_.spend(count);
        const ColladaVertices vertices{static_cast<std::uint32_t>(soup_.vertices.size()), count};
        for (const double* at = numbers.data() + offset; soup_.vertices.size() < vertices.first + count; at += stride)
            soup_.vertices.emplace_back(at[axes[0]], at[axes[1]], at[axes[2]]);
        return vertices;
    }

    // The places of X, Y and Z among the parameters; 0, 1 and 2 where they have other names.
    static std::array<std::size_t, 3> axes_of(const XmlElement& accessor) {
        const std::vector<const XmlElement*> parameters = children_of(accessor, "param");
        std::array<std::size_t, 3> axes{0, 1, 2};
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            const std::string_view name = attribute_of(*parameters[i], "name");
            const std::size_t axis = std::string_view("XYZ").find(name);
            if (name.size() == 1 && axis != std::string_view::npos)
                axes[axis] = i;
        }
        return axes;
    }

    const XmlElement& mesh_;
    SizeBudget& budget_;
    std::map<std::string_view, const XmlElement*> by_id_;
    std::map<const XmlElement*, ColladaVertices> sources_;
    PolygonSoup soup_;
};

} // namespace

PolygonSoup read_collada_geometry(const XmlElement& geometry, SizeBudget& budget) {
    if (const XmlElement* const mesh = child_of(geometry, "mesh"))
        return ColladaMesh(*mesh, budget).read();
    if (child_of(geometry, "spline"))
        return {}; // a curve, like lines
    const XmlElement* const other = geometry.FirstChildElement();
    fail_at(geometry, "needs a <mesh>" + (other ? ", not " + in_quotes(other->Name()) : std::string()));
}

} // namespace chasles::io
