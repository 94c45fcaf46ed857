// The pairs of a robot that an answer names.
#pragma once

#include "chasles/chasles.h"

#include <string>
#include <vector>

namespace chasles::cli {

/// The lines of the pair that touches first, or is nearest, in a segment of the path.
std::string report_pair(const RobotPair& pair, std::size_t segment);

/// The pairs beside the first one in contact at the start: who allows them, or mends the start, needs all of them. None
/// at the limit of the thread.
std::vector<RobotPair> others_at_start(const RobotChecker& checker, const JointPath& path, const RobotAnswer& found);

/// Their line; empty if there are none.
std::string report_others(const std::vector<RobotPair>& others);

} // namespace chasles::cli
