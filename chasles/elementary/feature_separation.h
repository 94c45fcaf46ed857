// Proofs that two features stay farther apart than a distance during the whole motion, by one half-space each.
// Source: docs/derivations/16-margin.md, "Pruning". These tests are cubic; they reject nearly all pairs of features.
#pragma once

#include "chasles/elementary/edge_edge.h"

namespace chasles::elementary {

/// An edge at rest in the frame in which the path of a vertex is given.
template <class S>
struct RestingEdge {
    Vector3<S> from;      ///< c
    Vector3<S> direction; ///< v
    S size;               ///< |v|_1
    S square;             ///< |v|^2
};

template <class S>
RestingEdge<S> resting_edge(const Vector3<S>& from, const Vector3<S>& to) {
    const Vector3<S> v = to - from;
    return {from, v, norm1(v), dot(v, v)};
}

namespace detail {

template <class S>
using Cubic = Bernstein<3, S>;

/// The distance to be exceeded, and the errors of positions that the proof has to cover.
template <class S>
struct Separation {
    S distance;
    const ErrorScale& scale;
};

/// The position on a path at tau = 1/2.
template <class S>
Vector3<S> middle_position(const Vector3<Cubic<S>>& path, const Cubic<S>& weight) {
    return position_at<S>(path, weight, S(0.5));
}

/// part / whole, clamped to [0, 1]; 0 if the whole is 0.
template <class S>
S clamped_share(const S& part, const S& whole) {
    return part > S(0) ? part < whole ? S(part / whole) : S(1) : S(0);
}

/// The shortest vector to a point from the segment that starts at c with direction v.
template <class S>
Vector3<S> vector_from_segment(const Vector3<S>& c, const Vector3<S>& v, const Vector3<S>& point) {
    const Vector3<S> arm = point - c;
    return arm - scale(v, clamped_share<S>(dot(arm, v), dot(v, v)));
}

/// A short vector from the segment that starts at c with direction v to the segment that starts at a with direction u.
/// It is the shortest one if its ends are inside both segments.
template <class S>
Vector3<S> vector_between_segments(const Vector3<S>& c, const Vector3<S>& v, const Vector3<S>& a, const Vector3<S>& u) {
    const Vector3<S> arm = a - c;
    const S uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
    const S on_line = clamped_share<S>(uv * dot(v, arm) - vv * dot(u, arm), uu * vv - uv * uv);
    const Vector3<S> near = a + scale(u, on_line);
    const Vector3<S> foot = c + scale(v, clamped_share<S>(dot(near - c, v), vv));
    return scale(vector_from_segment(a, u, foot), S(-1));
}

/// The half-space n . p <= h + d |n| for a direction n, a distance d and a support h. All points of a feature satisfy
/// n . p <= h. Points outside the half-space are therefore farther than d from the feature, for any direction n.
template <class S>
class HalfSpace {
public:
    HalfSpace(const Vector3<S>& direction, const S& support, const Separation<S>& separation, const Cubic<S>& weight)
        : direction_(direction),
          limit_(weight * S(support + separation.distance * length(direction) +
                            with_underflow<S>(rounding_error<S>(separation.scale) * norm1(direction) * S(2)) +
                            height_deviation<S>(separation.scale, direction))) {}

    /// Whether the path is proven to stay outside.
    [[nodiscard]] bool excludes(const Vector3<Cubic<S>>& path) const {
        return is_positive(dot(path, direction_), limit_);
    }

private:
    Vector3<S> direction_;
    Cubic<S> limit_; ///< W (h + d |n|) and the error of n . p
};

/// The half-space of the segment that starts at c with direction v.
template <class S>
HalfSpace<S> half_space_of_segment(const Vector3<S>& c, const Vector3<S>& v, const Vector3<S>& direction,
                                   const Separation<S>& separation, const Cubic<S>& weight) {
    const S along = dot(direction, v);
    return {direction, dot(direction, c) + (along > S(0) ? along : S(0)), separation, weight};
}

// Each test tries one direction: the shortest vector between both features at tau = 1/2. Any direction gives a valid
// proof; a false answer proves nothing.

/// Whether a vertex is proven to stay farther than the distance from a point.
template <class S>
bool are_separated(const VertexPath<S>& path, const Vector3<S>& point, const Separation<S>& separation) {
    const Vector3<S> direction = middle_position(path.position, path.weight) - point;
    return HalfSpace<S>(direction, dot(direction, point), separation, path.weight).excludes(path.position);
}

/// Whether a vertex is proven to stay farther than the distance from an edge.
template <class S>
bool are_separated(const VertexPath<S>& path, const RestingEdge<S>& edge, const Separation<S>& separation) {
    const Vector3<S> direction =
        vector_from_segment(edge.from, edge.direction, middle_position(path.position, path.weight));
    return half_space_of_segment<S>(edge.from, edge.direction, direction, separation, path.weight)
        .excludes(path.position);
}

/// Whether two edges are proven to stay farther apart than the distance. Only this test separates parallel edges, for
/// which the distance test cannot decide.
template <class S>
bool are_separated(const EdgeMotion<S>& edges, const Separation<S>& separation) {
    const auto& [maps, moving, fixed] = edges;
    const Vector3<Cubic<S>> from = maps.rotation * moving.from + maps.translation;
    const Vector3<S> direction =
        vector_between_segments(fixed.from, fixed.direction, middle_position(from, maps.weight),
                                middle_position(moving.direction, maps.weight));
    const auto half_space = half_space_of_segment<S>(fixed.from, fixed.direction, direction, separation, maps.weight);
    return half_space.excludes(from) && half_space.excludes(from + moving.direction);
}

} // namespace detail

} // namespace chasles::elementary
