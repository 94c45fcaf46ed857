// How far the paths of points bend away from their chords: what it takes to see a part of a motion as straight.
// Source: docs/derivations/14-node-pairs.md.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/rational_motion.h"

namespace chasles::motion {

/// A ball around a body, in its own frame.
struct Ball {
    Eigen::Vector3d centre;
    double radius = 0;
};

/// Let a point of the moving ball and one of the fixed ball meet in the part [from, to] of tau. In the frame of the
/// fixed body the former is then, all along the part, no further than of_moving(from, to) from the point that runs
/// straight and evenly from where it is at `from` to where it is at `to`; and so is the latter, seen from the moving
/// body, within of_fixed(from, to). Points that do not meet may be further off, which matters to nobody.
class ChordDeviation {
public:
    ChordDeviation(const RationalMotion<algebra::DoubleDouble>& motion, const Ball& moving, const Ball& fixed);

    [[nodiscard]] double of_moving(double from, double to) const;
    [[nodiscard]] double of_fixed(double from, double to) const;

private:
    [[nodiscard]] double least_weight(double from, double to) const;

    double cosine_rate_;      ///< e1 - 1
    double square_;           ///< |z|^2 = (e1 - 1)^2 + |a|^2
    double turn_;             ///< |z|
    double moving_swing_ = 0; ///< |a x y + m| at most, of moving points that meet fixed ones
    double fixed_swing_ = 0;  ///< the same of fixed points, at any time
    double cross_travel_ = 0; ///< |a x d|
};

} // namespace chasles::motion
