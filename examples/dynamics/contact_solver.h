// Impulses at contacts: what bodies do when they meet.
#pragma once

#include "examples/dynamics/rigid_body.h"

namespace chasles::examples {

/// One point at which two bodies push each other.
struct Touch {
    std::size_t moving = 0;
    std::size_t fixed = 0;
    Eigen::Vector3d point;
    Eigen::Vector3d normal; ///< unit, from the fixed body to the moving body
    double gap = 0;
    double least_speed = 0; ///< of separation, after the impulses
};

/// All contacts of pairs, one after another.
std::vector<Touch> touches_of(const std::vector<SceneContact>& pairs);

/// The speed at which the bodies separate there; negative while they approach.
double separation_speed(const Touch& touch, const std::vector<RigidBody>& bodies);

/// The least impulses after which each touch separates at its least speed or faster, with Coulomb friction; by
/// projected Gauss-Seidel iteration, until no speed changes by more than this share of the greatest change. Where each
/// least speed is that of the approach, and without friction, the kinetic energy is kept.
void resolve(const std::vector<Touch>& touches, double friction, double tolerance, std::vector<RigidBody>& bodies);

} // namespace chasles::examples
