// One step of a body that a spring pulls along what it touches: where to go next, by the contacts near it.
// Source: docs/derivations/30-dragged-body.md, "One step".
#pragma once

#include "chasles/manipulation/contact_model.h"
#include "chasles/manipulation/hand_spring.h"

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
};

enum class SlideKind : std::uint8_t {
    free,    ///< nothing is in the way of the screw to the goal
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

/// The forces of the contacts whose gap is at most `touch`, against the whole wish of the spring.
AdmissibleTwist pushes(const SlideProblem& problem, double touch);

} // namespace chasles::manipulation
