// Does an edge pass through a face at one instant? Tells bodies that overlap at the start from bodies that are apart.
// Source: docs/derivations/05-being-inside.md, last section.
#pragma once

#include "chasles/elementary/face_shape.h"

#include <optional>

namespace chasles::elementary {

/// A segment in the frame of the face's body, times a positive weight.
template <class S>
struct Segment {
    Vector3<S> from;
    Vector3<S> to;
    S weight{1};
};

/// Where an edge passes through a face.
template <class S>
struct Passage {
    Vector3<S> point;     ///< over the weight; an end of the segment in scalars without division
    bool certain = false; ///< proven; otherwise the edge may just miss the rim
};

/// Which segments to ask about.
enum class Ends : std::uint8_t {
    not_proven_on_one_side, ///< a filter: also segments that may only touch the plane; `certain` says nothing then
    proven_opposite,        ///< the answer: an end on the plane is left to vertex/face
};

namespace detail {

/// A segment with ends that are ordered to run along the face's normal.
template <class S>
struct Way {
    const Segment<S>& segment;
    bool upwards;
    Ends ends;
};

/// Signed volumes of the segment with each edge of a convex part of the face: all non-negative if it passes inside.
/// Where the ends are not proven on opposite sides, the place in the plane says nothing, and the volumes are only as
/// good as the ends times the distance of the face's edge.
template <class S, class CornerAt>
std::optional<bool> passes(const Way<S>& way, std::size_t count, CornerAt corner_at, const S& unit) {
    const Segment<S>& segment = way.segment;
    const Vector3<S> u = way.upwards ? segment.to - segment.from : segment.from - segment.to;
    bool certain = true;
    for (std::size_t i = 0; i < count; ++i) {
        const Vector3<S>& from = corner_at(i);
        const Vector3<S> v = corner_at(i + 1 == count ? 0 : i + 1) - from;
        const Vector3<S> arm = scale(from, segment.weight) - segment.from;
        const S volume = dot(cross(arm, v), u);
        const S size = way.ends == Ends::proven_opposite ? norm1(u) : S(norm1(u) + norm1(arm));
        const S error = with_underflow<S>(unit * size * norm1(v));
        if (volume < S(0) - error)
            return std::nullopt;
        certain = certain && volume > error;
    }
    return certain;
}

/// Whether the segment and the hull of the face's corners are proven apart along a direction, however long.
template <class S>
bool are_apart_along(const Vector3<S>& direction, const Segment<S>& segment, const FaceShape<S>& face, const S& unit) {
    const Vector3<S> anchor = scale(face.corners[0], segment.weight);
    const S from = dot(direction, segment.from - anchor);
    const S to = dot(direction, segment.to - anchor);
    S lower(0), upper(0); // of the corners
    for (const Vector3<S>& corner : face.corners) {
        const S height = dot(direction, corner - face.corners[0]) * segment.weight;
        lower = height < lower ? height : lower;
        upper = upper < height ? height : upper;
    }
    const S error = with_underflow<S>(unit * norm1(direction) * segment.weight);
    return (from > upper + error && to > upper + error) || (from < lower - error && to < lower - error);
}

/// The same for directions in the face's plane: across the segment and across each side of the face.
template <class S>
bool are_apart_in_plane(const Segment<S>& segment, const FaceShape<S>& face, const S& unit) {
    if (are_apart_along<S>(cross(face.normal, segment.to - segment.from), segment, face, unit))
        return true;
    const std::size_t count = face.corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Vector3<S> side = face.corners[i + 1 == count ? 0 : i + 1] - face.corners[i];
        if (are_apart_along<S>(cross(face.normal, side), segment, face, unit))
            return true;
    }
    return false;
}

} // namespace detail

/// Whether the segment may go through the face. `bounds` as for the detections.
template <class S>
std::optional<Passage<S>> edge_through_face(const Segment<S>& segment, const FaceShape<S>& face,
                                            const ErrorScale& bounds, Ends ends = Ends::proven_opposite) {
    const S unit(relative_error<S>(bounds) * bounds.length);
    const S band = with_underflow<S>(unit * face.size + face.deviation);
    const S limit = (ends == Ends::proven_opposite ? band : S(0) - band) * segment.weight;
    const Vector3<S> anchor = scale(face.corners[0], segment.weight);
    const S from = dot(face.normal, segment.from - anchor);
    const S to = dot(face.normal, segment.to - anchor);
    const bool upwards = from < S(0) - limit && to > limit;
    const bool downwards = to < S(0) - limit && from > limit;
    // In the plane or next to it volumes tell nothing.
    if (upwards && downwards && detail::are_apart_in_plane(segment, face, unit))
        return std::nullopt;
    const auto passes = [&](std::size_t count, auto corner_at) {
        auto found = upwards ? detail::passes<S>({segment, true, ends}, count, corner_at, unit) : std::nullopt;
        return !found && downwards ? detail::passes<S>({segment, false, ends}, count, corner_at, unit) : found;
    };
    const auto passage = [&](bool certain) {
        S share(0);
        if constexpr (algebra::Divisible<S>) {
            const S height = from - to;
            share = height < S(0) || height > S(0) ? S(from / height) : S(0);
        }
        return Passage<S>{segment.from + scale(segment.to - segment.from, share), certain};
    };
    if (face.triangles.empty()) {
        const auto found =
            passes(face.corners.size(), [&](std::size_t i) -> const Vector3<S>& { return face.corners[i]; });
        return found ? std::optional(passage(*found)) : std::nullopt;
    }
    for (std::size_t t = 0; t < face.triangles.size(); t += 3) {
        const auto found =
            passes(3, [&](std::size_t i) -> const Vector3<S>& { return face.corners[face.triangles[t + i]]; });
        if (found)
            return passage(*found);
    }
    return std::nullopt;
}

} // namespace chasles::elementary
