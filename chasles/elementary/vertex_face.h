// When does a vertex first meet a face? Also for a fixed vertex and a moving face, seen from the face's body.
// Source: paper sections 3.2.1 to 3.2.4; docs/derivations/03-vertex-face.md and 05-being-inside.md.
#pragma once

#include "chasles/algebra/first_feasible.h"
#include "chasles/elementary/face_shape.h"

#include <optional>
#include <vector>

namespace chasles::elementary {

using algebra::Bernstein;
using algebra::Bounded;
using algebra::Constraint;
using algebra::FeasibleInterval;

/// A vertex along the motion as W times its position, in the frame of the face's body.
template <class S>
struct VertexPath {
    const Vector3<Bernstein<3, S>>& position;
    const Bernstein<3, S>& weight;
};

/// What a detection is allowed to be off, and when it may stop.
struct Accuracy {
    ErrorScale scale;
    algebra::Tolerance tolerance; ///< of the interval that the paths run over
};

/// Room for constraints and counts of what was done; owned by the caller, so that detections do not allocate.
template <class S>
struct Workspace {
    std::vector<Constraint<3, S>> constraints;
    std::uint64_t elementary_tests = 0;
    std::uint64_t root_brackets = 0;
};

namespace detail {

/// direction . (position - W anchor), which is W times the height of the vertex over a plane.
template <class S>
Bernstein<3, S> height(const VertexPath<S>& path, const Vector3<S>& direction, const Vector3<S>& anchor) {
    const Vector3<Bernstein<3, S>> arm{path.position.x - path.weight * anchor.x,
                                       path.position.y - path.weight * anchor.y,
                                       path.position.z - path.weight * anchor.z};
    return dot(arm, direction);
}

/// W times the height of the vertex over the face's plane.
template <class S>
Bounded<3, S> plane(const VertexPath<S>& path, const FaceShape<S>& face, const S& unit) {
    return {height(path, face.normal, face.corners[0]), with_underflow<S>(unit * face.size + face.deviation)};
}

/// Positive on the inner side of one edge of the face.
template <class S>
Bounded<3, S> inside(const VertexPath<S>& path, const FaceShape<S>& face, const Vector3<S>& from, const Vector3<S>& to,
                     const S& unit) {
    const Vector3<S> edge = to - from;
    return {height(path, cross(face.normal, edge), from), with_underflow<S>(unit * face.size * norm1(edge))};
}

/// The vertex is within the three or more edges of a convex part of the face; false if proven outside all along.
template <class S, class CornerAt>
bool add_inside_constraints(const VertexPath<S>& path, const FaceShape<S>& face, std::size_t count, CornerAt corner_at,
                            const S& unit, std::vector<Constraint<3, S>>& constraints) {
    constraints.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const Bounded<3, S> side = inside(path, face, corner_at(i), corner_at(i + 1 == count ? 0 : i + 1), unit);
        if (is_negative(side.polynomial, path.weight * side.error))
            return false;
        constraints.push_back({side, {}, false});
    }
    return true;
}

} // namespace detail

/// The first tau in [0, 1] at which the vertex may be on the closed face; empty if it is proven never to be.
template <class S>
std::optional<FeasibleInterval> vertex_face(const VertexPath<S>& path, const FaceShape<S>& face,
                                            const Accuracy& accuracy, Workspace<S>& workspace) {
    ++workspace.elementary_tests;
    const S unit(relative_error<S>(accuracy.scale) * accuracy.scale.length);
    const Bounded<3, S> plane = detail::plane(path, face, unit);
    const Bernstein<3, S> band = path.weight * plane.error;
    if (is_positive(plane.polynomial, band) || is_negative(plane.polynomial, band))
        return std::nullopt;
    const auto solve = [&](std::size_t count, auto corner_at) -> std::optional<FeasibleInterval> {
        if (!detail::add_inside_constraints(path, face, count, corner_at, unit, workspace.constraints))
            return std::nullopt;
        ++workspace.root_brackets;
        return algebra::first_feasible<3, S>({path.weight, plane, workspace.constraints}, accuracy.tolerance);
    };
    if (face.triangles.empty())
        return solve(face.corners.size(), [&](std::size_t i) -> const Vector3<S>& { return face.corners[i]; });
    std::optional<FeasibleInterval> first;
    for (std::size_t t = 0; t < face.triangles.size(); t += 3) {
        const auto found =
            solve(3, [&](std::size_t i) -> const Vector3<S>& { return face.corners[face.triangles[t + i]]; });
        if (found && (!first || found->lower < first->lower))
            first = found;
    }
    return first;
}

} // namespace chasles::elementary
