// Poses and axes that stay, in double-double and rounded to double.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/rational_motion.h"

#include <type_traits>

namespace chasles::motion {

/// A fixed pose with a quaternion of unit length, in double-double and rounded to double.
struct FixedPose {
    GeneralPose<algebra::DoubleDouble> refined{{}, {algebra::DoubleDouble(1.0), {}}};
    GeneralPose<double> in_double{{}, {1, {}}};

    FixedPose() = default;
    explicit FixedPose(const GeneralPose<algebra::DoubleDouble>& pose);
    /// Normalizes the quaternion. Throws InvalidInput for a pose that cannot be used.
    explicit FixedPose(const Pose& given);

    [[nodiscard]] FixedPose inverse() const;
    friend FixedPose operator*(const FixedPose& outer, const FixedPose& inner);
};

/// The direction, times the power of two that brings its largest component to the order of one: no square underflows,
/// and nothing is rounded.
Eigen::Vector3d of_order_one(const Eigen::Vector3d& direction);

/// An axis of unit length, in double-double and rounded to double.
struct FixedAxis {
    Vector3<algebra::DoubleDouble> refined;
    Vector3<double> in_double;

    FixedAxis() = default;
    explicit FixedAxis(const Vector3<algebra::DoubleDouble>& axis)
        : refined(axis), in_double(motion::in_double(axis)) {}
    /// From a direction of any non-zero length.
    explicit FixedAxis(const Eigen::Vector3d& direction);
};

/// The vector, turned by a quaternion of unit length.
template <class S>
Vector3<S> turned_by_unit(const Quaternion<S>& unit, const Vector3<S>& v) {
    const Vector3<S> across = cross(unit.v, v);
    return v + scale(scale(across, unit.w) + cross(unit.v, across), S(2));
}

/// One of both, by the scalar.
template <class S, class Both>
const auto& in(const Both& both) {
    if constexpr (std::is_same_v<S, double>)
        return both.in_double;
    else
        return both.refined;
}

} // namespace chasles::motion
