// Where a query has the moving body at a time.
#pragma once

#include "chasles/query/first_contact.h"

#include <Eigen/Geometry>
#include <vector>

namespace chasles::bench {

/// The poses of a screw that is cut by the query's `max_turn`: each piece is a motion of its own.
class PiecewisePoses {
public:
    explicit PiecewisePoses(const FirstContactQuery& query);

    [[nodiscard]] Eigen::Isometry3d at(double time) const;

private:
    std::vector<ScrewMotion> pieces_;
};

} // namespace chasles::bench
