// Answers as JSON. Every number reads back to the very same double.
#pragma once

#include "view/motion_numbers.h"

#include <nlohmann/json.hpp>

namespace chasles::view {

using Json = nlohmann::ordered_json;

/// The answer of `check`: verdict; time, tau, certain, pose, contacts and overlap unless clear; motion; work.
Json answer_json(const FirstContact& found, const MotionNumbers& motion);

Json vector_json(const Eigen::Vector3d& vector);
/// x, y, z, qw, qx, qy, qz, with a quaternion of length one.
Json pose_json(const Pose& pose);

} // namespace chasles::view
