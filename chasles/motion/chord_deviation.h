// The chord deviation: an upper bound of the distance between the paths of points and their chords.
// Source: docs/derivations/14-node-pairs.md.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/rational_motion.h"

namespace chasles::motion {

/// A ball around a body, in the frame of the body.
struct Ball {
    Eigen::Vector3d centre;
    double radius = 0;
};

/// Let a point of the moving ball and a point of the fixed ball touch at some tau in [from, to]. The chord of a point
/// runs straight and at constant speed between its positions at `from` and at `to`. During the whole part, the moving
/// point stays within of_moving(from, to) of its chord in the frame of the fixed body. The fixed point stays within
/// of_fixed(from, to) of its chord in the frame of the moving body. The bounds do not hold for points that do not
/// touch.
class ChordDeviation {
public:
    ChordDeviation(const RationalMotion<double>& m, const Ball& moving, const Ball& fixed);
    ChordDeviation(const RationalMotion<algebra::DoubleDouble>& motion, const Ball& moving, const Ball& fixed)
        : ChordDeviation(rounded(motion), moving, fixed) {}

    /// Both in the length unit, for 0 <= from <= to <= 1.
    [[nodiscard]] double of_moving(double from, double to) const;
    [[nodiscard]] double of_fixed(double from, double to) const;

private:
    [[nodiscard]] double least_weight(double from, double to) const;

    double cosine_rate_;      ///< e1 - 1
    double square_;           ///< |z|^2 = (e1 - 1)^2 + |a|^2
    double turn_;             ///< |z|
    double moving_swing_ = 0; ///< upper bound of |a x y + m| for moving points that touch fixed points
    double fixed_swing_ = 0;  ///< upper bound of the same for fixed points, at any time
    double cross_travel_ = 0; ///< |a x d|
};

} // namespace chasles::motion
