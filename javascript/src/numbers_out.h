// Writes answers as numbers. javascript/chasles/answers.js reads them in the same order.
#pragma once

#include "chasles/query/least_distance.h"
#include "chasles/query/profile.h"
#include "view/motion_numbers.h"

#include <vector>

namespace chasles::javascript {

using Numbers = std::vector<double>;

void write(Numbers& out, const Eigen::Vector3d& vector);
/// x y z, and the quaternion qw qx qy qz of length one.
void write(Numbers& out, const Pose& pose);
void write(Numbers& out, const Contact& contact);
void write(Numbers& out, const std::vector<Contact>& contacts);
void write(Numbers& out, const Work& work);
void write(Numbers& out, const view::MotionNumbers& motion);
void write(Numbers& out, const FirstContact& found);
void write(Numbers& out, const LeastDistance& found);
/// With the zones within the margins that were asked.
void write(Numbers& out, const DistanceProfile& found, const std::vector<double>& margins);

} // namespace chasles::javascript
