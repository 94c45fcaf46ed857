// One step of a body that a spring pulls along what it touches: where to go next, by the contacts near it.
// Source: docs/derivations/30-dragged-body.md, "One step".
#pragma once

#include "chasles/manipulation/contact_model.h"
#include "chasles/manipulation/hand_spring.h"
#include "chasles/manipulation/lock.h"

#include <span>

namespace chasles::manipulation {

struct SlideProblem {
    const HandSpring& spring;
    const Pose& pose;
    const Pose& goal;
    std::span<const ModelledContact> contacts; ///< at the pose
    double margin = 0;                         ///< the gap that contacts keep
    double size = 0;                           ///< of the body
    double rest = 0;                           ///< a shorter step is none
    double friction = 0;                       ///< of each contact: the friction force as a share of the normal force
    const Lock* lock = nullptr;                ///< null: free
    const Pose* target = nullptr;              ///< the pose of the lock nearest to the goal; null: the goal
};

enum class SlideKind : std::uint8_t {
    free,    ///< nothing is in the way of the screw to the target
    partial, ///< some way, along contacts or towards them
    rest,    ///< the contacts hold the body, up to a step that is too short
};

struct Slide {
    SlideKind kind = SlideKind::rest;
    Pose end; ///< of the screw to go; the pose itself at rest
};

/// By the gaps of the contacts after the step, to second order. Nothing is proven here: other contacts may be in the
/// way.
Slide next_slide(const SlideProblem& problem);

} // namespace chasles::manipulation
