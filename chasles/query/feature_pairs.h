// The elementary detections between features named by their ids, in any scalar.
#pragma once

#include "chasles/elementary/edge_edge.h"
#include "chasles/elementary/edge_through_face.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/screw_pose.h"

namespace chasles::query {

using algebra::FeasibleInterval;
using algebra::Vector3;

/// A face with its corners held, until another one is asked for.
template <class S>
class HeldFace {
public:
    const elementary::FaceShape<S>& hold(const Polyhedron& body, std::uint32_t face) {
        if (body_ == &body && face_ == face)
            return shape_;
        body_ = &body;
        face_ = face;
        corners_.clear();
        corners_.reserve(8); // those of most faces, at once
        for (const std::uint32_t vertex : body.face(face))
            corners_.push_back(point(body, vertex));
        shape_ = elementary::face_shape<S>(corners_, body.face_triangles(face));
        return shape_;
    }

    static Vector3<S> point(const Polyhedron& body, std::uint32_t vertex) {
        return motion::vector_in<S>(body.vertices()[vertex]);
    }

private:
    const Polyhedron* body_ = nullptr;
    std::uint32_t face_ = 0;
    std::vector<Vector3<S>> corners_;
    elementary::FaceShape<S> shape_;
};

/// Two bodies under one set of control maps.
template <class S>
class FeaturePairs {
public:
    FeaturePairs(const Polyhedron& moving, const Polyhedron& fixed, const elementary::Accuracy& accuracy)
        : moving_(moving), fixed_(fixed), accuracy_(accuracy) {}

    /// Sets the maps (kept by reference) and the tolerance of the interval that they run over.
    void use(const motion::ControlMaps<S>& maps, const algebra::Tolerance& tolerance) {
        maps_ = &maps;
        accuracy_.tolerance = tolerance;
    }

    std::optional<FeasibleInterval> vertex_face(std::uint32_t moving_vertex, std::uint32_t fixed_face) {
        const auto position = maps_->turn * HeldFace<S>::point(moving_, moving_vertex) + maps_->shift;
        return elementary::vertex_face<S>({position, maps_->weight}, face_.hold(fixed_, fixed_face), accuracy_,
                                          workspace_);
    }

    std::optional<FeasibleInterval> face_vertex(std::uint32_t moving_face, std::uint32_t fixed_vertex) {
        const auto position =
            maps_->turn.transposed() * HeldFace<S>::point(fixed_, fixed_vertex) - maps_->inverse_shift;
        return elementary::vertex_face<S>({position, maps_->weight}, face_.hold(moving_, moving_face), accuracy_,
                                          workspace_);
    }

    [[nodiscard]] elementary::EdgePath<S> path_of(const Edge& moving_edge) const {
        return elementary::edge_path(*maps_, HeldFace<S>::point(moving_, moving_edge.from),
                                     HeldFace<S>::point(moving_, moving_edge.to));
    }

    std::optional<FeasibleInterval> edge_edge(const elementary::EdgePath<S>& moving_edge, const Edge& fixed_edge) {
        const auto fixed = elementary::fixed_edge(HeldFace<S>::point(fixed_, fixed_edge.from),
                                                  HeldFace<S>::point(fixed_, fixed_edge.to));
        return elementary::edge_edge<S>(*maps_, moving_edge, fixed, accuracy_, workspace_);
    }

    /// At the start of the interval: a moving edge through a fixed face, in the fixed body's frame.
    std::optional<elementary::Passage<S>> moving_edge_passage(const Edge& edge, std::uint32_t fixed_face,
                                                              elementary::Ends ends) {
        const elementary::Segment<S> segment{start(maps_->turn, HeldFace<S>::point(moving_, edge.from), maps_->shift),
                                             start(maps_->turn, HeldFace<S>::point(moving_, edge.to), maps_->shift),
                                             maps_->weight[0]};
        return elementary::edge_through_face(segment, face_.hold(fixed_, fixed_face), accuracy_.scale, ends);
    }

    /// At the start of the interval: a fixed edge through a moving face, in the moving body's frame.
    std::optional<elementary::Passage<S>> fixed_edge_passage(const Edge& edge, std::uint32_t moving_face,
                                                             elementary::Ends ends) {
        const auto back = maps_->turn.transposed();
        const auto shift = Vector3<Polynomial>() - maps_->inverse_shift;
        const elementary::Segment<S> segment{start(back, HeldFace<S>::point(fixed_, edge.from), shift),
                                             start(back, HeldFace<S>::point(fixed_, edge.to), shift), maps_->weight[0]};
        return elementary::edge_through_face(segment, face_.hold(moving_, moving_face), accuracy_.scale, ends);
    }

    [[nodiscard]] const elementary::Workspace<S>& workspace() const { return workspace_; }

private:
    using Polynomial = algebra::Bernstein<3, S>;

    /// The first control point.
    static Vector3<S> start(const algebra::Matrix3<Polynomial>& turn, const Vector3<S>& point,
                            const Vector3<Polynomial>& shift) {
        Vector3<S> result;
        for (int i = 0; i < 3; ++i)
            result[i] =
                turn.row[i][0][0] * point.x + turn.row[i][1][0] * point.y + turn.row[i][2][0] * point.z + shift[i][0];
        return result;
    }

    const Polyhedron& moving_;
    const Polyhedron& fixed_;
    elementary::Accuracy accuracy_;
    const motion::ControlMaps<S>* maps_ = nullptr;
    HeldFace<S> face_;
    elementary::Workspace<S> workspace_;
};

} // namespace chasles::query
