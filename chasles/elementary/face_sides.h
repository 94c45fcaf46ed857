// On which side of a face's plane are the points of the other body, all along the motion? Faces that lie on one side of
// another face's plane do not meet it, and neither do edges that do.
// Source: docs/derivations/13-face-sides.md.
#pragma once

#include "chasles/elementary/vertex_face.h"
#include "chasles/motion/control_maps.h"

namespace chasles::elementary {

/// W times the height over a face's plane as an affine function of a point of the other body, in that body's frame.
template <class S>
struct RelativePlane {
    using Polynomial = Bernstein<3, S>;
    Vector3<Polynomial> normal;
    Polynomial offset;
    Polynomial band; ///< heights are known to within it, and the face's own corners are

    /// 1 or -1 if the point is proven to be on that side all along, otherwise 0.
    [[nodiscard]] int side_of(const Vector3<S>& point) const { return side(height_of(point), band); }

    /// The same in a part of the interval; `band_there` is the band restricted to it.
    [[nodiscard]] int side_of(const Vector3<S>& point, const algebra::Restriction<3, S>& part,
                              const Polynomial& band_there) const {
        return side(part(height_of(point)), band_there);
    }

private:
    [[nodiscard]] Polynomial height_of(const Vector3<S>& point) const { return dot(normal, point) + offset; }
    static int side(const Polynomial& height, const Polynomial& error) {
        return is_positive(height, error) ? 1 : is_negative(height, error) ? -1 : 0;
    }
};

namespace detail {

template <class S>
RelativePlane<S> relative_plane(const Vector3<Bernstein<3, S>>& normal, const Bernstein<3, S>& shift,
                                const Bernstein<3, S>& weight, const FaceShape<S>& face, const ErrorScale& scale,
                                const S& reach = S(0)) {
    const S error = S(relative_error<S>(scale) * scale.length) * face.size + face.deviation + reach;
    return {normal, shift - weight * face.offset, weight * with_underflow<S>(error)};
}

} // namespace detail

/// The plane of a fixed face, seen by points of the moving body. Points up to `reach` away from it, times the length of
/// the face's normal, are on neither side.
template <class S>
RelativePlane<S> plane_of_fixed_face(const motion::ControlMaps<S>& maps, const FaceShape<S>& face,
                                     const ErrorScale& scale, const S& reach = S(0)) {
    return detail::relative_plane<S>(maps.rotation.transposed() * face.normal, dot(maps.translation, face.normal),
                                     maps.weight, face, scale, reach);
}

/// The plane of a moving face, seen by points of the fixed body.
template <class S>
RelativePlane<S> plane_of_moving_face(const motion::ControlMaps<S>& maps, const FaceShape<S>& face,
                                      const ErrorScale& scale, const S& reach = S(0)) {
    return detail::relative_plane<S>(maps.rotation * face.normal,
                                     Bernstein<3, S>() - dot(maps.inverse_translation, face.normal), maps.weight, face,
                                     scale, reach);
}

/// The plane of a face, seen by points of its own body: at rest.
template <class S>
RelativePlane<S> plane_of_own_face(const FaceShape<S>& face, const ErrorScale& scale) {
    using Polynomial = Bernstein<3, S>;
    const Vector3<S>& n = face.normal;
    return detail::relative_plane<S>({Polynomial::constant(n.x), Polynomial::constant(n.y), Polynomial::constant(n.z)},
                                     Polynomial(), Polynomial::constant(S(1)), face, scale);
}

} // namespace chasles::elementary
