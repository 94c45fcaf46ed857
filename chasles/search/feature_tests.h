// The elementary tests between features named by their ids, in any scalar: when they touch, and when they come within a
// distance. Source: docs/derivations/03-vertex-face.md, 04-edge-edge.md, 16-margin.md and 34-slivers.md.
#pragma once

#include "chasles/contact/feature_pair.h"
#include "chasles/culling/cached_face.h"
#include "chasles/elementary/direction_tests.h"
#include "chasles/elementary/distance_tests.h"
#include "chasles/elementary/edge_through_face.h"

namespace chasles::search {

using algebra::FeasibleInterval;
using algebra::Vector3;
using contact::FeaturePair;
using culling::CachedFace;
using culling::point_of;

/// Two bodies under one set of control maps.
template <class S>
class FeatureTests {
public:
    using Maps = motion::ControlMaps<S>;

    /// `margin` is the distance of the distance tests.
    FeatureTests(const Body& moving, const Body& fixed, const elementary::ErrorScale& scale, double margin = 0)
        : moving_(moving), fixed_(fixed), accuracy_{scale, {}}, in_moving_(accuracy_), margin_(margin) {}

    /// Sets the maps, kept by reference, and the tolerance of the interval that they run over.
    void use(const Maps& maps, const algebra::Tolerance& tolerance) {
        maps_ = &maps;
        accuracy_.tolerance = in_moving_.tolerance = tolerance;
        path_is_set_ = false;
    }

    /// Likewise for maps whose errors have another bound.
    void use(const Maps& maps, const elementary::ErrorScale& scale, const algebra::Tolerance& tolerance) {
        use(maps, tolerance);
        accuracy_.scale = scale;
        in_moving_.scale = elementary::in_moving_frame(scale, maps);
    }

    /// The first tau at which the features may touch; empty if they are proven never to. Features at the rims of faces
    /// touch as one of three kinds: for the other kinds the answer is empty.
    std::optional<FeasibleInterval> touch(const FeaturePair& features) {
        switch (features.kind) {
        case ContactKind::vertex_face:
            return elementary::vertex_face<S>({moving_path(features.moving), maps_->weight}, fixed_face(features.fixed),
                                              accuracy_, workspace_);
        case ContactKind::face_vertex:
            return elementary::vertex_face<S>({fixed_path(features.fixed), maps_->weight}, moving_face(features.moving),
                                              in_moving_, workspace_);
        case ContactKind::edge_edge:
            return elementary::edge_edge<S>(*maps_, moving_edge(features.moving), fixed_edge(features.fixed), accuracy_,
                                            workspace_);
        default:
            return std::nullopt;
        }
    }

    /// Calls `visit(problem)` for each condition under which the features are within the margin; see
    /// elementary/distance_tests.h. For scalars with division.
    template <class Visit>
    void distance(const FeaturePair& features, Visit visit) {
        using namespace elementary;
        switch (features.kind) {
        case ContactKind::vertex_face:
            return vertex_face_distance<S>({moving_path(features.moving), maps_->weight}, fixed_face(features.fixed),
                                           margin_, accuracy_, workspace_, visit);
        case ContactKind::face_vertex:
            return vertex_face_distance<S>({fixed_path(features.fixed), maps_->weight}, moving_face(features.moving),
                                           margin_, in_moving_, workspace_, visit);
        case ContactKind::edge_edge:
            return edge_edge_distance<S>({*maps_, moving_edge(features.moving), fixed_edge(features.fixed)}, margin_,
                                         accuracy_, workspace_, visit);
        case ContactKind::vertex_edge:
            return vertex_edge_distance<S>({moving_path(features.moving), maps_->weight},
                                           resting(fixed_, features.fixed), margin_, accuracy_, workspace_, visit);
        case ContactKind::edge_vertex:
            return vertex_edge_distance<S>({fixed_path(features.fixed), maps_->weight},
                                           resting(moving_, features.moving), margin_, in_moving_, workspace_, visit);
        case ContactKind::vertex_vertex:
            return vertex_vertex_distance<S>({moving_path(features.moving), maps_->weight},
                                             point_of<S>(fixed_, features.fixed.first), margin_, accuracy_, workspace_,
                                             visit);
        }
    }

    /// Whether a direction proves that the features stay farther apart than the margin. False proves nothing, and is
    /// the answer for the kinds whose distance tests begin with such a proof.
    bool are_apart(const FeaturePair& features) {
        switch (features.kind) {
        case ContactKind::vertex_face:
            return elementary::are_apart<S>({moving_path(features.moving), maps_->weight}, fixed_face(features.fixed),
                                            margin_.distance, accuracy_);
        case ContactKind::face_vertex:
            return elementary::are_apart<S>({fixed_path(features.fixed), maps_->weight}, moving_face(features.moving),
                                            margin_.distance, in_moving_);
        case ContactKind::edge_edge:
            return elementary::are_apart<S>({*maps_, moving_edge(features.moving), fixed_edge(features.fixed)},
                                            margin_.distance, accuracy_);
        default:
            return false;
        }
    }

    /// The point at which the overlap's edge passes through its face at the start of the interval, in the frame of the
    /// face's body; empty if it does not.
    std::optional<elementary::Passage<S>> passage(const Overlap& overlap, elementary::Ends ends) {
        if (overlap.edge_is_moving) {
            const auto segment = start_of(maps_->rotation, maps_->translation, moving_, overlap.edge);
            return elementary::edge_through_face(segment, fixed_face(overlap.face), accuracy_.scale, ends);
        }
        const auto back = maps_->rotation.transposed();
        const auto segment = start_of(back, Path() - maps_->inverse_translation, fixed_, overlap.edge);
        return elementary::edge_through_face(segment, moving_face(overlap.face), accuracy_.scale, ends);
    }

    [[nodiscard]] const elementary::Workspace<S>& workspace() const { return workspace_; }

private:
    using Polynomial = algebra::Bernstein<3, S>;
    using Path = Vector3<Polynomial>;

    [[nodiscard]] Path moving_path(const Feature& vertex) const {
        return maps_->rotation * point_of<S>(moving_, vertex.first) + maps_->translation;
    }
    [[nodiscard]] Path fixed_path(const Feature& vertex) const {
        return maps_->rotation.transposed() * point_of<S>(fixed_, vertex.first) - maps_->inverse_translation;
    }
    const elementary::FaceShape<S>& moving_face(const Feature& face) { return face_.shape_of(moving_, face.first); }
    const elementary::FaceShape<S>& fixed_face(const Feature& face) { return face_.shape_of(fixed_, face.first); }

    /// Consecutive pairs of edges share the moving one.
    const elementary::EdgePath<S>& moving_edge(const Feature& edge) {
        if (!path_is_set_ || edge_ != edge) {
            edge_path_ =
                elementary::edge_path(*maps_, point_of<S>(moving_, edge.first), point_of<S>(moving_, edge.second));
            edge_ = edge;
            path_is_set_ = true;
        }
        return edge_path_;
    }
    [[nodiscard]] elementary::FixedEdge<S> fixed_edge(const Feature& edge) const {
        return elementary::fixed_edge(point_of<S>(fixed_, edge.first), point_of<S>(fixed_, edge.second));
    }
    static elementary::RestingEdge<S> resting(const Body& body, const Feature& edge) {
        return elementary::resting_edge(point_of<S>(body, edge.first), point_of<S>(body, edge.second));
    }

    /// An edge at the start of the interval, by the first control points.
    [[nodiscard]] elementary::Segment<S> start_of(const algebra::Matrix3<Polynomial>& rotation, const Path& translation,
                                                  const Body& body, const Feature& edge) const {
        const auto start = [&](std::uint32_t vertex) {
            const Vector3<S> point = point_of<S>(body, vertex);
            Vector3<S> result;
            for (int i = 0; i < 3; ++i)
                result[i] = rotation.row[i][0][0] * point.x + rotation.row[i][1][0] * point.y +
                            rotation.row[i][2][0] * point.z + translation[i][0];
            return result;
        };
        return {start(edge.first), start(edge.second), maps_->weight[0]};
    }

    const Body& moving_;
    const Body& fixed_;
    elementary::Accuracy accuracy_;
    elementary::Accuracy in_moving_; ///< for features in the frame of the moving body
    elementary::Margin<S> margin_;
    const Maps* maps_ = nullptr;
    CachedFace<S> face_;
    Feature edge_;
    bool path_is_set_ = false;
    elementary::EdgePath<S> edge_path_;
    elementary::Workspace<S> workspace_;
};

} // namespace chasles::search
