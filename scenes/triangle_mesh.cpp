#include "scenes/triangle_mesh.h"

#include "chasles/base/invalid_input.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <utility>

namespace chasles::scenes {

namespace {

// The edges of the rim, keyed by their first vertex. An edge belongs to the rim if no triangle has the reverse edge.
std::multimap<Index, Index> open_edges(const TriangleMesh& mesh, double height) {
    std::map<std::pair<Index, Index>, int> balance;
    for (const Triangle& corner : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            ++balance[{corner[i], corner[(i + 1) % 3]}];
    }
    std::multimap<Index, Index> open;
    for (const auto& [edge, count] : balance) {
        const auto [from, to] = edge;
        const bool on_plane = mesh.vertices[from].z() == height && mesh.vertices[to].z() == height;
        if (on_plane && !balance.contains({to, from}))
            open.emplace(from, to);
    }
    return open;
}

// Cuts each triangle at the plane. Both triangles of an edge that crosses the plane share one new vertex.
class Cutter {
public:
    Cutter(const TriangleMesh& mesh, Side kept, double height, double snap)
        : result_{mesh.vertices, {}}, sign_(kept == Side::above ? 1 : -1), height_(height) {
        for (Eigen::Vector3d& vertex : result_.vertices) {
            if (std::abs(vertex.z() - height) < snap)
                vertex.z() = height;
        }
        for (const Triangle& triangle : mesh.triangles)
            add_kept_part(triangle);
    }

    TriangleMesh result() && { return std::move(result_); }

private:
    [[nodiscard]] double depth(Index vertex) const { return sign_ * (result_.vertices[vertex].z() - height_); }

    Index crossing(Index a, Index b) {
        const auto [entry, is_new] = crossings_.try_emplace(std::minmax(a, b), 0);
        if (is_new) {
            const double part = depth(entry->first.first) / (depth(entry->first.first) - depth(entry->first.second));
            const Eigen::Vector3d& from = result_.vertices[entry->first.first];
            const Eigen::Vector3d& to = result_.vertices[entry->first.second];
            Eigen::Vector3d point = from + part * (to - from);
            point.z() = height_;
            entry->second = result_.add(point);
        }
        return entry->second;
    }

    void add_kept_part(const Triangle& triangle) {
        if (std::ranges::all_of(triangle, [&](Index corner) { return depth(corner) <= 0; }))
            return;
        std::vector<Index> outline;
        for (int i = 0; i < 3; ++i) {
            const Index corner = triangle[i];
            const Index next = triangle[(i + 1) % 3];
            if (depth(corner) >= 0)
                outline.push_back(corner);
            if (depth(corner) * depth(next) < 0)
                outline.push_back(crossing(corner, next));
        }
        for (std::size_t i = 2; i < outline.size(); ++i) {
            result_.triangles.push_back({outline[0], outline[i - 1], outline[i]});
        }
    }

    TriangleMesh result_;
    std::map<std::pair<Index, Index>, Index> crossings_;
    double sign_;
    double height_;
};

// `loop`, rotated to start at the vertex nearest to `direction` and closed by repeating this vertex. All vertices are
// equally far from the axis.
std::vector<Index> started_at(const Eigen::Vector3d& direction, const TriangleMesh& mesh, std::vector<Index> loop) {
    const auto along = [&](Index corner) { return mesh.vertices[corner].head<2>().dot(direction.head<2>()); };
    std::ranges::rotate(loop, std::ranges::max_element(loop, {}, along));
    loop.push_back(loop.front());
    return loop;
}

} // namespace

Index TriangleMesh::add(const Eigen::Vector3d& vertex) {
    vertices.push_back(vertex);
    return static_cast<Index>(vertices.size() - 1);
}

Polyhedron TriangleMesh::polyhedron() const {
    constexpr Index unused = ~Index{0};
    std::vector<Index> number(vertices.size(), unused);
    std::vector<Eigen::Vector3d> points;
    std::vector<std::vector<Index>> faces;
    for (const Triangle& triangle : triangles) {
        std::vector<Index>& face = faces.emplace_back();
        for (const Index corner : triangle) {
            if (number[corner] == unused) {
                number[corner] = static_cast<Index>(points.size());
                points.push_back(vertices[corner]);
            }
            face.push_back(number[corner]);
        }
    }
    return Polyhedron::from_polygons(points, faces);
}

TriangleMesh cut_off(const TriangleMesh& mesh, Side kept, double height, double snap) {
    return Cutter(mesh, kept, height, snap).result();
}

std::vector<Index> rim(const TriangleMesh& mesh, double height) {
    const std::multimap<Index, Index> next = open_edges(mesh, height);
    std::vector<Index> loop;
    for (auto edge = next.begin(); edge != next.end() && loop.size() < next.size(); edge = next.find(edge->second)) {
        loop.push_back(edge->first);
        const bool is_round = edge->second == loop.front();
        if (is_round && loop.size() == next.size())
            return loop;
        if (is_round)
            break;
    }
    throw InvalidInput(fmt::format("surface: rim at z = {}: is not one closed loop", height));
}

void close_with_fan(TriangleMesh& mesh, const std::vector<Index>& rim) {
    const Index centre = mesh.add({0, 0, mesh.vertices[rim.front()].z()});
    for (std::size_t i = 0; i < rim.size(); ++i)
        mesh.triangles.push_back({rim[(i + 1) % rim.size()], rim[i], centre});
}

void close_with_ring(TriangleMesh& mesh, const std::vector<Index>& rim, const std::vector<Index>& outer) {
    const std::vector<Index> corners = started_at(mesh.vertices[rim.front()], mesh, outer);
    std::size_t at = 0;
    const auto join_outer_edge = [&](Index vertex) {
        mesh.triangles.push_back({corners[at], corners[at + 1], vertex});
        ++at;
    };
    const auto next_corner_is_nearer = [&](Index vertex) {
        return (mesh.vertices[corners[at + 1]] - mesh.vertices[corners[at]]).dot(mesh.vertices[vertex]) > 0;
    };
    for (std::size_t i = 0; i < rim.size(); ++i) {
        while (i > 0 && at + 1 < corners.size() && next_corner_is_nearer(rim[i]))
            join_outer_edge(rim[i]);
        mesh.triangles.push_back({rim[(i + 1) % rim.size()], rim[i], corners[at]});
    }
    while (at + 1 < corners.size())
        join_outer_edge(rim.front());
}

void flip(TriangleMesh& mesh) {
    for (Triangle& triangle : mesh.triangles)
        std::swap(triangle[1], triangle[2]);
}

std::string obj_text(const Polyhedron& body) {
    std::string text;
    for (const Eigen::Vector3d& vertex : body.vertices())
        text += fmt::format("v {} {} {}\n", vertex.x(), vertex.y(), vertex.z());
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        text += 'f';
        for (const Index corner : body.face(face))
            text += fmt::format(" {}", corner + 1);
        text += '\n';
    }
    return text;
}

} // namespace chasles::scenes
