// A chain of joints as one frame: fixed poses between turns and slides. The same as a product of their frames, without
// a call for each. Source: docs/derivations/29-robots.md, "Chains".
#pragma once

#include "chasles/motion/fixed_pose.h"
#include "chasles/motion/frames.h"

#include <vector>

namespace chasles::motion {

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
