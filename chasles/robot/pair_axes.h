// The joints between two links, and how far they move the points of one link as seen from the other one.
// Source: docs/derivations/29-robots.md, "Pairs that never touch".
#pragma once

#include "chasles/robot/model.h"

#include <vector>

namespace chasles::robot {

/// The allowance for the rounding of sums of lengths.
inline constexpr double outward_sum = 1 + 1e-9;

/// A variable between two links.
struct Axis {
    std::size_t variable = 0;
    double lower = 0;
    double upper = 0;
    double reach = 0; ///< a point moves by at most this for each unit of the variable, in any configuration
};

struct PairAxes {
    std::vector<Axis> axes;  ///< the one that moves points farthest is the last
    bool have_limits = true; ///< all of them, of at most 1000, and no joint between the links is planar or floating
};

/// Between links with these shapes; of each link at least one.
PairAxes axes_between(const Model& model, const std::vector<const Element*>& first,
                      const std::vector<const Element*>& second);

} // namespace chasles::robot
