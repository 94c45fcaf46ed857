// Boxes of the two hierarchies under the control maps of an interval of time: are they apart all along?
// Source: docs/derivations/07-swept-boxes.md.
#pragma once

#include "chasles/elementary/error_scale.h"
#include "chasles/mesh/box_hierarchy.h"

namespace chasles::query {

/// The control maps of one interval, prepared for boxes that are relative to the centres of their hierarchies.
class SweptBoxes {
public:
    using Polynomial = algebra::Bernstein<3, double>;

    SweptBoxes(const motion::ControlMaps<double>& maps, const Eigen::Vector3d& moving_centre,
               const Eigen::Vector3d& fixed_centre, const elementary::ErrorScale& scale);

    /// What is known of two boxes over the interval.
    struct Relation {
        bool apart = false; ///< proven never to touch
        double travel = 0;  ///< how far the moving box goes, in the maximum norm
        double size = 0;    ///< the longest side of the two boxes
    };

    [[nodiscard]] Relation relation(const BoxNode& moving, const BoxNode& fixed) const;

private:
    using Lanes = algebra::Lanes<4, double>;
    using LaneVector = algebra::Vector3<Lanes>;
    using LaneMatrix = algebra::Matrix3<Lanes>;

    LaneMatrix turn_;
    LaneMatrix turn_size_; ///< magnitudes
    LaneVector offset_;    ///< of the moving centre from the fixed one
    LaneVector inverse_offset_;
    Lanes weight_;
    Lanes inverse_weight_;
    Lanes slack_;
    double spin_ = 0; ///< how far a point at distance one from the box's middle goes around it, at most
};

} // namespace chasles::query
