#include "bench/piecewise_poses.h"

#include <algorithm>

namespace chasles::bench {

Eigen::Isometry3d PiecewisePoses::at(double time) const {
    const double scaled = time * double(pieces_.size());
    const std::size_t index = std::min(std::size_t(scaled), pieces_.size() - 1);
    return pieces_[index].pose_at(scaled - double(index)).isometry();
}

} // namespace chasles::bench
