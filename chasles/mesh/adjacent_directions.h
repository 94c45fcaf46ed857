// Ways that lead from a vertex or an edge into the surface around it.
#pragma once

#include "chasles/mesh/body.h"

#include <algorithm>

namespace chasles {

namespace detail {

/// Calls `see(a, b, c)` with the corner positions of convex parts of a face that have the given corner at a: triangles
/// of a face that is cut into them, otherwise the corner between its two neighbours. True as soon as that is.
template <class See>
bool any_part_at(const Body& body, std::uint32_t face, std::uint32_t vertex, See see) {
    const auto corners = body.face(face);
    const auto triangles = body.face_triangles(face);
    const std::size_t count = corners.size();
    for (std::size_t i = 0; triangles.empty() && i < count; ++i)
        if (corners[i] == vertex && see(corners[(i + 1) % count], corners[(i + count - 1) % count]))
            return true;
    for (std::size_t t = 0; t < triangles.size(); t += 3)
        for (std::size_t i = 0; i < 3; ++i)
            if (corners[triangles[t + i]] == vertex &&
                see(corners[triangles[t + (i + 1) % 3]], corners[triangles[t + (i + 2) % 3]]))
                return true;
    return false;
}

} // namespace detail

/// Whether `leads(way)` is true for some way along the rim of the faces around a vertex; every way into these faces is
/// a sum of two of them. Ways are of any length.
template <class Leads>
bool any_direction_from_vertex(const Body& body, std::uint32_t vertex, Leads leads) {
    const auto way_to = [&](std::uint32_t other) -> Eigen::Vector3d {
        return body.vertices()[other] - body.vertices()[vertex];
    };
    return std::ranges::any_of(body.faces_around(vertex), [&](std::uint32_t face) {
        return detail::any_part_at(body, face, vertex, [&](std::uint32_t next, std::uint32_t previous) {
            return leads(way_to(next)) || leads(way_to(previous));
        });
    });
}

/// Whether `leads(way)` is true for some way from an edge across one of its faces, at a right angle to the edge.
template <class Leads>
bool any_direction_from_edge(const Body& body, const Edge& edge, Leads leads) {
    const Eigen::Vector3d& from = body.vertices()[edge.from];
    const Eigen::Vector3d along = (body.vertices()[edge.to] - from).stableNormalized();
    const auto across_to = [&](std::uint32_t corner) -> Eigen::Vector3d {
        const Eigen::Vector3d arm = body.vertices()[corner] - from;
        return arm - along.dot(arm) * along;
    };
    const auto leads_into = [&](std::uint32_t face) {
        const auto corners = body.face(face);
        return detail::any_part_at(body, face, edge.from, [&](std::uint32_t next, std::uint32_t previous) {
            if (next != edge.to && previous != edge.to)
                return false;
            if (!body.face_triangles(face).empty())
                return leads(across_to(next == edge.to ? previous : next));
            const auto distance = [&](std::uint32_t corner) { return across_to(corner).squaredNorm(); };
            return leads(across_to(*std::ranges::max_element(corners, {}, distance)));
        });
    };
    return std::ranges::any_of(body.faces_around(edge.from), leads_into);
}

} // namespace chasles
