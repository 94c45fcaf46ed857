// The side of a face's plane on which points of the other body stay during the whole motion. Faces and edges that stay
// on one side of the plane of a face do not touch this face.
// Source: docs/derivations/13-face-sides.md.
#pragma once

#include "chasles/elementary/vertex_face.h"
#include "chasles/motion/control_maps.h"

namespace chasles::elementary {

/// The plane of a face in the frame of the other body: W times the height over the plane is an affine function of a
/// point of the other body.
template <class S>
struct RelativePlane {
    using Polynomial = Bernstein<3, S>;
    Vector3<Polynomial> normal;
    Polynomial offset;
    Polynomial band; ///< the error of a height; the corners of the face are within the band

    /// 1 or -1 if the point is proven to stay on that side during the whole motion, otherwise 0.
    [[nodiscard]] int side_of(const Vector3<S>& point) const { return side(height_of(point), band); }

    /// The side during a part of the interval. `part_band` is the band restricted to the part.
    [[nodiscard]] int side_of(const Vector3<S>& point, const algebra::Restriction<3, S>& part,
                              const Polynomial& part_band) const {
        return side(part(height_of(point)), part_band);
    }

private:
    [[nodiscard]] Polynomial height_of(const Vector3<S>& point) const { return dot(normal, point) + offset; }
    static int side(const Polynomial& height, const Polynomial& error) {
        return is_positive(height, error) ? 1 : is_negative(height, error) ? -1 : 0;
    }
};

namespace detail {

template <class S>
RelativePlane<S> relative_plane(const Vector3<Bernstein<3, S>>& normal, const Bernstein<3, S>& height,
                                const Bernstein<3, S>& weight, const FaceShape<S>& face, const ErrorScale& scale,
                                const S& offset = S(0)) {
    const S error = height_error<S>(scale, face.normal, face.size) + face.deviation + offset;
    return {normal, height - weight * face.offset, weight * with_underflow<S>(error)};
}

} // namespace detail

/// The plane of a fixed face relative to the moving body. Points within a distance of `offset` / |normal| are on
/// neither side.
template <class S>
RelativePlane<S> plane_of_fixed_face(const motion::ControlMaps<S>& maps, const FaceShape<S>& face,
                                     const ErrorScale& scale, const S& offset = S(0)) {
    return detail::relative_plane<S>(maps.rotation.transposed() * face.normal, dot(maps.translation, face.normal),
                                     maps.weight, face, scale, offset);
}

/// The plane of a moving face relative to the fixed body. The scale is for the frame of the moving body.
template <class S>
RelativePlane<S> plane_of_moving_face(const motion::ControlMaps<S>& maps, const FaceShape<S>& face,
                                      const ErrorScale& scale, const S& offset = S(0)) {
    return detail::relative_plane<S>(maps.rotation * face.normal,
                                     Bernstein<3, S>() - dot(maps.inverse_translation, face.normal), maps.weight, face,
                                     scale, offset);
}

/// The plane of a face relative to its own body, at rest.
template <class S>
RelativePlane<S> plane_of_own_face(const FaceShape<S>& face, const ErrorScale& scale) {
    using Polynomial = Bernstein<3, S>;
    const Vector3<S>& n = face.normal;
    return detail::relative_plane<S>({Polynomial::constant(n.x), Polynomial::constant(n.y), Polynomial::constant(n.z)},
                                     Polynomial(), Polynomial::constant(S(1)), face, scale);
}

} // namespace chasles::elementary
