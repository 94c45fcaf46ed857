// What a question about a range takes: a checker whose scene stands still, and a box of configurations.
#pragma once

#include "chasles/robot/overlap_surface.h"
#include "chasles/robot/prepared.h"
#include "chasles/robot/range.h"

#include <vector>

namespace chasles::robot {

/// A checker with the surfaces of its bodies.
struct RangeWorld {
    /// Kept by reference. Throws InvalidInput for a body of the scene that moves.
    explicit RangeWorld(const RobotChecker::Prepared& prepared);

    const RobotChecker::Prepared& prepared;
    std::vector<OverlapSurface> of_elements, of_obstacles;
};

/// The variables of which the ends of a box differ. Throws InvalidInput "range: WHAT: WHY" for a box that is none.
std::vector<std::size_t> checked_axes(const Model& model, const ConfigurationBox& box);

} // namespace chasles::robot
