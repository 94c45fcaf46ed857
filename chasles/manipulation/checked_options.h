// Checks the options of a dragged body, and fills in defaults. Errors name the option.
#pragma once

#include "chasles/manipulation/drag_options.h"
#include "chasles/manipulation/surroundings.h"
#include "chasles/mesh/polyhedron.h"

namespace chasles::manipulation {

/// Throws InvalidInput "drag: OPTION: WHY" unless it holds.
void require(bool holds, const char* option, const char* why);

/// Throws InvalidInput for an option out of its range.
Distances distances_of(const DragOptions& options, const Polyhedron& shape);
/// Those of the box around the body, unless they are given. Throws InvalidInput for what no body has.
MassProperties mass_of(const DragOptions& options, const Polyhedron& shape);

/// Of the box around the body.
double diagonal(const Polyhedron& shape);

/// The gap of contacts is far above the rounding of poses. The least clearance is 2^-22 of the margin, and a point of
/// the body is off its place by less than 2^-50 of the lengths that enter. Throws InvalidInput if the margin is less:
/// the message names the goal if the pose is one.
void check_rounding(const Distances& distances, const Polyhedron& shape, const Pose& pose, bool is_goal = false);

} // namespace chasles::manipulation
