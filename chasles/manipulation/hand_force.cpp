#include "chasles/manipulation/hand_force.h"

#include "chasles/manipulation/contact_rows.h"
#include "chasles/manipulation/friction.h"

#include <Eigen/Geometry>

namespace chasles::manipulation {

namespace {

/// Only contacts that touch push. Their gaps are used up.
FrictionProblem touching(const SlideProblem& problem) {
    const Eigen::Vector3d centre = problem.pose.isometry() * problem.spring.centre();
    FrictionProblem found{normal_rows(problem.contacts, centre),
                          problem.friction > 0 ? tangent_rows(problem.contacts, centre) : Rows(0, 6), problem.friction,
                          problem.spring.metric(problem.pose)};
    keep_nearer(found, touch_share * problem.margin);
    found.normals.gaps.setZero();
    return found;
}

/// As the lock lets the body move.
FrictionProblem locked(FrictionProblem problem, const Metric& projection) {
    problem.normals.rows *= projection;
    problem.tangents *= projection;
    return problem;
}

/// Normal forces, and two friction forces for each.
FrictionForces solved(const FrictionProblem& problem, const Twist& wish) {
    if (problem.coefficient > 0) {
        const FrictionForces holding = holding_forces(problem, wish);
        return is_held(problem, holding, wish) ? holding : sliding_forces(problem, wish);
    }
    const AdmissibleTwist pushed = admissible_twist(problem.normals, problem.metric, wish);
    return {pushed.twist, pushed.multipliers, Eigen::VectorXd(), true};
}

} // namespace

ContactForces contact_forces(const SlideProblem& problem) {
    const FrictionProblem contacts = touching(problem);
    Twist wish = problem.spring.wish(problem.pose, problem.goal);
    FrictionForces found;
    if (problem.lock && !problem.lock->is_free()) {
        const Eigen::Vector3d centre = problem.pose.isometry() * problem.spring.centre();
        const Metric projection = problem.lock->projection(contacts.metric, centre);
        found = solved(locked(contacts, projection), projection * wish);
    } else {
        found = solved(contacts, wish);
    }
    ContactForces forces{found.normal, Eigen::Matrix3Xd::Zero(3, found.normal.size())};
    if (!(found.normal.array() > 0).any())
        return forces;
    forces.wrench = contacts.normals.rows.transpose() * found.normal;
    if (!(problem.friction > 0))
        return forces;
    forces.wrench += contacts.tangents.transpose() * found.tangential;
    for (Eigen::Index i = 0; i < found.normal.size(); ++i)
        forces.friction.col(i) =
            plane_across(problem.contacts[std::size_t(i)].contact.normal) * found.tangential.segment<2>(2 * i);
    return forces;
}

ContactForces Grip::forces_at(const Pose& goal) const {
    return contact_forces({.spring = spring,
                           .pose = pose,
                           .goal = goal,
                           .contacts = contacts,
                           .margin = margin,
                           .friction = friction,
                           .lock = &lock});
}

ForceAndTorque Grip::on_hand(const ContactForces& forces) const {
    const Eigen::Vector3d lever = pose.isometry() * spring.centre() - pose.translation;
    const Eigen::Vector3d force = stiffness * forces.wrench.head<3>();
    return {force, stiffness * forces.wrench.tail<3>() + lever.cross(force)};
}

void SharedGrip::replace(std::shared_ptr<const Grip> grip) {
    const chasles::Lock guard(mutex_);
    grip_.swap(grip); // the last one ends outside of the lock
}

std::shared_ptr<const Grip> SharedGrip::get() const {
    const chasles::Lock guard(mutex_);
    return grip_;
}

} // namespace chasles::manipulation
