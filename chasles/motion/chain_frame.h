// A chain of joints as one frame: fixed poses between turns and slides. The same as a product of their frames, without
// a call for each. Source: docs/derivations/29-robots.md, "Chains".
#pragma once

#include "chasles/motion/frames.h"

#include <vector>

namespace chasles::motion {

/// A fixed pose with a quaternion of unit length, in double-double and rounded to double.
struct FixedPose {
    GeneralPose<algebra::DoubleDouble> refined{{}, {algebra::DoubleDouble(1.0), {}}};
    GeneralPose<double> in_double{{}, {1, {}}};

    FixedPose() = default;
    explicit FixedPose(const GeneralPose<algebra::DoubleDouble>& pose) : refined(pose), in_double(rounded_pose(pose)) {}
    /// Normalizes the quaternion. Throws InvalidInput for a pose that cannot be used.
    explicit FixedPose(const Pose& given);

    [[nodiscard]] FixedPose inverse() const;
    friend FixedPose operator*(const FixedPose& outer, const FixedPose& inner);
};

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

/// A turn about an axis through the origin, by an angle in radians, or a slide along the axis.
struct ElementaryJoint {
    FixedAxis axis;
    std::shared_ptr<const TimePolynomial> value;
    bool turns = true;
    bool is_inverse = false; ///< by the negative value
};

/// A chain from its root outwards: fixed poses and joints in any order.
class Chain {
public:
    void add(const FixedPose& pose) {
        last_ = has_last_ ? last_ * pose : pose;
        has_last_ = true;
    }
    void add(const ElementaryJoint& joint) {
        joints_.push_back({last_, joint});
        last_ = FixedPose();
        has_last_ = false;
    }

    /// A joint after a fixed pose.
    struct Joint {
        FixedPose before;
        ElementaryJoint joint;
    };
    [[nodiscard]] const std::vector<Joint>& joints() const { return joints_; }
    [[nodiscard]] const FixedPose& last() const { return last_; } ///< after all joints

    /// Bounds of the rates of the end of the chain, whose reference is its origin, that hold for all values of turns.
    [[nodiscard]] RateBounds rates(const Bracket& times) const;
    /// The sum of the sizes of all lengths that enter, and the number of roundings, as in MovingFrame.
    [[nodiscard]] double size() const;
    [[nodiscard]] double rounding() const;

private:
    std::vector<Joint> joints_;
    FixedPose last_;
    bool has_last_ = false; ///< otherwise it is the identity
};

/// The end of a chain. The reference is its origin.
SharedFrame chain_frame(Chain chain);

} // namespace chasles::motion
