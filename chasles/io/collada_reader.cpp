// Reads COLLADA 1.4 and 1.5. Coordinates stay as the file states them, times its <unit>; <up_axis> turns nothing.
// Materials, cameras, lights and animations are ignored, and lines are left out. Source: COLLADA 1.4.1 specification.
#include "chasles/algebra/sine_cosine.h"
#include "chasles/base/invalid_input.h"
#include "chasles/io/collada_primitives.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/scene_graph.h"
#include "chasles/io/text_scan.h"
#include "chasles/io/xml_text.h"

#include <map>
#include <numbers>

namespace chasles::io {
namespace {

// The turn about a direction of length one, by Rodrigues' formula. Eigen's own calls the C library, and then a file has
// other bits on another machine.
Eigen::Matrix3d turn_matrix(const Eigen::Vector3d& direction, double angle) {
    const auto [sine, cosine] = algebra::sine_cosine(angle);
    const Eigen::Vector3d along = (1 - cosine) * direction, across = sine * direction;
    Eigen::Matrix3d turn = along * direction.transpose();
    turn.diagonal().array() += cosine;
    turn(0, 1) -= across.z();
    turn(1, 0) += across.z();
    turn(0, 2) += across.y();
    turn(2, 0) -= across.y();
    turn(1, 2) -= across.x();
    turn(2, 1) += across.x();
    return turn;
}

// A transform of a node: <matrix>, <translate>, <rotate>, <scale> or <lookat>. Other elements are the identity.
class ColladaTransform {
public:
    explicit ColladaTransform(const XmlElement& element) : element_(element) {}

    Eigen::Affine3d get() {
        const std::string_view name = local_name(element_);
        if (name == "skew")
            fail_at(element_, "shearing transforms are not read; export the node with a <matrix>");
        if (name == "matrix")
            return matrix(element_);
        if (name == "translate")
            return Eigen::Affine3d(Eigen::Translation3d(vector(read(3), 0)));
        if (name == "scale")
            return Eigen::Affine3d(Eigen::Scaling(vector(read(3), 0)));
        if (name == "rotate")
            return rotation(read(4));
        return name == "lookat" ? view(read(9)) : Eigen::Affine3d::Identity();
    }

    static Eigen::Affine3d matrix(const XmlElement& element) {
        const std::vector<double> numbers = ColladaTransform(element).read(16);
        const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
        if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
            fail_at(element, "the last row of a transform must be 0 0 0 1");
        return Eigen::Affine3d(matrix);
    }

private:
    [[nodiscard]] std::vector<double> read(std::size_t count) const {
        std::vector<double> numbers = numbers_in(element_, text_of(element_));
        if (numbers.size() != count)
            fail_at(element_, "has " + std::to_string(numbers.size()) + " numbers instead of " + std::to_string(count));
        return numbers;
    }

    static Eigen::Vector3d vector(const std::vector<double>& numbers, std::size_t first) {
        return {numbers[first], numbers[first + 1], numbers[first + 2]};
    }

    // Quarter turns are exact.
    [[nodiscard]] Eigen::Affine3d rotation(const std::vector<double>& numbers) const {
        const Eigen::Vector3d axis = vector(numbers, 0);
        const double degrees = std::remainder(numbers[3], 360.0);
        if (degrees == 0)
            return Eigen::Affine3d::Identity();
        if (!(axis.norm() > 0))
            fail_at(element_, "the axis of a rotation must not be 0");
        Eigen::Affine3d turn(turn_matrix(axis.stableNormalized(), degrees * (std::numbers::pi / 180)));
        const bool is_along_axis = (axis.array() != 0).count() == 1;
        if (is_along_axis && std::fmod(degrees, 90.0) == 0)
            turn.linear() = turn.linear().array().round().matrix().eval();
        return turn;
    }

    // The place of something at the first point that looks at the second one; the third vector points upwards.
    [[nodiscard]] Eigen::Affine3d view(const std::vector<double>& numbers) const {
        const Eigen::Vector3d eye = vector(numbers, 0);
        Eigen::Affine3d place = Eigen::Affine3d::Identity();
        const Eigen::Vector3d z = (eye - vector(numbers, 3)).stableNormalized();
        const Eigen::Vector3d x = vector(numbers, 6).cross(z).stableNormalized();
        place.linear() << x, z.cross(x), z;
        place.translation() = eye;
        return place;
    }

    const XmlElement& element_;
};

class ColladaReader {
public:
    explicit ColladaReader(std::string_view text) : budget_(text.size()) {
        parse_xml(document_, text, "COLLADA");
        scene_.file_size = text.size();
    }

    SceneGraph read() {
        const XmlElement& root = *document_.RootElement();
        index(root);
        SceneNode top;
        top.to_parent = Eigen::Affine3d(Eigen::Scaling(unit(root)));
        for (const XmlElement* node : children_of(visual_scene(root), "node"))
            top.children.push_back(node_of(*node));
        while (!waiting_.empty()) {
            const XmlElement& element = *waiting_.back();
            waiting_.pop_back();
            fill(nodes_.at(&element), element);
        }
        scene_.nodes.push_back(std::move(top));
        scene_.roots = {scene_.nodes.size() - 1};
        return std::move(scene_);
    }

private:
    // Remembers all elements with ids. The parser bounds the depth.
    void index(const XmlElement& element) {
        if (const char* const id = element.Attribute("id"))
            elements_.try_emplace(id, &element);
        for (const XmlElement* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
            index(*child);
    }

    // Metres for each unit of the file.
    static double unit(const XmlElement& root) {
        const XmlElement* const asset = child_of(root, "asset");
        const XmlElement* const unit = asset ? child_of(*asset, "unit") : nullptr;
        const std::string_view text = unit ? attribute_of(*unit, "meter") : "";
        if (text.empty())
            return 1;
        const std::vector<double> metres = numbers_in(*unit, text);
        if (metres.size() != 1 || !(metres[0] > 0))
            fail_at(*unit, "meter: must be one positive number, not " + in_quotes(text));
        return metres[0];
    }

    // The scene that the file names; the first one if it names none.
    const XmlElement& visual_scene(const XmlElement& root) const {
        const XmlElement* const scene = child_of(root, "scene");
        if (const XmlElement* const instance = scene ? child_of(*scene, "instance_visual_scene") : nullptr)
            return target(*instance, "url", "visual_scene");
        const XmlElement* const library = child_of(root, "library_visual_scenes");
        const XmlElement* const first = library ? child_of(*library, "visual_scene") : nullptr;
        if (!first)
            fail_at(root, "has no <visual_scene>");
        return *first;
    }

    // The element that an attribute refers to.
    const XmlElement& target(const XmlElement& element, const char* attribute, std::string_view name) const {
        const std::string_view reference = required_attribute_of(element, attribute);
        if (reference.front() != '#')
            fail_at(element, "refers to another file, which is not read: " + in_quotes(reference));
        const auto found = elements_.find(reference.substr(1));
        if (found == elements_.end() || local_name(*found->second) != name)
            fail_at(element, "there is no <" + std::string(name) + "> with the id " + in_quotes(reference.substr(1)));
        return *found->second;
    }

    // The index of the node for an element. It is filled later: chains of nodes that refer to nodes may be long.
    std::size_t node_of(const XmlElement& element) {
        const auto [known, is_new] = nodes_.try_emplace(&element, scene_.nodes.size());
        if (is_new) {
            scene_.nodes.emplace_back();
            waiting_.push_back(&element);
        }
        return known->second;
    }

    void fill(std::size_t index, const XmlElement& element) {
        SceneNode node;
        node.name = attribute_of(element, attribute_of(element, "name").empty() ? "id" : "name");
        for (const XmlElement* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
            add_child(node, *child);
        scene_.nodes[index] = std::move(node);
    }

    void add_child(SceneNode& node, const XmlElement& child) {
        const std::string_view name = local_name(child);
        if (name == "node")
            node.children.push_back(node_of(child));
        else if (name == "instance_node")
            node.children.push_back(node_of(target(child, "url", "node")));
        else if (name == "instance_geometry")
            add_geometry(node, target(child, "url", "geometry"));
        else if (name == "instance_controller")
            add_controller(node, target(child, "url", "controller"));
        else
            node.to_parent = node.to_parent * ColladaTransform(child).get();
    }

    void add_geometry(SceneNode& node, const XmlElement& geometry) {
        const auto [known, is_new] = meshes_.try_emplace(&geometry, scene_.meshes.size());
        if (is_new)
            scene_.meshes.push_back(read_collada_geometry(geometry, budget_));
        if (node.name.empty())
            node.name = attribute_of(geometry, attribute_of(geometry, "name").empty() ? "id" : "name");
        node.meshes.push_back(known->second);
    }

    // The mesh of a skin in the pose in which it was bound to its bones, or the base mesh of a morph. A controller may
    // refer to a controller.
    void add_controller(SceneNode& node, const XmlElement& controller) {
        SceneNode bound;
        bound.name = node.name;
        const XmlElement* geometry = &controller;
        for (int depth = 0; local_name(*geometry) == "controller"; ++depth) {
            const XmlElement* const skin = child_of(*geometry, "skin");
            const XmlElement& source = skin ? *skin : required_child_of(*geometry, "morph");
            const XmlElement* const shape = child_of(source, "bind_shape_matrix");
            if (shape)
                bound.to_parent = bound.to_parent * ColladaTransform::matrix(*shape);
            const auto found = elements_.find(required_attribute_of(source, "source").substr(1));
            if (found == elements_.end() || depth == 100)
                fail_at(source, "refers to no <geometry>");
            geometry = found->second;
        }
        if (local_name(*geometry) != "geometry")
            fail_at(controller, "refers to no <geometry>");
        add_geometry(bound, *geometry);
        node.children.push_back(scene_.nodes.size());
        scene_.nodes.push_back(std::move(bound));
    }

    tinyxml2::XMLDocument document_;
    std::map<std::string_view, const XmlElement*> elements_;
    std::map<const XmlElement*, std::size_t> nodes_;
    std::vector<const XmlElement*> waiting_; ///< elements of nodes that are not filled
    std::map<const XmlElement*, std::size_t> meshes_;
    SizeBudget budget_;
    SceneGraph scene_;
};

} // namespace

std::vector<MeshPart> read_collada(std::string_view text) {
    return parts_of(ColladaReader(text).read());
}

} // namespace chasles::io
