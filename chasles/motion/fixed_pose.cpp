#include "chasles/motion/fixed_pose.h"

#include "chasles/motion/moving_frame.h"
#include "chasles/motion/screw_path.h"

#include <cmath>

namespace chasles::motion {

namespace {

using Wide = algebra::DoubleDouble;

} // namespace

FixedPose::FixedPose(const GeneralPose<Wide>& pose) : refined(pose), in_double(rounded_pose(pose)) {}

FixedPose::FixedPose(const Pose& given) {
    refined = pose_in<Wide>(is_ordinary(given) ? given : Pose(given.translation, Eigen::Quaterniond(given.rotation)));
    const Wide inverse = Wide(1.0) / sqrt(refined.rotation.squared_norm());
    refined.rotation = {refined.rotation.w * inverse, scale(refined.rotation.v, inverse)};
    in_double = rounded_pose(refined);
}

FixedPose FixedPose::inverse() const {
    const Quaternion<Wide> back = refined.rotation.conjugate();
    return FixedPose(GeneralPose<Wide>{Vector3<Wide>() - turned_by_unit(back, refined.translation), back});
}

FixedPose operator*(const FixedPose& outer, const FixedPose& inner) {
    return FixedPose({turned_by_unit(outer.refined.rotation, inner.refined.translation) + outer.refined.translation,
                      outer.refined.rotation * inner.refined.rotation});
}

Eigen::Vector3d of_order_one(const Eigen::Vector3d& direction) {
    return std::ldexp(1.0, -std::ilogb(direction.cwiseAbs().maxCoeff())) * direction;
}

FixedAxis::FixedAxis(const Eigen::Vector3d& direction) {
    const Vector3<Wide> scaled = vector_in<Wide>(of_order_one(direction));
    *this = FixedAxis(scale(scaled, Wide(1.0) / length(scaled)));
}

} // namespace chasles::motion
