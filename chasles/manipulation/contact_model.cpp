#include "chasles/manipulation/contact_model.h"

#include <Eigen/Geometry>

namespace chasles::manipulation {

using Eigen::Vector3d;

namespace {

/// The least sine of the angle between edges whose common normal is used.
constexpr double least_sine = 1e-3;

Vector3d direction(const Body& body, const Feature& edge, const Pose& pose) {
    const auto vertices = body.vertices();
    return (Eigen::Quaterniond(pose.rotation).normalized() * (vertices[edge.second] - vertices[edge.first]))
        .stableNormalized();
}

} // namespace

ModelledContact modelled(const Contact& contact, std::size_t body, const PlacedPair& pair) {
    ModelledContact result{
        .contact = contact, .body = body, .moving_radius = pair.moving.radius(), .fixed_radius = pair.fixed.radius()};
    if (contact.kind != ContactKind::edge_edge)
        return result;
    const Vector3d moving = direction(pair.moving, contact.moving, pair.moving_pose);
    const Vector3d fixed = direction(pair.fixed, contact.fixed, pair.fixed_pose);
    if (moving.cross(fixed).norm() < least_sine)
        return result;
    result.moving_direction = moving;
    // so that moving x fixed is along the normal
    result.fixed_direction = moving.cross(fixed).dot(contact.normal) < 0 ? Vector3d(-fixed) : fixed;
    return result;
}

Displacement Displacement::between(const Pose& from, const Pose& to) {
    const Eigen::Quaterniond start(from.rotation), end(to.rotation);
    const Eigen::Matrix3d turn = (end.normalized() * start.normalized().conjugate()).toRotationMatrix();
    return {turn, to.translation - turn * from.translation};
}

double gap_after(const ModelledContact& modelled, const Displacement& displacement) {
    const Contact& contact = modelled.contact;
    const double radii = modelled.moving_radius + modelled.fixed_radius;
    const Vector3d on_fixed = contact.point - modelled.fixed_radius * contact.normal;
    const Vector3d on_moving = on_fixed + (contact.gap + radii) * contact.normal;
    const Vector3d apart = displacement.turn * on_moving + displacement.shift - on_fixed;
    const auto gap_along = [&](const Vector3d& normal) { return normal.dot(apart) - radii; };
    if (modelled.fixed_direction != Vector3d::Zero()) {
        const Vector3d normal = (displacement.turn * modelled.moving_direction).cross(modelled.fixed_direction);
        return gap_along(normal.norm() < least_sine ? contact.normal : normal.normalized());
    }
    const bool plane_moves = moving_feature_kind(contact.kind) != FeatureKind::vertex &&
                             fixed_feature_kind(contact.kind) == FeatureKind::vertex;
    return gap_along(plane_moves ? Vector3d(displacement.turn * contact.normal) : contact.normal);
}

} // namespace chasles::manipulation
