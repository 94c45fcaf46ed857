#include "chasles/manipulation/hand_spring.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/base/invalid_input.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace chasles::manipulation {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

/// The rotation vector of a quaternion, the shorter way round; of length at most pi.
Vector3d rotation_vector(Quaterniond turn) {
    if (turn.w() < 0)
        turn.coeffs() = -turn.coeffs();
    const double sine = turn.vec().norm();
    return sine > 0 ? Vector3d(turn.vec() * (2 * algebra::arc_tangent(sine, turn.w()) / sine))
                    : Vector3d(2 * turn.vec());
}

Quaterniond rotation_of(const Vector3d& vector) {
    const double angle = vector.norm();
    const auto [sine, cosine] = algebra::sine_cosine(angle / 2);
    const double share = angle > 0 ? sine / angle : 0.5; // of the vector
    return {cosine, share * vector.x(), share * vector.y(), share * vector.z()};
}

Quaterniond rotation(const Pose& pose) {
    return Quaterniond(pose.rotation).normalized();
}

/// From a pose to the goal, in the frame of the body.
Vector3d turn_left(const Pose& pose, const Pose& goal) {
    return rotation_vector(rotation(pose).conjugate() * rotation(goal));
}

Vector3d place_of(const Vector3d& point, const Pose& pose) {
    return pose.translation + rotation(pose) * point;
}

/// The rate of a rotation vector w, the turn that is left, is -J u for the angular velocity u of the body:
/// J = 1 - [w]/2 + c [w]^2. This is the transposed J times a vector.
Vector3d transposed_rate(const Vector3d& w, const Vector3d& vector) {
    const double angle = w.norm(), half = angle / 2;
    // (1 - half cot half) / angle^2, and its limit; both are exact to rounding where they meet
    const double c = angle > 1e-4 ? (1 - half / algebra::tangent(half)) / (angle * angle) : 1.0 / 12;
    return vector + w.cross(vector) / 2 + c * w.cross(w.cross(vector));
}

} // namespace

MassProperties mass_of_box(const Body& body) {
    const MeshReport& report = body.report();
    const Vector3d sides = report.upper - report.lower, squares = sides.cwiseProduct(sides);
    const Vector3d moments = (Vector3d::Constant(squares.sum()) - squares) / 12;
    const double least = squares.sum() / 100;
    return {(report.lower + report.upper) / 2, moments.cwiseMax(least).asDiagonal()};
}

void check(const MassProperties& mass) {
    if (!mass.centre.allFinite() || !mass.inertia.allFinite())
        throw InvalidInput("drag: mass: a number is not finite");
    const bool is_symmetric = (mass.inertia - mass.inertia.transpose()).norm() <= 1e-9 * mass.inertia.norm();
    const Eigen::LLT<Matrix3d> root(mass.inertia);
    if (!is_symmetric || root.info() != Eigen::Success || !(root.rcond() > 1e-9))
        throw InvalidInput("drag: mass: the inertia must be symmetric and positive definite");
}

Pose displaced(const Pose& pose, const Vector3d& centre, const Twist& displacement) {
    const Quaterniond turned = (rotation_of(displacement.tail<3>()) * rotation(pose)).normalized();
    const Vector3d place = place_of(centre, pose) + displacement.head<3>();
    return {place - turned * centre, turned};
}

Metric HandSpring::metric(const Pose& pose) const {
    const Matrix3d turn = rotation(pose).toRotationMatrix();
    Metric metric = Metric::Identity();
    metric.bottomRightCorner<3, 3>() = turn * mass_.inertia * turn.transpose();
    return metric;
}

Twist HandSpring::wish(const Pose& pose, const Pose& goal) const {
    const Vector3d left = turn_left(pose, goal);
    const Vector3d turn = mass_.inertia.inverse() * transposed_rate(left, mass_.inertia * left);
    Twist wish;
    wish << place_of(mass_.centre, goal) - place_of(mass_.centre, pose), rotation(pose) * turn;
    return wish;
}

/// Differences before products: near the goal the energies themselves are nearly equal.
double HandSpring::energy_lost(const Pose& from, const Pose& to, const Pose& goal) const {
    const Vector3d a = place_of(mass_.centre, from), b = place_of(mass_.centre, to);
    const Vector3d end = place_of(mass_.centre, goal);
    const Vector3d before = turn_left(from, goal), after = turn_left(to, goal);
    return (b - a).dot((end - a) + (end - b)) / 2 + (before - after).dot(mass_.inertia * (before + after)) / 2;
}

} // namespace chasles::manipulation
