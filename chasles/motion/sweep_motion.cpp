#include "chasles/motion/sweep_motion.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/control_maps.h"
#include "chasles/motion/screw_path.h"

#include <cmath>

namespace chasles {

namespace {

using Scalar = algebra::DoubleDouble;

motion::Quaternion<Scalar> unit_turn(const MotionFrame& frame) {
    const motion::Quaternion<Scalar> turn = motion::turn_between(frame.start, frame.goal);
    const Scalar inverse = Scalar(1.0) / sqrt(turn.squared_norm());
    return {turn.w * inverse, scale(turn.v, inverse)};
}

} // namespace

SweepMotion SweepMotion::from(MotionFrame frame, const Eigen::Vector3d& centre) {
    if (!centre.allFinite())
        throw InvalidInput("motion: centre: a number is NaN or infinite");
    if (centre.cwiseAbs().maxCoeff() > Pose::largest_length)
        throw InvalidInput("motion: centre: a number is larger than 1e30");
    const algebra::Vector3<Scalar> reference{centre.x(), centre.y(), centre.z()};
    SweepMotion sweep;
    frame.motion = motion::sweep_between(frame.start, frame.goal, unit_turn(frame), reference);
    frame.swept_centre = centre;
    sweep.frame_ = std::move(frame);
    return sweep;
}

SweepMotion SweepMotion::between(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre) {
    return from(MotionFrame(MotionEnds::between(start, goal)), centre);
}

SweepMotion SweepMotion::relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                  const Pose& fixed_goal) {
    return from(MotionFrame(MotionEnds::relative(moving_start, moving_goal, fixed_start, fixed_goal)),
                Eigen::Vector3d::Zero());
}

SweepMotion SweepMotion::about(const Eigen::Vector3d& centre) const {
    return from(frame_, centre);
}

double SweepMotion::angle() const {
    return motion::turn_angle(frame_.start, frame_.goal).angle;
}

Eigen::Vector3d SweepMotion::displacement() const {
    const auto& d = frame_.motion.displacement;
    return {d.x.high(), d.y.high(), d.z.high()};
}

Pose SweepMotion::pose_at(double time) const {
    if (time <= 0 || time >= 1)
        return frame_.pose_at_end(time);
    const auto& m = frame_.motion;
    const Scalar tau(time);
    const Scalar even = Scalar(1.0) + tau * (m.end_cosine - Scalar(1.0));
    const motion::Quaternion<Scalar> turn{even, scale(m.axis, tau)};
    // The body's origin is the body point zero, so that only the shift of the control maps moves it.
    const auto maps = motion::control_maps(m);
    const Scalar inverse = Scalar(1.0) / value_at(maps.weight, tau);
    const algebra::Vector3<Scalar> position{value_at(maps.translation.x, tau) * inverse,
                                            value_at(maps.translation.y, tau) * inverse,
                                            value_at(maps.translation.z, tau) * inverse};
    return frame_.in_world(motion::rounded({position, turn * frame_.start.rotation}), time);
}

} // namespace chasles
