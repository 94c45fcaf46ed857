// The distance over time below the slider of a page: the option --curve.
#pragma once

#include "chasles/robot/robot.h"
#include "cli/commands.h"
#include "view/curve.h"

namespace chasles::cli {

void add_curve_option(CLI::App& command, bool& wants_curve, CLI::Option* page = nullptr);

/// The margin of the question is drawn as a line.
view::Curve curve_of(const Scene& scene, double margin);
view::Curve curve_of(const RobotChecker& checker, const JointPath& path, double margin);
view::Curve curve_of(DistanceProfile distance, double margin);

} // namespace chasles::cli
