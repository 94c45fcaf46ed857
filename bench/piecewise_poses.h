// The pose of the moving body at a time of a query.
#pragma once

#include "chasles/motion/motion.h"

#include <Eigen/Geometry>
#include <vector>

namespace chasles::bench {

/// The poses of a screw that the query cuts by its `max_turn`. Each piece is a separate motion.
class PiecewisePoses {
public:
    explicit PiecewisePoses(const ScrewMotion& motion) : pieces_(motion.pieces()) {}

    [[nodiscard]] Eigen::Isometry3d at(double time) const;

private:
    std::vector<ScrewMotion> pieces_;
};

} // namespace chasles::bench
