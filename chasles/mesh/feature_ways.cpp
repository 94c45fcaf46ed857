#include "chasles/mesh/feature_ways.h"

#include "chasles/mesh/adjacent_directions.h"

#include <algorithm>
#include <numeric>

namespace chasles {

namespace {

using Eigen::Vector3d;

/// More directions take longer than they save.
constexpr std::size_t most_ways = 12;
/// A direction across an edge is reliable if the corner to which it leads is at least this part of the body's diameter
/// away from the edge (note 17).
constexpr double least_across = 0x1p-20;

/// Adds a direction once.
void add(std::vector<Vector3d>& ways, const Vector3d& way) {
    const Vector3d unit = way.stableNormalized();
    if (ways.size() < most_ways && std::ranges::find(ways, unit) == ways.end())
        ways.push_back(unit);
}

/// Appends a list with its mean first, and clears it.
void append(FlatLists<Vector3d>& lists, std::vector<Vector3d>& ways) {
    if (ways.size() > 1) {
        const Vector3d sum = std::accumulate(ways.begin(), ways.end(), Vector3d(0, 0, 0));
        ways.insert(ways.begin(), sum / double(ways.size()));
    }
    lists.append(ways);
    ways.clear();
}

void add_vertex(const Body& body, std::uint32_t vertex, std::vector<Vector3d>& ways) {
    any_direction_from_vertex(body, vertex, [&](const Vector3d& way) {
        add(ways, way);
        return false;
    });
}

void add_edge(const Body& body, const Edge& edge, std::vector<Vector3d>& ways) {
    any_direction_from_edge(body, edge, [&](const Vector3d& way) {
        if (way.norm() >= least_across * 2 * body.vertex_radius())
            add(ways, way);
        return false;
    });
}

} // namespace

FeatureWays feature_ways_of(const Body& body) {
    FeatureWays result;
    std::vector<Vector3d> ways;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        result.first_vertex.push_back(static_cast<std::uint32_t>(result.of_vertex.size()));
        result.first_edge.push_back(static_cast<std::uint32_t>(result.of_edge.size()));
        for (const std::uint32_t vertex : body.owned_vertices(face)) {
            add_vertex(body, vertex, ways);
            append(result.of_vertex, ways);
        }
        for (const Edge& edge : body.owned_edges(face)) {
            add_edge(body, edge, ways);
            append(result.of_edge, ways);
        }
    }
    return result;
}

} // namespace chasles
