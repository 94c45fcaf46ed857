// A test whether an edge passes through a face at one instant. It detects bodies that overlap at the start of a motion.
// Source: docs/derivations/05-being-inside.md, last section.
#pragma once

#include "chasles/elementary/face_shape.h"

#include <optional>

namespace chasles::elementary {

/// A segment in the frame of the face's body; `from` and `to` are the weight times the ends.
template <class S>
struct Segment {
    Vector3<S> from;
    Vector3<S> to;
    S weight{1}; ///< positive
};

/// The point at which an edge passes through a face.
template <class S>
struct Passage {
    Vector3<S> point;     ///< times the weight; `Segment::from` for scalars without division
    bool certain = false; ///< the passage is proven; otherwise the edge may barely miss the rim of the face
};

/// The segments that the test accepts, by the sides of their ends on the plane of the face.
enum class Ends : std::uint8_t {
    not_proven_on_one_side, ///< for a filter: also segments that may only touch the plane; `certain` is meaningless
    proven_opposite,        ///< for the answer: ends on the plane are left to the vertex and face test
};

namespace detail {

/// A segment with a direction along the face's normal.
template <class S>
struct OrientedSegment {
    const Segment<S>& segment;
    bool upwards; ///< `from` is below the face, `to` above
    Ends ends;
};

/// Whether the segment passes through a convex part of a face: all signed volumes of the segment with the edges of the
/// part must be non-negative. Empty if one volume is proven negative; true if all are proven positive. If the ends are
/// not proven on opposite sides, the error of a volume also contains the distance from the end to the edge.
template <class S>
std::optional<bool> passes(const OrientedSegment<S>& oriented, const ConvexPart<S>& part, const S& unit) {
    const Segment<S>& segment = oriented.segment;
    const Vector3<S> u = oriented.upwards ? segment.to - segment.from : segment.from - segment.to;
    bool certain = true;
    for (std::size_t i = 0; i < part.count; ++i) {
        const Vector3<S>& from = part.corner(i);
        const Vector3<S> v = part.next_corner(i) - from;
        const Vector3<S> arm = scale(from, segment.weight) - segment.from;
        const S volume = dot(cross(arm, v), u);
        const S size = oriented.ends == Ends::proven_opposite ? norm1(u) : S(norm1(u) + norm1(arm));
        const S error = with_underflow<S>(unit * size * norm1(v));
        if (volume < S(0) - error)
            return std::nullopt;
        certain = certain && volume > error;
    }
    return certain;
}

/// Whether a direction of any length separates the segment from a convex part of a face.
template <class S>
bool are_apart_along(const Vector3<S>& direction, const Segment<S>& segment, const ConvexPart<S>& part, const S& unit) {
    const Vector3<S> anchor = scale(part.corner(0), segment.weight);
    const S from = dot(direction, segment.from - anchor);
    const S to = dot(direction, segment.to - anchor);
    S lower(0), upper(0); // heights of the corners
    for (std::size_t i = 1; i < part.count; ++i) {
        const S height = dot(direction, part.corner(i) - part.corner(0)) * segment.weight;
        lower = height < lower ? height : lower;
        upper = upper < height ? height : upper;
    }
    const S error = with_underflow<S>(unit * norm1(direction) * segment.weight);
    return (from > upper + error && to > upper + error) || (from < lower - error && to < lower - error);
}

/// Whether a direction at a right angle to `normal` separates both: across the segment or across a side of the part.
template <class S>
bool are_apart_in_plane(const Segment<S>& segment, const ConvexPart<S>& part, const Vector3<S>& normal, const S& unit) {
    if (are_apart_along<S>(cross(normal, segment.to - segment.from), segment, part, unit))
        return true;
    for (std::size_t i = 0; i < part.count; ++i)
        if (are_apart_along<S>(cross(normal, part.next_corner(i) - part.corner(i)), segment, part, unit))
            return true;
    return false;
}

/// The point at height zero, for heights of both ends over the plane.
template <class S>
Vector3<S> point_at_plane(const Segment<S>& segment, const S& from, const S& to) {
    S share(0);
    if constexpr (algebra::Divisible<S>) {
        const S height = from - to;
        share = height < S(0) || height > S(0) ? S(from / height) : S(0);
    }
    return segment.from + scale(segment.to - segment.from, share);
}

} // namespace detail

/// The passage of the segment through the face, if the segment may pass. `bounds` has the same meaning as for the
/// elementary tests.
template <class S>
std::optional<Passage<S>> edge_through_face(const Segment<S>& segment, const FaceShape<S>& face,
                                            const ErrorScale& bounds, Ends ends = Ends::proven_opposite) {
    const S unit = position_error<S>(bounds);
    const S band = with_underflow<S>(unit * face.size + face.deviation);
    const S limit = (ends == Ends::proven_opposite ? band : S(0) - band) * segment.weight;
    const Vector3<S> anchor = scale(face.corners[0], segment.weight);
    const S from = dot(face.normal, segment.from - anchor);
    const S to = dot(face.normal, segment.to - anchor);
    const bool upwards = from < S(0) - limit && to > limit;
    const bool downwards = to < S(0) - limit && from > limit;
    const bool is_in_plane = upwards && downwards; // or next to it: the signed volumes separate nothing
    for (std::size_t i = 0, count = convex_part_count(face); i < count; ++i) {
        const ConvexPart<S> part = convex_part(face, i);
        if (is_in_plane && detail::are_apart_in_plane(segment, part, face.normal, unit))
            continue;
        for (const bool up : {true, false}) {
            if (!(up ? upwards : downwards))
                continue;
            const std::optional<bool> certain = detail::passes<S>({segment, up, ends}, part, unit);
            if (!certain)
                continue;
            const bool may_be_beside = !is_in_plane && !*certain; // nearly in the plane
            if (may_be_beside && detail::are_apart_in_plane(segment, part, face.normal, unit))
                break;
            return Passage<S>{detail::point_at_plane(segment, from, to), *certain};
        }
    }
    return std::nullopt;
}

} // namespace chasles::elementary
