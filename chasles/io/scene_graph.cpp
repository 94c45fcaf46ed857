// Walks the paths of a scene without recursion: chains of nodes may be long.
#include "chasles/io/scene_graph.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <unordered_map>
#include <unordered_set>

namespace chasles::io {
namespace {

constexpr std::size_t most_nodes = 1'000'000;
constexpr std::size_t most_numbers = std::size_t{1} << 26U;

// Vertices and corners. A mesh without faces places nothing.
std::size_t numbers_of(const PolygonSoup& mesh) {
    if (mesh.faces.empty())
        return 0;
    std::size_t count = mesh.vertices.size();
    for (const auto& face : mesh.faces)
        count += face.size();
    return count;
}

// The sign of the determinant: 1, -1 for a mirror, or 0 if the transform flattens bodies. The scale does not matter.
int orientation_of(const Eigen::Affine3d& transform) {
    const double scale = transform.linear().cwiseAbs().maxCoeff();
    const double determinant = scale > 0 ? (transform.linear() / scale).determinant() : 0;
    return (determinant > 0) - (determinant < 0);
}

// A node with a place in the scene.
struct PlacedNode {
    std::size_t node;
    std::size_t next_child;
    Eigen::Affine3d to_scene;
    const std::string* name;
};

// Finds the places of all nodes with faces, and counts what they will take before anything is copied.
class ScenePaths {
public:
    explicit ScenePaths(const SceneGraph& scene)
        : scene_(scene), budget_(scene.file_size), is_on_path_(scene.nodes.size(), false) {
        std::vector<std::size_t> mesh_sizes; // many nodes may place one mesh
        mesh_sizes.reserve(scene.meshes.size());
        for (const PolygonSoup& mesh : scene.meshes)
            mesh_sizes.push_back(numbers_of(mesh));
        for (const SceneNode& node : scene.nodes) {
            sizes_.push_back(0);
            for (const std::size_t mesh : node.meshes)
                sizes_.back() += mesh_sizes[mesh];
        }
    }

    std::vector<PlacedNode> places() {
        static const std::string no_name = "part";
        for (const std::size_t root : scene_.roots) {
            push(root, Eigen::Affine3d::Identity(), no_name);
            while (!path_.empty())
                step();
        }
        return std::move(places_);
    }

private:
    // Moves to the next child of the last node of the path, or back.
    void step() {
        PlacedNode& last = path_.back();
        const std::vector<std::size_t>& children = scene_.nodes[last.node].children;
        if (last.next_child < children.size()) {
            const std::size_t child = children[last.next_child++];
            push(child, last.to_scene, *last.name);
        } else {
            is_on_path_[last.node] = false;
            path_.pop_back();
        }
    }

    // The transform is a copy, because the path grows here.
    void push(std::size_t index, Eigen::Affine3d to_scene, const std::string& name_above) {
        const SceneNode& node = scene_.nodes[index];
        const std::string& name = node.name.empty() ? name_above : node.name;
        if (is_on_path_[index])
            throw InvalidInput("node " + in_quotes(name) + " contains itself");
        if (++visited_ > most_nodes)
            throw InvalidInput("has more than 1,000,000 nodes, counting a node once for each path to it");
        to_scene = to_scene * node.to_parent;
        is_on_path_[index] = true;
        path_.push_back({index, 0, to_scene, &name});
        budget_.spend(sizes_[index]);
        if (sizes_[index] > 0)
            places_.push_back(path_.back());
    }

    const SceneGraph& scene_;
    SizeBudget budget_;
    std::vector<std::size_t> sizes_; ///< vertices and corners of each node
    std::vector<bool> is_on_path_;
    std::vector<PlacedNode> path_;
    std::size_t visited_ = 0;
    std::vector<PlacedNode> places_;
};

// The new number of each vertex that a face uses, in their order. Meshes of a file often share one list of vertices,
// and one that no face uses would make the body larger.
std::vector<std::uint32_t> numbers_of_used(const PolygonSoup& mesh, std::uint32_t first) {
    constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> numbers(mesh.vertices.size(), unused);
    for (const std::vector<std::uint32_t>& face : mesh.faces)
        for (const std::uint32_t corner : face)
            numbers[corner] = 0;
    for (std::uint32_t& number : numbers)
        number = number == unused ? unused : first++;
    return numbers;
}

// Appends a mesh in the coordinates of the scene.
void add_mesh(MeshPart& part, const PolygonSoup& mesh, const Eigen::Affine3d& to_scene) {
    const auto numbers = numbers_of_used(mesh, static_cast<std::uint32_t>(part.polygons.vertices.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Eigen::Vector3d vertex = to_scene * mesh.vertices[i];
        if (!vertex.allFinite())
            throw InvalidInput("node " + in_quotes(part.name) + ": NaN or infinity in its transform or its vertices");
        if (numbers[i] != std::numeric_limits<std::uint32_t>::max())
            part.polygons.vertices.push_back(vertex);
    }
    const int orientation = orientation_of(to_scene);
    if (orientation == 0)
        throw InvalidInput("node " + in_quotes(part.name) +
                           ": its transform flattens the mesh (a scale of 0); remove the node or scale it");
    for (std::vector<std::uint32_t> face : mesh.faces) {
        for (std::uint32_t& corner : face)
            corner = numbers[corner];
        if (orientation < 0)
            std::ranges::reverse(face);
        part.polygons.faces.push_back(std::move(face));
    }
}

// Makes names unique: the second "bolt" becomes "bolt_2", or the next number that no node of the file has as its name.
class UniqueNames {
public:
    explicit UniqueNames(std::vector<MeshPart>& parts) : parts_(parts) {
        for (MeshPart& part : parts_)
            given_.insert(part.name = one_line(valid_utf8(part.name)));
    }

    // In order: those parts whose node has this name itself, or those that have it from elsewhere.
    void settle(const std::vector<bool>& is_own, bool own) {
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (is_own[i] == own)
                settle(parts_[i].name);
    }

private:
    // The counters keep many equal names from being tried again and again.
    void settle(std::string& name) {
        if (used_.insert(name).second)
            return;
        const std::string given = name;
        std::size_t& number = last_number_.try_emplace(given, 1).first->second;
        do {
            name = given + "_" + std::to_string(++number);
        } while (given_.contains(name) || !used_.insert(name).second);
    }

    std::vector<MeshPart>& parts_;
    std::unordered_set<std::string> given_; ///< a name of the file stays with its owner
    std::unordered_set<std::string> used_;
    std::unordered_map<std::string, std::size_t> last_number_;
};

// Appends the polygons of a part.
void append_part(PolygonSoup& soup, PolygonSoup part) {
    if (soup.vertices.size() + part.vertices.size() >= std::numeric_limits<std::uint32_t>::max())
        throw InvalidInput("more than 4,294,967,294 vertices");
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (std::vector<std::uint32_t>& face : part.faces) {
        for (std::uint32_t& corner : face)
            corner += first;
        soup.faces.push_back(std::move(face));
    }
}

void add_triangle(PolygonSoup& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a)
        mesh.faces.push_back({a, b, c});
}

} // namespace

void add_triangle_strip(PolygonSoup& mesh, const std::vector<std::uint32_t>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) { // every second triangle is turned over
        const std::size_t odd = i % 2;
        add_triangle(mesh, corners[i - 2 + odd], corners[i - 1 - odd], corners[i]);
    }
}

void add_triangle_fan(PolygonSoup& mesh, const std::vector<std::uint32_t>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        add_triangle(mesh, corners[0], corners[i - 1], corners[i]);
}

SizeBudget::SizeBudget(std::size_t file_size) : most_(std::max(most_numbers, 4 * file_size)) {}

void SizeBudget::spend(std::size_t count) {
    if (count > most_ - spent_)
        throw InvalidInput("has more than " + std::to_string(most_) +
                           " vertices and corners of faces, counting a mesh once for each node that places it");
    spent_ += count;
}

std::vector<MeshPart> parts_of(const SceneGraph& scene) {
    const std::string unit = one_line(valid_utf8(scene.unit));
    std::vector<MeshPart> parts;
    std::vector<bool> is_own_name;
    for (const PlacedNode& place : ScenePaths(scene).places()) {
        is_own_name.push_back(place.name == &scene.nodes[place.node].name);
        MeshPart part{*place.name, {}, unit};
        for (const std::size_t mesh : scene.nodes[place.node].meshes)
            if (!scene.meshes[mesh].faces.empty())
                add_mesh(part, scene.meshes[mesh], place.to_scene);
        parts.push_back(std::move(part));
    }
    UniqueNames names(parts);
    names.settle(is_own_name, true);
    names.settle(is_own_name, false);
    return parts;
}

PolygonSoup merged(std::vector<MeshPart> parts) {
    if (parts.size() == 1)
        return std::move(parts.front().polygons);
    PolygonSoup soup;
    for (MeshPart& part : parts)
        append_part(soup, std::move(part.polygons));
    return soup;
}

} // namespace chasles::io
