// Reads 3MF: a ZIP archive with XML. Numbers stay in the unit that the file states. The build items and components of
// all parts are read (production extension); colours, textures and print settings are ignored. Beam lattices, slices,
// encrypted parts and what slicers do not print as a solid are refused. Source: 3MF Core Specification 1.3 and
// Production Extension 1.1; for slicers, the files that they write.
#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/scene_graph.h"
#include "chasles/io/text_scan.h"
#include "chasles/io/xml_text.h"
#include "chasles/io/zip_archive.h"

#include <limits>
#include <map>
#include <memory>

namespace chasles::io {
namespace {

// One XML part of the package and its objects.
struct ModelPart {
    tinyxml2::XMLDocument document;
    std::map<std::string_view, const XmlElement*> objects;
};

// The name of a part without the slash at its start.
std::string part_name(std::string_view target) {
    return std::string(target.substr(target.starts_with('/') ? 1 : 0));
}

// Namespaces of extensions that leave meshes as they are. All others may change what the file is.
void refuse_extension(const XmlElement& model, std::string_view prefix) {
    const std::string attribute = "xmlns:" + std::string(prefix);
    const char* const value = model.Attribute(attribute.c_str());
    const std::string_view name = value ? value : "";
    for (const std::string_view known : {"/production/", "/material/", "/trianglesets/"})
        if (name.find(known) != std::string_view::npos)
            return;
    std::string what = "the extension " + in_quotes(name.empty() ? prefix : name);
    if (name.find("/beamlattice/") != std::string_view::npos)
        what = "beam lattices";
    else if (name.find("/slice/") != std::string_view::npos)
        what = "slices";
    else if (name.find("/securecontent/") != std::string_view::npos)
        what = "encrypted content";
    throw InvalidInput("needs " + what + ", which is not read; export as a plain mesh");
}

// 12 numbers for row vectors: x' = x m0 + y m3 + z m6 + m9 and so on.
Eigen::Affine3d threemf_transform(const XmlElement& element) {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    const std::string_view text = attribute_of(element, "transform");
    if (text.empty())
        return transform;
    const std::vector<double> numbers = numbers_in(element, text);
    if (numbers.size() != 12)
        fail_at(element, "transform: has " + std::to_string(numbers.size()) + " numbers instead of 12");
    transform.affine() = Eigen::Map<const Eigen::Matrix<double, 3, 4>>(numbers.data());
    return transform;
}

double coordinate_of(const XmlElement& vertex, std::string_view axis) {
    const std::string_view text = required_attribute_of(vertex, axis);
    const auto number = parse_finite(Words(text).next());
    if (!number)
        fail_at(vertex,
                std::string(axis) + ": " + in_quotes(text) + " is not a finite number" + decimal_comma_hint(text));
    return *number;
}

// Anything else would be lost in silence.
void require_children_among(const XmlElement& element, std::initializer_list<std::string_view> names) {
    for (const XmlElement* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
        if (std::ranges::find(names, local_name(*child)) == names.end())
            fail_at(*child, "is not read; export as a plain mesh");
}

// The children of an element that may have only these.
std::vector<const XmlElement*> only_children_of(const XmlElement& element, std::string_view name) {
    require_children_among(element, {name});
    return children_of(element, name);
}

// The children of this name below a child that may be missing.
std::vector<const XmlElement*> grandchildren_of(const XmlElement& element, std::string_view child,
                                                std::string_view name) {
    const XmlElement* const list = child_of(element, child);
    return list ? children_of(*list, name) : std::vector<const XmlElement*>();
}

// The vertex ids of a triangle.
std::vector<std::uint32_t> corners_of(const XmlElement& triangle, std::size_t vertex_count) {
    std::vector<std::uint32_t> face;
    for (const char* const corner : {"v1", "v2", "v3"}) {
        const std::size_t vertex = count_of(triangle, corner);
        if (vertex >= vertex_count)
            fail_at(triangle, std::string(corner) + ": vertex index " + std::to_string(vertex) +
                                  " is out of range; there are " + std::to_string(vertex_count) +
                                  " vertices, counted from 0");
        face.push_back(static_cast<std::uint32_t>(vertex));
    }
    return face;
}

PolygonSoup threemf_mesh(const XmlElement& element) {
    if (child_of(element, "beamlattice"))
        fail_at(element, "beam lattices are not read; export as a plain mesh");
    require_children_among(element, {"vertices", "triangles", "trianglesets"}); // sets only name triangles
    PolygonSoup mesh;
    for (const XmlElement* const list : children_of(element, "vertices"))
        for (const XmlElement* const vertex : only_children_of(*list, "vertex"))
            mesh.vertices.emplace_back(coordinate_of(*vertex, "x"), coordinate_of(*vertex, "y"),
                                       coordinate_of(*vertex, "z"));
    for (const XmlElement* const list : children_of(element, "triangles"))
        for (const XmlElement* const triangle : only_children_of(*list, "triangle"))
            mesh.faces.push_back(corners_of(*triangle, mesh.vertices.size()));
    return mesh;
}

// The value of <metadata key="KEY" value="..."/> below an element.
std::string_view setting_of(const XmlElement& element, std::string_view key) {
    for (const XmlElement* const setting : children_of(element, "metadata"))
        if (attribute_of(*setting, "key") == key)
            return attribute_of(*setting, "value");
    return {};
}

// What an object is beside a solid, for Bambu Studio and OrcaSlicer ("negative_part") or for PrusaSlicer
// ("NegativeVolume"). Empty for a solid.
std::string_view kind_beside_solid(const XmlElement& object) {
    const bool is_part = local_name(object) == "part";
    const std::string_view kind = is_part ? attribute_of(object, "subtype") : setting_of(object, "volume_type");
    return kind == "normal_part" || kind == "ModelPart" ? std::string_view() : kind;
}

void refuse_kinds_beside_solids(const XmlElement& config) {
    for (const XmlElement* const object : children_of(config, "object"))
        for (const char* const name : {"part", "volume"})
            for (const XmlElement* const part : children_of(*object, name))
                if (const std::string_view kind = kind_beside_solid(*part); !kind.empty())
                    fail_at(*part, in_quotes(setting_of(*part, "name")) + " is a " + in_quotes(kind) +
                                       ", which is no solid body; cut it from the model, or remove it, in the slicer, "
                                       "and export again");
}

class ThreemfReader {
public:
    explicit ThreemfReader(std::string_view bytes) : archive_(bytes) { scene_.file_size = bytes.size(); }

    SceneGraph read() {
        const std::string name = model_name();
        for (const char* const settings : {"Metadata/model_settings.config", "Metadata/Slic3r_PE_model.config"})
            if (archive_.has(settings))
                read_settings(settings);
        const XmlElement& model = *part(name).document.RootElement();
        const std::string_view unit = attribute_of(model, "unit");
        scene_.unit = unit.empty() ? "millimeter" : unit; // the default of the specification
        for (const XmlElement* const item : children_of(required_child_of(model, "build"), "item"))
            scene_.roots.push_back(place(*item, name));
        while (!waiting_.empty()) {
            const auto [node, element, home] = waiting_.back();
            waiting_.pop_back();
            in_part(home, [&] { fill(node, *element, home); });
        }
        return std::move(scene_);
    }

private:
    // The name of the part with the 3D model, which a relationship of the package states.
    std::string model_name() {
        constexpr const char* relationships = "_rels/.rels";
        if (!archive_.has(relationships))
            throw InvalidInput("is no 3MF: the archive has no part '_rels/.rels'");
        tinyxml2::XMLDocument document;
        const std::string text = archive_.read(relationships);
        in_part(relationships, [&] { parse_xml(document, text, "Relationships"); });
        for (const XmlElement* const relationship : children_of(*document.RootElement(), "Relationship"))
            if (attribute_of(*relationship, "Type").ends_with("/3dmodel"))
                return part_name(required_attribute_of(*relationship, "Target"));
        throw InvalidInput("is no 3MF: the archive names no 3D model");
    }

    // What a slicer keeps beside the model.
    void read_settings(const char* name) {
        const std::string text = archive_.read(name);
        tinyxml2::XMLDocument document;
        in_part(name, [&] {
            parse_xml(document, text, "config");
            refuse_kinds_beside_solids(*document.RootElement());
        });
    }

    // Adds the name of the part to messages with line numbers.
    template <typename Work>
    static void in_part(const std::string& name, const Work& work) {
        try {
            work();
        } catch (const InvalidInput& error) {
            throw InvalidInput("part " + in_quotes(name) + ": " + error.what());
        }
    }

    ModelPart& part(const std::string& name) {
        std::unique_ptr<ModelPart>& known = parts_[lower_case(name)];
        if (!known) {
            const std::string text = archive_.read(name);
            known = std::make_unique<ModelPart>();
            in_part(name, [&] { parse(*known, text); });
        }
        return *known;
    }

    static void parse(ModelPart& part, std::string_view text) {
        parse_xml(part.document, text, "model");
        const XmlElement& model = *part.document.RootElement();
        Words prefixes(attribute_of(model, "requiredextensions"));
        for (std::string_view prefix = prefixes.next(); !prefix.empty(); prefix = prefixes.next())
            refuse_extension(model, prefix);
        for (const XmlElement* const object : grandchildren_of(model, "resources", "object"))
            if (!part.objects.try_emplace(required_attribute_of(*object, "id"), object).second)
                fail_at(*object, "another object has the id " + in_quotes(attribute_of(*object, "id")));
    }

    // The node for an <item> or a <component>: a transform above the node of its object.
    std::size_t place(const XmlElement& reference, const std::string& home) {
        const std::string_view path = attribute_of(reference, "path");
        const std::string name = path.empty() ? home : part_name(path);
        const ModelPart& other = part(name);
        const auto object = other.objects.find(required_attribute_of(reference, "objectid"));
        if (object == other.objects.end())
            fail_at(reference, "there is no object " + in_quotes(attribute_of(reference, "objectid")));
        SceneNode node;
        node.to_parent = threemf_transform(reference);
        node.children = {node_of(*object->second, name)};
        scene_.nodes.push_back(std::move(node));
        return scene_.nodes.size() - 1;
    }

    // The node of an object. It is filled later: chains of components may be long.
    std::size_t node_of(const XmlElement& object, const std::string& home) {
        const auto [known, is_new] = nodes_.try_emplace(&object, scene_.nodes.size());
        if (is_new) {
            scene_.nodes.emplace_back();
            waiting_.push_back({known->second, &object, home});
        }
        return known->second;
    }

    void fill(std::size_t index, const XmlElement& object, const std::string& home) {
        SceneNode node;
        node.name = attribute_of(object, "name");
        for (const XmlElement* child = object.FirstChildElement(); child; child = child->NextSiblingElement()) {
            const std::string_view name = local_name(*child);
            if (name == "mesh") {
                node.meshes.push_back(scene_.meshes.size());
                scene_.meshes.push_back(threemf_mesh(*child));
            } else if (name == "components") {
                for (const XmlElement* const component : only_children_of(*child, "component"))
                    node.children.push_back(place(*component, home));
            } else if (name != "metadatagroup") {
                fail_at(*child, "is not read; export as a plain mesh");
            }
        }
        scene_.nodes[index] = std::move(node);
    }

    // An object that is not filled yet.
    struct Waiting {
        std::size_t node;
        const XmlElement* object;
        std::string home;
    };

    ZipArchive archive_;
    std::map<std::string, std::unique_ptr<ModelPart>> parts_;
    std::map<const XmlElement*, std::size_t> nodes_;
    std::vector<Waiting> waiting_;
    SceneGraph scene_;
};

} // namespace

std::vector<MeshPart> read_3mf(std::string_view bytes) {
    std::vector<MeshPart> parts = parts_of(ThreemfReader(bytes).read());
    if (parts.empty()) // a sliced file (.gcode.3mf) has paths of the print head only
        throw InvalidInput("has no mesh; if the file is sliced, export the project or the model instead");
    return parts;
}

} // namespace chasles::io
