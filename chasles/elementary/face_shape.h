// A face as the elementary detections see it: corners, a normal, and how far its corners are off one plane.
#pragma once

#include "chasles/algebra/vector.h"
#include "chasles/elementary/error_scale.h"

#include <cstdint>
#include <span>

namespace chasles::elementary {

using algebra::Vector3;

/// A planar face in its body's frame. A convex one is covered as it stands, any other by its triangles.
template <class S>
struct FaceShape {
    std::span<const Vector3<S>> corners;      ///< the outline, at least three
    std::span<const std::uint32_t> triangles; ///< corner positions, three by three; empty if convex
    Vector3<S> normal;                        ///< of any length, by Newell's sum
    S offset{};                               ///< normal . corners[0]
    S size{};                                 ///< at least |normal|_1, and the scale of its rounding
    S deviation{};                            ///< all corners have |normal . (corner - corners[0])| <= deviation
};

/// Newell's normal as a sum over the fan of triangles at the first corner, which is exact for one triangle up to the
/// rounding of one cross product.
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
        const S off = (height < S(0) ? S(S(0) - height) : height) + S(error_unit<S> / 10) * face.size * norm1(arm);
        face.deviation = face.deviation < off ? off : face.deviation;
    }
    return face;
}

} // namespace chasles::elementary
