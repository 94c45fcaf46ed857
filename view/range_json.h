// Ranges of robots as JSON. docs/command-line.md describes the keys.
#pragma once

#include "chasles/robot/range.h"
#include "view/answer_json.h"

#include <cstddef>
#include <vector>

namespace chasles::view {

/// The answer of `range`: joints, verdict, boxes, contact_boxes and open_boxes with lower and upper of these joints,
/// clear_share, contact_share and open_share, cells and untested; if something touches, witness and pair, too.
Json range_json(const chasles::Robot& robot, const RobotRange& found);
/// The largest proven box: verdict, lower and upper of these variables, share and is_maximal.
Json clear_box_json(const ClearBox& found, const std::vector<std::size_t>& joints);

} // namespace chasles::view
