// Boxes and slabs of the two hierarchies over an interval of time that is seen as straight: when may they meet?
// Source: docs/derivations/14-node-pairs.md.
#pragma once

#include "chasles/mesh/box_hierarchy.h"

#include <Eigen/Core>
#include <array>
#include <span>

namespace chasles::query {

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
};

/// Both ends of an interval, prepared for pairs of nodes.
class SweptBoxes {
public:
    SweptBoxes(const Placement& start, const Placement& end, const BoxSlack& slack);

    /// When a node of one body may meet two nodes of the other that lie side by side, within `when`; empty where they
    /// are proven not to.
    using Windows = std::array<Window, 2>;
    [[nodiscard]] Windows meetings_of_moving(std::span<const BoxNode, 2> moving, const BoxNode& fixed,
                                             const Window& when) const;
    [[nodiscard]] Windows meetings_of_fixed(const BoxNode& moving, std::span<const BoxNode, 2> fixed,
                                            const Window& when) const;

    /// Two times x, y, z and nothing: for two nodes.
    struct alignas(32) TwoRows {
        std::array<float, 8> lanes{};
    };

    /// Points of one body in the frame of the other, at the start and at the end.
    struct View {
        TwoRows turn[2][3]; ///< columns
        TwoRows turn_size[2][3];
        TwoRows offset[2];
        float slack = 0;
    };

private:
    View moving_; ///< seen from the fixed body
    View fixed_;
};

} // namespace chasles::query
