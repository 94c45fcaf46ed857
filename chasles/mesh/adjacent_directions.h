// The directions from a vertex or an edge of a body into the adjacent faces.
// The contact layer tests with them whether a motion leads into a face.
#pragma once

#include "chasles/mesh/body.h"

#include <algorithm>

namespace chasles {

namespace detail {

/// Calls `visit(next, previous)` with the vertices next to the given vertex in each convex part of a face: in the
/// triangles of a face that is not convex, otherwise in the outline. Stops and returns true as soon as a call returns
/// true.
template <class Visit>
bool any_part_at(const Body& body, std::uint32_t face, std::uint32_t vertex, Visit visit) {
    const auto corners = body.face(face);
    const auto triangles = body.face_triangles(face);
    const std::size_t count = corners.size();
    for (std::size_t i = 0; triangles.empty() && i < count; ++i)
        if (corners[i] == vertex && visit(corners[(i + 1) % count], corners[(i + count - 1) % count]))
            return true;
    for (std::size_t t = 0; t < triangles.size(); t += 3)
        for (std::size_t i = 0; i < 3; ++i)
            if (corners[triangles[t + i]] == vertex &&
                visit(corners[triangles[t + (i + 1) % 3]], corners[triangles[t + (i + 2) % 3]]))
                return true;
    return false;
}

} // namespace detail

/// Whether `test(direction)` is true for some direction from a vertex along the rim of an adjacent face. Every
/// direction into these faces is a non-negative combination of two of these directions. Directions have any length.
template <class Test>
bool any_direction_from_vertex(const Body& body, std::uint32_t vertex, Test test) {
    const auto direction_to = [&](std::uint32_t other) -> Eigen::Vector3d {
        return body.vertices()[other] - body.vertices()[vertex];
    };
    return std::ranges::any_of(body.faces_around(vertex), [&](std::uint32_t face) {
        return detail::any_part_at(body, face, vertex, [&](std::uint32_t next, std::uint32_t previous) {
            return (next != vertex && test(direction_to(next))) || (previous != vertex && test(direction_to(previous)));
        });
    });
}

/// Whether `test(direction)` is true for some direction from an edge across one of its faces, perpendicular to the
/// edge. Directions have any length. A segment has no directions across its edge.
template <class Test>
bool any_direction_from_edge(const Body& body, const Edge& edge, Test test) {
    const Eigen::Vector3d& from = body.vertices()[edge.from];
    const Eigen::Vector3d along = (body.vertices()[edge.to] - from).stableNormalized();
    const auto across_to = [&](std::uint32_t corner) -> Eigen::Vector3d {
        const Eigen::Vector3d arm = body.vertices()[corner] - from;
        return arm - along.dot(arm) * along;
    };
    const auto tests_into = [&](std::uint32_t face) {
        if (body.is_segment(face))
            return false;
        const auto corners = body.face(face);
        return detail::any_part_at(body, face, edge.from, [&](std::uint32_t next, std::uint32_t previous) {
            if (next != edge.to && previous != edge.to)
                return false;
            if (!body.face_triangles(face).empty())
                return test(across_to(next == edge.to ? previous : next));
            const auto distance = [&](std::uint32_t corner) { return across_to(corner).squaredNorm(); };
            return test(across_to(*std::ranges::max_element(corners, {}, distance)));
        });
    };
    return std::ranges::any_of(body.faces_around(edge.from), tests_into);
}

} // namespace chasles
