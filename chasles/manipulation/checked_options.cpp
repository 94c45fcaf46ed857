#include "chasles/manipulation/checked_options.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/manipulation/hand_spring.h"

#include <string>

namespace chasles::manipulation {

namespace {

constexpr double default_margin = 1e-4; // of the diagonal of the box
/// In margins, and by default: somewhat more than the gap of a contact that touches (`touch_share`). Measured with
/// drag_bench: a reach of 2 margins takes up to twice the time, and no fewer rounds.
constexpr double least_reach = 1.25;

} // namespace

void require(bool holds, const char* option, const char* why) {
    if (!holds)
        throw InvalidInput(std::string("drag: ") + option + ": " + why);
}

double diagonal(const Polyhedron& shape) {
    const MeshReport report = shape.report();
    return (report.upper - report.lower).norm();
}

Distances distances_of(const DragOptions& options, const Polyhedron& shape) {
    const auto is_positive = [](double number) { return number > 0 && number <= 1e30; };
    require(options.margin == 0 || is_positive(options.margin), "margin", "must be in (0, 1e30], or 0 for the default");
    const double margin = options.margin == 0 ? default_margin * diagonal(shape) : options.margin;
    const double reach = options.reach == 0 ? least_reach * margin : options.reach;
    require(reach >= least_reach * margin && reach <= 1e30, "reach",
            "must be at least 1.25 times the margin, and at most 1e30");
    require(is_positive(options.stiffness), "stiffness", "must be in (0, 1e30]");
    require(options.rounds > 0, "rounds", "must be positive");
    require(options.friction >= 0 && options.friction <= 100, "friction", "must be in [0, 100]");
    return {margin, reach};
}

MassProperties mass_of(const DragOptions& options, const Polyhedron& shape) {
    if (!options.mass)
        return mass_of_box(shape.body());
    check(*options.mass);
    return *options.mass;
}

void check_rounding(const Distances& distances, const Polyhedron& shape, const Pose& pose, bool is_goal) {
    const MeshReport report = shape.report();
    const double lengths = pose.translation.norm() + report.lower.norm() + report.upper.norm();
    const double least = 0x1p-28 * lengths;
    if (distances.margin >= least)
        return;
    const std::string margin = number_text(distances.margin);
    const std::string limit = " below a 2^28th of the lengths of the pose, " + number_text(least);
    if (is_goal)
        throw InvalidInput("drag: goal: is too far away: the margin, " + margin + ", is" + limit +
                           ", and so too near to the rounding of such poses; give a goal that is nearer to the "
                           "origin, or drag with a larger margin");
    throw InvalidInput("drag: margin: " + margin + " is" + limit +
                       ", and so too near to its rounding; give a larger one, or put the bodies near the origin");
}

} // namespace chasles::manipulation
