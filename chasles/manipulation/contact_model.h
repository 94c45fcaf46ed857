// How the gap of a contact changes while the body moves a little: features as points, planes and lines.
// Source: docs/derivations/30-dragged-body.md, "Gaps after a step".
#pragma once

#include "chasles/contact/contact.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/pose.h"

namespace chasles::manipulation {

/// A contact at the present pose of the body, in the world.
struct ModelledContact {
    Contact contact;
    std::size_t body = 0;                                       ///< the other one; an index of the scene
    Eigen::Vector3d moving_direction = Eigen::Vector3d::Zero(); ///< unit, of two edges that are not parallel
    Eigen::Vector3d fixed_direction = Eigen::Vector3d::Zero();  ///< likewise; else zero
    double moving_radius = 0;                                   ///< of the bodies: features are so far inside of them
    double fixed_radius = 0;
};

/// Two bodies at their poses.
struct PlacedPair {
    const Body& moving;
    const Body& fixed;
    const Pose& moving_pose;
    const Pose& fixed_pose;
};

ModelledContact modelled(const Contact& contact, std::size_t body, const PlacedPair& pair);

/// A rigid displacement of the body in the world.
struct Displacement {
    Eigen::Matrix3d turn;
    Eigen::Vector3d shift; ///< x -> turn x + shift

    static Displacement between(const Pose& from, const Pose& to);
};

/// The gap of the contact after a displacement, negative if the features pass each other: of a point and a plane with
/// the contact's normal, or of two lines. No more than the true distance of the two features.
double gap_after(const ModelledContact& contact, const Displacement& displacement);

} // namespace chasles::manipulation
