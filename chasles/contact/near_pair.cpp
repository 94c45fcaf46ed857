#include "chasles/contact/near_pair.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace chasles::contact {

namespace {

using Eigen::Vector3d;

/// Whether a point is an end of an edge, up to the slack.
bool is_end_of(const Body& body, const Feature& edge, const Vector3d& point, double slack) {
    return (body.vertices()[edge.first] - point).norm() <= slack ||
           (body.vertices()[edge.second] - point).norm() <= slack;
}

/// Whether the nearest point of an edge is one of its ends. Then the features of the end are as near.
bool is_at_an_end(const ContactScene& scene, const FeaturePair& features, const NearestPoints& nearest) {
    const RelativeConfiguration& bodies = scene.bodies;
    return (moving_feature_kind(features.kind) == FeatureKind::edge &&
            is_end_of(bodies.moving(), features.moving, bodies.moved_back(nearest.on_moving), scene.slack)) ||
           (fixed_feature_kind(features.kind) == FeatureKind::edge &&
            is_end_of(bodies.fixed(), features.fixed, nearest.on_fixed, scene.slack));
}

} // namespace

FaceAtRest::FaceAtRest(const Body& body, std::uint32_t face)
    : body_(&body), face_(face), corners_(body.face(face)), normal_(face_normal(body, face)) {
    for (std::size_t i = 1; i < corners_.size(); ++i) {
        const Vector3d arm = corner(i) - corner(0);
        diameter_ = std::max(diameter_, arm.norm());
        if (corners_.size() > 3) {
            lowest_ = std::min(lowest_, normal_.unit.dot(arm));
            highest_ = std::max(highest_, normal_.unit.dot(arm));
        }
    }
}

int FaceAtRest::side_of(const Vector3d& point, double reach) const {
    const Vector3d arm = point - corner(0);
    const double height = normal_.unit.dot(arm);
    const double band = reach + normal_.error * arm.norm();
    return height > highest_ + band ? 1 : height < lowest_ - band ? -1 : 0;
}

bool FaceAtRest::is_below(const Vector3d& point, double reach, double slack) const {
    if (body_->is_segment(face_)) // its edge and its vertices are tested
        return false;
    if (!normal_.has_plane())
        return (nearest_of_rim(*body_, face_, point) - point).norm() <= reach;
    const double tolerance = normal_.error * diameter_;
    return std::abs(height_of(point)) <= reach + tolerance && is_inside(point, slack + tolerance);
}

Vector3d FaceAtRest::nearest(const Vector3d& point) const {
    return normal_.has_plane() && is_inside(point, 0) ? Vector3d(point - height_of(point) * normal_.unit)
                                                      : nearest_of_rim(*body_, face_, point);
}

/// The height of a point above the highest corner, or the negative depth below the lowest one; 0 between them.
double FaceAtRest::height_of(const Vector3d& point) const {
    const double height = normal_.unit.dot(point - corner(0));
    return height > highest_ ? height - highest_ : std::min(0.0, height - lowest_);
}

/// Whether a point is to the left of the line between two corners, up to the tolerance.
bool FaceAtRest::is_left_of(std::size_t from, std::size_t to, const Vector3d& point, double tolerance) const {
    const Vector3d along = corner(to) - corner(from);
    return normal_.unit.dot(along.cross(point - corner(from))) >= -tolerance * along.norm();
}

bool FaceAtRest::is_inside(const Vector3d& point, double tolerance) const {
    const auto triangles = body_->face_triangles(face_);
    for (std::size_t i = 0; triangles.empty() && i < corners_.size(); ++i)
        if (!is_left_of(i, i + 1 == corners_.size() ? 0 : i + 1, point, tolerance))
            return false;
    for (std::size_t t = 0; t < triangles.size(); t += 3)
        if (is_left_of(triangles[t], triangles[t + 1], point, tolerance) &&
            is_left_of(triangles[t + 1], triangles[t + 2], point, tolerance) &&
            is_left_of(triangles[t + 2], triangles[t], point, tolerance))
            return true;
    return triangles.empty();
}

/// In the frame of the fixed body.
Vector3d NearTest::moving_vertex(std::uint32_t vertex) const {
    return scene_.bodies.moved(scene_.bodies.moving().vertices()[vertex]);
}

/// In the frame of the moving body.
Vector3d NearTest::fixed_vertex(std::uint32_t vertex) const {
    return scene_.bodies.moved_back(scene_.bodies.fixed().vertices()[vertex]);
}

int NearTest::side_on_fixed_face(std::uint32_t face, std::uint32_t vertex) {
    return fixed_face(face).side_of(moving_vertex(vertex), reach());
}

int NearTest::side_on_moving_face(std::uint32_t face, std::uint32_t vertex) {
    return moving_face(face).side_of(fixed_vertex(vertex), reach());
}

bool NearTest::are_near(const FeaturePair& features) {
    if (features.kind == ContactKind::vertex_face)
        return fixed_face(features.fixed.first).is_below(moving_vertex(features.moving.first), reach(), scene_.slack);
    if (features.kind == ContactKind::face_vertex)
        return moving_face(features.moving.first).is_below(fixed_vertex(features.fixed.first), reach(), scene_.slack);
    const NearestPoints nearest = scene_.bodies.nearest(features);
    const double distance = nearest.apart().norm();
    return distance <= reach() && (distance <= scene_.slack || !is_at_an_end(scene_, features, nearest));
}

bool NearTest::are_in_contact(const FeaturePair& features) {
    return are_near(features) &&
           (scene_.margin <= 0 || is_local_minimum(scene_, features, scene_.bodies.nearest(features)));
}

bool is_local_minimum(const ContactScene& scene, const FeaturePair& features, const NearestPoints& nearest) {
    const double distance = nearest.apart().norm();
    return distance <= scene.slack ||
           scene.bodies.descent(features, nearest) <= scene.slopes.of(features.kind) + 4 * scene.slack / distance;
}

} // namespace chasles::contact
