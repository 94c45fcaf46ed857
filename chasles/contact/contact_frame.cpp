#include "chasles/contact/contact_frame.h"

#include "chasles/contact/normal_cone.h"
#include "chasles/mesh/face_normal.h"

#include <Eigen/Geometry>
#include <cmath>

namespace chasles::contact {

namespace {

/// The normal of a contact before its side is decided.
struct Place {
    Eigen::Vector3d normal;   ///< unit, up to its sign
    Eigen::Vector3d fallback; ///< decides the sign if the features do not approach
};

/// The normal at a right angle to both edges. Parallel edges have many normals; the choice is the direction of the
/// relative velocity across the edges, if there is one.
Place place_on_edges(const ContactScene& scene, const FeaturePair& features, const Eigen::Vector3d& point) {
    const RelativeConfiguration& bodies = scene.bodies;
    const auto direction = [](const Body& body, const Feature& edge) -> Eigen::Vector3d {
        return (body.vertices()[edge.second] - body.vertices()[edge.first]).stableNormalized();
    };
    const Eigen::Vector3d along = direction(bodies.fixed(), features.fixed);
    const Eigen::Vector3d crossing = bodies.turned(direction(bodies.moving(), features.moving)).cross(along);
    const Eigen::Vector3d outward = outward_direction(bodies);
    if (crossing.norm() > no_direction)
        return {crossing.normalized(), outward};
    const Eigen::Vector3d velocity = bodies.velocity_at(point);
    const Eigen::Vector3d across = velocity - along * velocity.dot(along);
    const bool slides = across.stableNorm() <= no_direction * velocity.stableNorm();
    return {slides ? Eigen::Vector3d(along.unitOrthogonal()) : Eigen::Vector3d(across.stableNormalized()), outward};
}

Place place_of(const ContactScene& scene, const FeaturePair& features, const Eigen::Vector3d& point) {
    if (features.kind == ContactKind::vertex_face) {
        const Eigen::Vector3d normal = face_normal(scene.bodies.fixed(), features.fixed.first).unit;
        return {normal, normal};
    }
    if (features.kind == ContactKind::face_vertex) {
        const Eigen::Vector3d normal =
            scene.bodies.turned(face_normal(scene.bodies.moving(), features.moving.first).unit).normalized();
        return {normal, -normal};
    }
    if (features.kind == ContactKind::edge_edge)
        return place_on_edges(scene, features, point);
    const Eigen::Vector3d normal = normal_between_cones(scene.bodies, features, scene.at_start);
    return {normal, normal};
}

Eigen::Vector3d towards_moving(const Place& place, double closing, double speed, bool at_start) {
    // The gap was closing before a first contact. A contact at the start has no time before it.
    const bool approaches = !at_start && std::abs(closing) > no_direction * speed;
    const bool turned_over = (approaches ? -closing : place.normal.dot(place.fallback)) < 0;
    return turned_over ? Eigen::Vector3d(-place.normal) : place.normal;
}

} // namespace

double touch_slack(const RelativeConfiguration& bodies, const elementary::ErrorScale& scale, double width) {
    const Bvh& hierarchy = bodies.moving().bvh();
    const Eigen::Vector3d centre = bodies.moved(hierarchy.centre());
    double speed = bodies.velocity_at(centre).norm();
    for (int i = 0; i < 3; ++i)
        speed +=
            (bodies.velocity_at(centre + hierarchy.radius() * Eigen::Vector3d::Unit(i)) - bodies.velocity_at(centre))
                .norm();
    return elementary::position_error<double>(scale) + speed * width;
}

Contact described(const ContactScene& scene, const FeaturePair& features) {
    const NearestPoints nearest = scene.bodies.nearest(features);
    const Eigen::Vector3d velocity = scene.bodies.velocity_at(nearest.on_moving);
    Contact contact;
    contact.kind = features.kind;
    contact.moving = features.moving;
    contact.fixed = features.fixed;
    contact.point = nearest.on_fixed;
    const double distance = nearest.apart().stableNorm();
    if (scene.margin > 0 && distance > scene.slack) {
        contact.normal = nearest.apart().stableNormalized();
        contact.gap = distance;
    } else {
        const Place place = place_of(scene, features, contact.point);
        contact.normal = towards_moving(place, place.normal.dot(velocity), velocity.norm(), scene.at_start);
        contact.gap = contact.normal.dot(nearest.apart());
    }
    contact.approach_speed = 0 - contact.normal.dot(velocity); // not -0
    return contact;
}

} // namespace chasles::contact
