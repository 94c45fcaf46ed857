// Boxes and slabs of the two hierarchies over an interval of time that is seen as straight: when may they meet?
// Source: docs/derivations/14-node-pairs.md.
#pragma once

#include "chasles/hierarchy/bvh.h"

#include <Eigen/Core>
#include <array>

namespace chasles::culling {

/// A part of an interval of time; all of it is [0, 1].
struct Window {
    float lower = 0;
    float upper = 1;

    [[nodiscard]] bool is_empty() const { return !(lower <= upper); }
};

/// Where the moving body's hierarchy is at one time: points y relative to its centre are at turn * y + offset, relative
/// to the centre of the fixed one.
struct Placement {
    Eigen::Matrix3d turn;
    Eigen::Vector3d offset;
};

/// By how much the boxes are to be widened.
struct BoxSlack {
    double moving = 0; ///< points of the moving body, in the frame of the fixed one
    double fixed = 0;  ///< the other way round
    double margin = 0; ///< points within this distance meet
};

/// Two nodes of one body, which may be the same.
using TwoNodes = std::array<const BvhNode*, 2>;

/// Both ends of an interval, prepared for pairs of nodes.
class SweptBoxes {
public:
    SweptBoxes(const Placement& start, const Placement& end, const BoxSlack& slack);

    /// When two nodes of the one body may meet two nodes of the other, within `when`: the first with both, then the
    /// second with both. Empty where they are proven not to.
    using Windows = std::array<Window, 4>;
    [[nodiscard]] Windows overlap_windows(const TwoNodes& moving, const TwoNodes& fixed, const Window& when) const;

    /// A number at the start and at the end, for four pairs of nodes.
    struct alignas(32) BothEnds {
        std::array<float, 8> lanes{};
    };

    /// Points of one body in the frame of the other.
    struct View {
        BothEnds turn[3][3]; ///< rows
        BothEnds offset[3];
        float slack = 0;
    };

private:
    View moving_; ///< seen from the fixed body
    View fixed_;
    float margin_;
};

} // namespace chasles::culling
