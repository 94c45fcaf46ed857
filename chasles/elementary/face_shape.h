// The input of the elementary tests for a face: corners, a normal, and the deviation of the corners from one plane.
// Source: docs/derivations/03-vertex-face.md.
#pragma once

#include "chasles/algebra/vector.h"
#include "chasles/elementary/error_scale.h"

#include <cstdint>
#include <span>

namespace chasles::elementary {

using algebra::Vector3;

/// A planar face in the frame of its body. Triangles cover a face that is not convex.
template <class S>
struct FaceShape {
    std::span<const Vector3<S>> corners; ///< the outline, at least three corners
    std::span<const std::uint32_t>
        triangles;     ///< positions of corners, three for each triangle; empty if the face is convex
    Vector3<S> normal; ///< of any length, by Newell's method
    S offset{};        ///< normal . corners[0]
    S size{};          ///< at least |normal|_1; the rounding of the normal is proportional to it
    S deviation{};     ///< |normal . (corner - corners[0])| <= deviation for all corners
};

/// Computes the normal by Newell's method as a sum over the fan of triangles at the first corner. For a triangle the
/// only error is the rounding of one cross product.
template <class S>
FaceShape<S> face_shape(std::span<const Vector3<S>> corners, std::span<const std::uint32_t> triangles) {
    FaceShape<S> face{corners, triangles, {}, S(0), S(0), S(0)};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const Vector3<S> a = corners[i] - corners[0];
        const Vector3<S> b = corners[i + 1] - corners[0];
        face.normal = face.normal + cross(a, b);
        face.size = face.size + norm1(a) * norm1(b);
    }
    face.offset = dot(face.normal, corners[0]);
    if (corners.size() == 3)
        return face;
    for (const Vector3<S>& corner : corners) {
        const Vector3<S> arm = corner - corners[0];
        const S height = dot(face.normal, arm);
        const S magnitude =
            (height < S(0) ? S(S(0) - height) : height) + S(error_unit<S> / 10) * face.size * norm1(arm);
        face.deviation = face.deviation < magnitude ? magnitude : face.deviation;
    }
    return face;
}

/// One convex part of a face: the whole face, or one of the triangles that cover it.
template <class S>
struct ConvexPart {
    const FaceShape<S>& face;
    std::size_t first = 0; ///< position of its first corner in face.triangles
    std::size_t count = 0; ///< of its corners, at least three

    const Vector3<S>& corner(std::size_t i) const {
        return face.triangles.empty() ? face.corners[i] : face.corners[face.triangles[first + i]];
    }
    /// The corner at the other end of the edge that starts at corner i.
    const Vector3<S>& next_corner(std::size_t i) const { return corner(i + 1 == count ? 0 : i + 1); }
};

/// Whether the face has no area by its corners a, b, b. No point is on such a face; its edges and vertices have tests
/// of their own (docs/derivations/22-faces-without-area.md).
template <class S>
bool is_segment(const FaceShape<S>& face) {
    const auto equal = [](const S& a, const S& b) { return !(a < b) && !(b < a); };
    const Vector3<S>& a = face.corners[1];
    const Vector3<S>& b = face.corners[2];
    return face.corners.size() == 3 && equal(a.x, b.x) && equal(a.y, b.y) && equal(a.z, b.z);
}

template <class S>
std::size_t convex_part_count(const FaceShape<S>& face) {
    if (!face.triangles.empty())
        return face.triangles.size() / 3;
    return is_segment(face) ? 0 : 1;
}
template <class S>
ConvexPart<S> convex_part(const FaceShape<S>& face, std::size_t index) {
    return {face, 3 * index, face.triangles.empty() ? face.corners.size() : 3};
}

} // namespace chasles::elementary
