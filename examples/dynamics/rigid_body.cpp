#include "examples/dynamics/rigid_body.h"

#include <cmath>

namespace chasles::examples {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d RigidBody::inertia_in_world() const {
    return pose.linear() * inertia * pose.linear().transpose();
}

Vector3d RigidBody::velocity_at(const Vector3d& point) const {
    return velocity.linear + velocity.angular.cross(point - centre_in_world());
}

Velocity RigidBody::answer_to(const Vector3d& impulse, const Vector3d& point) const {
    if (!moves())
        return {};
    const Vector3d middle = centre_in_world();
    if (!hinge)
        return {impulse / mass, inertia_in_world().ldlt().solve((point - middle).cross(impulse))};
    const Vector3d& axis = hinge->direction;
    const double about_axis =
        axis.dot(inertia_in_world() * axis) + mass * axis.cross(middle - hinge->point).squaredNorm();
    const Vector3d turn = axis * (axis.dot((point - hinge->point).cross(impulse)) / about_axis);
    return {turn.cross(middle - hinge->point), turn};
}

void RigidBody::place(const Isometry3d& at) {
    pose = at;
    if (hinge)
        velocity.linear = velocity.angular.cross(centre_in_world() - hinge->point);
}

void RigidBody::push(const Vector3d& impulse, const Vector3d& point) {
    const Velocity change = answer_to(impulse, point);
    velocity.linear += change.linear;
    velocity.angular += change.angular;
}

double RigidBody::kinetic_energy() const {
    const Vector3d& turn = velocity.angular;
    return 0.5 * (mass * velocity.linear.squaredNorm() + turn.dot(inertia_in_world() * turn));
}

Motion RigidBody::flight(double duration) const {
    if (!moves())
        return Motion::at_rest(pose);
    if (hinge) {
        const double angle = velocity.angular.dot(hinge->direction) * duration;
        return Motion::hinge(hinge->point, hinge->direction, {0, angle}) * Motion::at_rest(pose);
    }
    const Vector3d turn = duration * velocity.angular;
    const double angle = turn.norm();
    Isometry3d goal = pose;
    if (angle > 0)
        goal.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * pose.linear();
    goal.translation() = centre_in_world() + duration * velocity.linear - goal.linear() * centre;
    return Motion::velocity(pose, goal, centre);
}

/// Tetrahedra from the origin to the triangles of a fan of each face. Their second moments follow from those of the
/// corner tetrahedron of the unit cube.
RigidBody solid(const Polyhedron& shape, double density) {
    double volume = 0;
    Vector3d first = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();
    const Matrix3d corner = (Matrix3d::Identity() + Matrix3d::Ones()) / 120;
    for (std::size_t face = 0; face < shape.face_count(); ++face)
        for (std::size_t i = 2; i < shape.face(face).size(); ++i) {
            Matrix3d sides;
            for (const auto& [column, place] : {std::pair(0, std::size_t(0)), std::pair(1, i - 1), std::pair(2, i)})
                sides.col(column) = shape.vertices()[shape.face(face)[place]];
            const double six_volumes = sides.determinant();
            volume += six_volumes / 6;
            first += six_volumes / 24 * sides.rowwise().sum();
            second += six_volumes * sides * corner * sides.transpose();
        }
    RigidBody body;
    body.mass = density * volume;
    body.centre = first / volume;
    second = density * (second - volume * body.centre * body.centre.transpose());
    body.inertia = second.trace() * Matrix3d::Identity() - second;
    return body;
}

} // namespace chasles::examples
