// The time windows in which nodes of two hierarchies may overlap, if every point moves on a chord over an interval.
// Outside its window a pair is proven apart. Source: docs/derivations/14-node-pairs.md.
#pragma once

#include "chasles/hierarchy/bvh.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace chasles::culling {

/// A part of an interval of time. The whole interval is [0, 1].
struct Window {
    float lower = 0;
    float upper = 1;

    [[nodiscard]] bool is_empty() const { return !(lower <= upper); }
};

inline constexpr Window empty_window{1, 0};

/// The window from this share of it on, rounded outward.
inline Window from_share(const Window& when, double share) {
    const double lower = when.lower + share * (double(when.upper) - when.lower);
    return {std::max(when.lower, float(lower) * (1 - 0x1p-20F)), when.upper};
}

/// The window up to a time, in the unit of the interval, that is not before the window; rounded outward.
inline Window until(const Window& when, double end) {
    return {when.lower, std::max(when.lower, std::min(when.upper, float(end) * (1 + 0x1p-20F)))};
}

/// The window relative to the earlier or later half of the interval, cut off at the ends of the half. It is exact.
inline Window in_half(const Window& when, bool later) {
    const float offset = later ? 1 : 0;
    return {std::max(0.0F, 2 * when.lower - offset), std::min(1.0F, 2 * when.upper - offset)};
}

/// The placement of the moving hierarchy at one time: a point y relative to its centre is at rotation * y + offset,
/// relative to the centre of the fixed hierarchy.
struct Placement {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d offset;
};

/// The lengths by which the boxes are widened, in the length unit.
struct BoxSlack {
    double moving = 0; ///< for points of the moving body in the frame of the fixed body
    double fixed = 0;  ///< for points of the fixed body in the frame of the moving body
    double margin = 0; ///< points within this distance count as touching
};

/// Two nodes of one body. Both may be the same node.
using TwoNodes = std::array<const BvhNode*, 2>;

/// The placements at both ends of an interval, prepared for tests of node pairs.
class SweptBoxes {
public:
    SweptBoxes(const Placement& start, const Placement& end, const BoxSlack& slack);

    /// Changes the distance within which points count as touching.
    void set_margin(double margin) { margin_ = float(margin); }

    /// The windows, within `when`, in which two nodes of the moving body may touch two nodes of the fixed body. The
    /// order of the pairs is 00, 01, 10, 11. The window of a pair that is proven apart is empty.
    using Windows = std::array<Window, 4>;
    [[nodiscard]] Windows overlap_windows(const TwoNodes& moving, const TwoNodes& fixed, const Window& when) const;

    /// Lower bounds of the distances of four pairs of nodes; 0 where no tested direction separates them.
    struct Gaps {
        std::array<float, 4> start;                ///< of the interval
        std::array<float, 4> on_way;               ///< during the whole interval
        std::array<std::array<float, 4>, 3> along; ///< x, y, z: the gap at the start is along this vector of the fixed
                                                   ///< body's frame, which is no longer than 1
    };
    /// Of the same pairs, in the same order. The margin does not count.
    [[nodiscard]] Gaps widest_gaps(const TwoNodes& moving, const TwoNodes& fixed) const;

    /// A number at the start (four lanes) and at the end (four lanes) of the interval.
    struct alignas(32) BothEnds {
        std::array<float, 8> lanes{};
    };

    /// The map of points of one body to the frame of the other body.
    struct View {
        BothEnds rotation[3][3]; ///< rows
        BothEnds offset[3];
        float slack = 0;
    };

private:
    View moving_; ///< points of the moving body in the frame of the fixed body
    View fixed_;
    float margin_;
};

} // namespace chasles::culling
