#include "chasles/contact/near_pair.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace chasles::contact {

namespace {

using Eigen::Vector3d;

/// The rounding of a cross product, or of a product with it, over the product of the lengths.
constexpr double rounding = 8 * 0x1p-53;
/// A normal with a larger error gives no plane: the face is a line, up to rounding.
constexpr double no_plane = 0x1p-7;

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
    double area = 0;
    double products = 0;
    for (std::size_t i = 1; i < corners_.size(); ++i) {
        const Vector3d arm = corner(i) - corner(0);
        diameter_ = std::max(diameter_, arm.norm());
        if (corners_.size() > 3)
            thickness_ = std::max(thickness_, std::abs(normal_.dot(arm)));
        if (i + 1 < corners_.size()) {
            const Vector3d next = corner(i + 1) - corner(0);
            area += normal_.dot(arm.cross(next));
            products += arm.norm() * next.norm();
        }
    }
    error_ = rounding * products / std::max(area, rounding * products);
}

bool FaceAtRest::is_below(const Vector3d& point, double reach, double slack) const {
    if (error_ > no_plane)
        return is_near_rim(point, reach);
    const double tolerance = error_ * diameter_;
    return std::abs(normal_.dot(point - corner(0))) <= reach + tolerance + thickness_ &&
           is_inside(point, slack + tolerance);
}

/// Whether a point is to the left of the line between two corners, up to the tolerance.
bool FaceAtRest::is_left_of(std::size_t from, std::size_t to, const Vector3d& point, double tolerance) const {
    const Vector3d along = corner(to) - corner(from);
    return normal_.dot(along.cross(point - corner(from))) >= -tolerance * along.norm();
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

bool FaceAtRest::is_near_rim(const Vector3d& point, double reach) const {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Vector3d along = corner(i + 1 == corners_.size() ? 0 : i + 1) - corner(i);
        const double share = std::clamp((point - corner(i)).dot(along) / along.squaredNorm(), 0.0, 1.0);
        if ((corner(i) + share * along - point).norm() <= reach)
            return true;
    }
    return false;
}

const FaceAtRest& NearTest::face_of(const Body& body, std::uint32_t face, std::optional<FaceAtRest>& last) {
    if (!last || last->face() != face)
        last.emplace(body, face);
    return *last;
}

bool NearTest::are_near(const FeaturePair& features) {
    const RelativeConfiguration& bodies = scene_.bodies;
    const double reach = scene_.margin + scene_.slack;
    if (features.kind == ContactKind::vertex_face)
        return face_of(bodies.fixed(), features.fixed.first, fixed_face_)
            .is_below(bodies.moved(bodies.moving().vertices()[features.moving.first]), reach, scene_.slack);
    if (features.kind == ContactKind::face_vertex)
        return face_of(bodies.moving(), features.moving.first, moving_face_)
            .is_below(bodies.moved_back(bodies.fixed().vertices()[features.fixed.first]), reach, scene_.slack);
    const NearestPoints nearest = bodies.nearest(features);
    const double distance = nearest.apart().norm();
    return distance <= reach && (distance <= scene_.slack || !is_at_an_end(scene_, features, nearest));
}

bool NearTest::are_in_contact(const FeaturePair& features) {
    return are_near(features) &&
           (scene_.margin <= 0 || is_local_minimum(scene_, features, scene_.bodies.nearest(features)));
}

bool is_local_minimum(const ContactScene& scene, const FeaturePair& features, const NearestPoints& nearest) {
    const double distance = nearest.apart().norm();
    return distance <= scene.slack || scene.bodies.descent(features, nearest) <= 4 * scene.slack / distance;
}

} // namespace chasles::contact
