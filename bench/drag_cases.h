// Bodies in hands: what is dragged, against what, and where there is much to touch. For benchmarks and for the trial of
// tests/data.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/pose.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::bench {

struct DragCase {
    std::string name;
    Polyhedron moving;
    Polyhedron fixed; ///< stands at the origin
    Pose start;       ///< clear
    Pose home;        ///< around which the hand wanders; the bodies may overlap there
    double way = 0;   ///< of the hand around home, mesh unit
    double turn = 0;  ///< likewise, radians
};

/// The names of all cases, also of those that need data from outside the project.
std::vector<std::string_view> drag_case_names();

/// The case. Empty if its data is missing. Throws InvalidInput for an unknown name.
std::optional<DragCase> drag_case(std::string_view name);

/// A smooth hand: sums of slow waves around home.
Pose goal_at(const DragCase& hand, double time);

} // namespace chasles::bench
