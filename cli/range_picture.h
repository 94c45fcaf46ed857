// The range of two joints as a picture.
#pragma once

#include "chasles/robot/range.h"

#include <optional>
#include <string>

namespace chasles::cli {

/// SVG: the proven boxes over both joints, clear ones light, those in contact dark, and open ones between them. A
/// dashed line is around the clear box, if there is one. The range must be one of two joints.
std::string range_picture(const Robot& robot, const RobotRange& range, const ConfigurationBox& whole,
                          const std::optional<ClearBox>& clear_box);

} // namespace chasles::cli
