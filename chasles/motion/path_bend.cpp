#include "chasles/motion/path_bend.h"

#include "chasles/motion/screw_pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace chasles::motion {

namespace {

using Scalar = algebra::DoubleDouble;

/// Some twenty roundings, and as many again.
constexpr double rounding = 1e-14;

} // namespace

PathBend::PathBend(const RationalMotion<Scalar>& motion, const Ball& moving, const Ball& fixed)
    : cosine_rate_(double(motion.end_cosine) - 1) {
    const Eigen::Vector3d axis = rounded(motion.axis);
    const Eigen::Vector3d moment = rounded(motion.moment);
    const Eigen::Vector3d origin = rounded(motion.origin);
    square_ = cosine_rate_ * cosine_rate_ + axis.squaredNorm();
    turn_ = std::sqrt(square_);
    Eigen::Vector3d start;
    for (int i = 0; i < 3; ++i) {
        const Vector3<Scalar>& row = motion.orientation.row[i];
        start[i] =
            double(row.x) * moving.centre.x() + double(row.y) * moving.centre.y() + double(row.z) * moving.centre.z();
    }
    cross_travel_ = axis.cross(rounded(motion.displacement)).norm();
    const auto swing = [&](const Eigen::Vector3d& centre, double radius, double size) {
        return (axis.cross(centre) + moment).norm() + axis.norm() * (radius + rounding * size) +
               rounding * moment.norm();
    };
    const double of_moving = swing(start, moving.radius, start.norm());
    const double of_fixed =
        swing(fixed.centre - origin, fixed.radius, fixed.centre.norm() + origin.norm()) + cross_travel_;
    moving_swing_ = std::min(of_moving, of_fixed);
    fixed_swing_ = std::min(of_fixed, of_moving + cross_travel_);
}

double PathBend::of_moving(double from, double to) const {
    const double step = to - from;
    const double weight = least_weight(from, to);
    return 0.5 * step * step * turn_ * moving_swing_ / (weight * std::sqrt(weight)) * (1 + rounding);
}

double PathBend::of_fixed(double from, double to) const {
    const double step = to - from;
    const double weight = least_weight(from, to);
    return 0.5 * step * step * (turn_ * fixed_swing_ / (weight * std::sqrt(weight)) + cross_travel_ / weight) *
           (1 + rounding);
}

/// W = 1 + 2 (e1 - 1) tau + |z|^2 tau^2 is least at its vertex or at the end that is next to it.
double PathBend::least_weight(double from, double to) const {
    const double vertex = square_ > 0 ? std::clamp(-cosine_rate_ / square_, from, to) : from;
    return 1 + vertex * (2 * cosine_rate_ + square_ * vertex);
}

} // namespace chasles::motion
