// The distance over time, which a page shows below its slider.
#pragma once

#include "chasles/robot/robot.h"
#include "view/answer_json.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace chasles::view {

struct Curve {
    DistanceProfile distance;                               ///< with times of the page
    std::vector<std::pair<std::string, std::string>> pairs; ///< what `distance.nearest` counts; UTF-8
    std::vector<double> margins;                            ///< drawn as lines
};

/// Of two bodies, of a scene, and of a path. The margin of the question is drawn as a line.
Curve curve_of(DistanceProfile distance, double margin);
Curve curve_of(const chasles::Scene& scene, double margin);
Curve curve_of(const RobotChecker& checker, const JointPath& path, double margin,
               std::span<const Handover> handovers = {});

/// The keys are those of viewer/src/curve.ts.
Json curve_json(const Curve& curve);

} // namespace chasles::view
