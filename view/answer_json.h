// Answers as JSON. Every number reads back to the identical double.
#pragma once

#include "view/motion_numbers.h"

#include <nlohmann/json.hpp>

namespace chasles::view {

using Json = nlohmann::ordered_json;

/// The answer of `check`. Every answer has verdict, clear_until, motion and work. An answer with contact also has time,
/// tau if the motion has it, certain, pose and contacts, and overlap if the surfaces overlap at the start. `held` is
/// present if not empty, and contacts_cut if true.
Json answer_json(const FirstContact& found, const MotionNumbers& motion);

/// The answer of `clearance`: distance, time, tau if the motion has it, certain, pose, contacts, motion and work.
/// `overlap` is present if the surfaces overlap at the start, and contacts_cut if true.
Json answer_json(const LeastDistance& found, const MotionNumbers& motion);

Json vector_json(const Eigen::Vector3d& vector);
/// x, y, z, qw, qx, qy, qz. The quaternion has length one.
Json pose_json(const Pose& pose);

} // namespace chasles::view
