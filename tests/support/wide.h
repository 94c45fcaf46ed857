// Numbers with a hundred decimal digits, and the paper's screw with sines and cosines of these numbers.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/rational_motion.h"

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

namespace chasles::test {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;
using WideVector = Eigen::Matrix<Wide, 3, 1>;
using WideMatrix = Eigen::Matrix<Wide, 3, 3>;

inline Wide wide(const algebra::DoubleDouble& x) {
    return Wide(x.high()) + Wide(x.low());
}
inline Wide wide(double x) {
    return Wide(x);
}

template <class S>
WideVector wide(const algebra::Vector3<S>& v) {
    return {wide(v.x), wide(v.y), wide(v.z)};
}
inline WideVector wide(const Eigen::Vector3d& v) {
    return v.cast<Wide>();
}

/// Rodrigues' formula: v turned by `angle` about the unit vector k.
inline WideVector turned(const WideVector& v, const WideVector& k, const Wide& angle) {
    const Wide c = cos(angle);
    return v * c + k.cross(v) * Wide(sin(angle)) + k * Wide(k.dot(v) * (1 - c));
}

/// The turn of a quaternion of any length: an angle in [0, pi] and a unit axis.
struct AxisAngle {
    WideVector axis = WideVector::UnitZ();
    Wide angle = 0;
};

inline AxisAngle axis_angle(const Wide& w, const WideVector& v) {
    const Wide length = sqrt(v.dot(v));
    if (length == 0)
        return {};
    const Wide sign = w < 0 ? -1 : 1;
    return {v * Wide(sign / length), 2 * atan2(length, Wide(sign * w))};
}

/// A rigid displacement of points.
struct WidePose {
    WideVector translation;
    AxisAngle rotation;

    explicit WidePose(const motion::GeneralPose<algebra::DoubleDouble>& pose)
        : translation(wide(pose.translation)), rotation(axis_angle(wide(pose.rotation.w), wide(pose.rotation.v))) {}
    explicit WidePose(const Pose& pose)
        : translation(wide(pose.translation)),
          rotation(axis_angle(Wide(pose.rotation.w()), wide(Eigen::Vector3d(pose.rotation.vec())))) {}

    [[nodiscard]] WideVector of(const WideVector& point) const {
        return turned(point, rotation.axis, rotation.angle) + translation;
    }
    [[nodiscard]] WideVector inverse_of(const WideVector& point) const {
        return turned(point - translation, rotation.axis, -rotation.angle);
    }
    [[nodiscard]] WideMatrix matrix() const {
        WideMatrix result;
        for (int i = 0; i < 3; ++i)
            result.col(i) = turned(WideVector::Unit(i), rotation.axis, rotation.angle);
        return result;
    }
};

/// The screw from one pose to another by its definition: axis through `point`, rotation w t, slide s f(t).
class WideScrew {
public:
    WideScrew(const WidePose& start, const WidePose& goal) : start_(start) {
        const WideMatrix turn = goal.matrix() * start.matrix().transpose();
        const WideVector twice_sine(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
        const Wide sine = sqrt(twice_sine.dot(twice_sine)) / 2;
        angle_ = atan2(sine, Wide((turn.trace() - 1) / 2));
        axis_ = twice_sine / Wide(2 * sine);
        const WideVector shift = goal.translation - turn * start.translation;
        slide_ = axis_.dot(shift);
        // The axis point nearest to the world's origin moves only by the slide.
        const WideMatrix moved = WideMatrix::Identity() - turn + axis_ * axis_.transpose();
        point_ = solved(moved, shift - axis_ * slide_);
    }

    [[nodiscard]] const Wide& angle() const { return angle_; }
    [[nodiscard]] const Wide& slide() const { return slide_; }
    [[nodiscard]] const WideVector& axis() const { return axis_; }
    [[nodiscard]] const WideVector& point() const { return point_; }

    /// f(t) of the paper.
    [[nodiscard]] Wide tau(const Wide& time) const { return tan(Wide(angle_ * time / 2)) / tan(Wide(angle_ / 2)); }

    /// The position of a body point at a time.
    [[nodiscard]] WideVector position(const WideVector& body_point, const Wide& time) const {
        const WideVector arm = start_.of(body_point) - point_;
        return point_ + turned(arm, axis_, angle_ * time) + axis_ * Wide(slide_ * tau(time));
    }

private:
    /// Solves a linear system by Cramer's rule.
    static WideVector solved(const WideMatrix& m, const WideVector& right) {
        const WideVector c[3] = {m.col(0), m.col(1), m.col(2)};
        const Wide determinant = c[0].dot(c[1].cross(c[2]));
        return {right.dot(c[1].cross(c[2])) / determinant, c[0].dot(right.cross(c[2])) / determinant,
                c[0].dot(c[1].cross(right)) / determinant};
    }

    WidePose start_;
    Wide angle_;
    WideVector axis_;
    Wide slide_;
    WideVector point_;
};

inline double distance(const WideVector& a, const WideVector& b) {
    const WideVector d = a - b;
    return static_cast<double>(Wide(sqrt(d.dot(d))));
}

} // namespace chasles::test
