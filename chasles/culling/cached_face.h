// The shape of a face in any scalar, kept until another face is requested.
// Consecutive pairs of faces often share a face.
#pragma once

#include "chasles/elementary/face_shape.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/screw_path.h"

namespace chasles::culling {

using algebra::Vector3;

/// A vertex of a body in the scalar S.
template <class S>
Vector3<S> point_of(const Body& body, std::uint32_t vertex) {
    return motion::vector_in<S>(body.vertices()[vertex]);
}

/// The shape of the last requested face. It is computed once for consecutive requests of one face.
template <class S>
class CachedFace {
public:
    /// The shape is valid until the next call.
    const elementary::FaceShape<S>& shape_of(const Body& body, std::uint32_t face) {
        if (body_ == &body && face_ == face)
            return shape_;
        body_ = &body;
        face_ = face;
        corners_.clear();
        corners_.reserve(8); // one allocation suffices for most faces
        for (const std::uint32_t vertex : body.face(face))
            corners_.push_back(point_of<S>(body, vertex));
        shape_ = elementary::face_shape<S>(corners_, body.face_triangles(face));
        return shape_;
    }

private:
    const Body* body_ = nullptr;
    std::uint32_t face_ = 0;
    std::vector<Vector3<S>> corners_;
    elementary::FaceShape<S> shape_;
};

} // namespace chasles::culling
