// Coulomb friction of a body that a spring pulls: whether its contacts hold it, and if not, how it slides and which
// forces act. Source: docs/derivations/30-dragged-body.md, "Friction".
#pragma once

#include "chasles/manipulation/admissible_twist.h"

namespace chasles::manipulation {

/// Contacts with friction.
struct FrictionProblem {
    TwistConstraints normals; ///< gaps: what each contact may close by
    Rows tangents;            ///< two for each contact: along unit vectors orthogonal to the normal and to each other;
                              ///< none are needed where the coefficient is 0
    double coefficient = 0;   ///< the greatest friction force of a contact, as a share of its normal force
    Metric metric = Metric::Identity();
};

/// Leaves the contacts whose gap is at most this one. The rows of the others become zero, so that they do nothing.
void keep_nearer(FrictionProblem& problem, double most_gap);

/// Forces per stiffness of the spring.
struct FrictionForces {
    Twist twist = Twist::Zero(); ///< to first order, what the spring and the forces lead to
    Eigen::VectorXd normal;      ///< one for each contact, not negative
    Eigen::VectorXd tangential;  ///< two for each contact; within the cone: of length at most coefficient * normal
    bool has_converged = true;   ///< otherwise the friction is not opposed to the twist to all digits
};

/// The forces of contacts that hold the body, if any in their cones do: twist is zero, up to rounding, just if the
/// spring's force is balanced. Otherwise they leave the least twist. Gaps count as closed.
FrictionForces holding_forces(const FrictionProblem& problem, const Twist& wish);
/// Whether these forces hold the body against the wish.
bool is_held(const FrictionProblem& problem, const FrictionForces& holding, const Twist& wish);

/// The forces of contacts along which the body slides: the friction of a contact that slides is opposed to its
/// sliding, and as great as it may be.
FrictionForces sliding_forces(const FrictionProblem& problem, const Twist& wish);

/// The wish that leads a body without friction to the same twist: wish + metric^-1 tangents^T tangential.
Twist changed_wish(const FrictionProblem& problem, const FrictionForces& forces, const Twist& wish);

} // namespace chasles::manipulation
