// Proofs by a direction that a vertex and a face, or two edges, stay farther apart than a distance. The error bound is
// a length: unlike the bounds of the elementary tests it is not divided by the area of a face or by the sine of an
// angle, so slivers and nearly parallel edges are separated like all others. Source: docs/derivations/34-slivers.md.
#pragma once

#include "chasles/elementary/distance_tests.h"

namespace chasles::elementary {

namespace detail {

/// A direction without its component along an edge. The difference is perpendicular to the edge to within rounding.
template <class S>
Vector3<S> without_component(const Vector3<S>& direction, const Vector3<S>& edge) {
    const S square = dot(edge, edge);
    return square > S(0) ? direction - scale(edge, S(dot(direction, edge) / square)) : direction;
}

/// A direction perpendicular to two vectors. It is as perpendicular to both as rounding allows, however small their
/// angle is.
template <class S>
Vector3<S> across(const Vector3<S>& a, const Vector3<S>& b) {
    return without_component<S>(cross(a, b), dot(a, a) < dot(b, b) ? b : a);
}

/// Turns a direction to the side on which a vector points.
template <class S>
Vector3<S> turned_towards(const Vector3<S>& direction, const Vector3<S>& vector) {
    return dot(direction, vector) < S(0) ? scale(direction, S(-1)) : direction;
}

/// The shortest vector from the rim of a convex part to a point.
template <class S>
Vector3<S> vector_from_rim(const ConvexPart<S>& part, const Vector3<S>& point) {
    Vector3<S> nearest = point - part.corner(0);
    for (std::size_t i = 0; i < part.count; ++i) {
        const Vector3<S> side = part.next_corner(i) - part.corner(i);
        const Vector3<S> arm = point - part.corner(i);
        const S along = dot(arm, side);
        const bool is_beside = along > S(0) && along < dot(side, side);
        const Vector3<S> vector =
            is_beside ? without_component<S>(without_component<S>(arm, side), side) : arm; // twice: the arm may be long
        if (dot(vector, vector) < dot(nearest, nearest))
            nearest = vector;
    }
    return nearest;
}

/// The normal of a face, made perpendicular to the longest side of a convex part. A normal that is off by some angle
/// then turns the part about this side only, which moves no corner of a sliver by much.
template <class S>
Vector3<S> normal_along_longest_side(const ConvexPart<S>& part) {
    Vector3<S> longest = part.next_corner(0) - part.corner(0);
    for (std::size_t i = 1; i < part.count; ++i) {
        const Vector3<S> side = part.next_corner(i) - part.corner(i);
        if (dot(longest, longest) < dot(side, side))
            longest = side;
    }
    return without_component<S>(part.face.normal, longest);
}

/// The half-space of a convex part. A face that is not convex may be as thick as its deviation.
template <class S>
HalfSpace<S> half_space_of_part(const ConvexPart<S>& part, const Vector3<S>& direction, Separation<S> separation,
                                const Cubic<S>& weight) {
    S support = dot(direction, part.corner(0));
    for (std::size_t i = 1; i < part.count; ++i)
        support = std::max<S>(support, dot(direction, part.corner(i)));
    if (!part.face.triangles.empty())
        separation.distance = separation.distance + S(2.25) * part.face.deviation / length(part.face.normal);
    return {direction, support, separation, weight};
}

/// Whether a vertex is proven to stay farther than the distance from a convex part of a face.
template <class S>
bool is_apart(const VertexPath<S>& path, const ConvexPart<S>& part, const Separation<S>& separation) {
    const Vector3<S> middle = middle_position(path.position, path.weight);
    const Vector3<S> from_rim = vector_from_rim<S>(part, middle);
    const auto excludes = [&](const Vector3<S>& direction) {
        return half_space_of_part<S>(part, direction, separation, path.weight).excludes(path.position);
    };
    return excludes(from_rim) || excludes(turned_towards<S>(normal_along_longest_side(part), from_rim));
}

} // namespace detail

// Each test tries two directions. Any direction gives a valid proof; a false answer proves nothing.

/// Whether a vertex is proven to stay farther than the distance from a face.
template <class S>
bool are_apart(const VertexPath<S>& path, const FaceShape<S>& face, const S& distance, const Accuracy& accuracy) {
    const auto separation = detail::Separation<S>{distance, accuracy.scale};
    for (std::size_t i = 0, count = convex_part_count(face); i < count; ++i)
        if (!detail::is_apart<S>(path, convex_part(face, i), separation))
            return false;
    return true;
}

/// Whether two edges are proven to stay farther apart than the distance.
template <class S>
bool are_apart(const EdgeMotion<S>& edges, const S& distance, const Accuracy& accuracy) {
    const auto& [maps, moving, fixed] = edges;
    const Vector3<Bernstein<3, S>> from = maps.rotation * moving.from + maps.translation;
    const Vector3<S> along = detail::middle_position(moving.direction, maps.weight);
    const Vector3<S> between = detail::vector_between_segments<S>(fixed.from, fixed.direction,
                                                                  detail::middle_position(from, maps.weight), along);
    const auto separation = detail::Separation<S>{distance, accuracy.scale};
    const auto excludes = [&](const Vector3<S>& direction) {
        const auto half_space =
            detail::half_space_of_segment<S>(fixed.from, fixed.direction, direction, separation, maps.weight);
        return half_space.excludes(from) && half_space.excludes(from + moving.direction);
    };
    return excludes(between) || excludes(detail::turned_towards<S>(detail::across(along, fixed.direction), between));
}

} // namespace chasles::elementary
