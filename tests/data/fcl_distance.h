// The distance of two bodies by FCL.
#pragma once

#include "tests/data/fcl_model.h"

#include <fcl/narrowphase/distance.h>

namespace chasles::test {

/// Bodies that overlap have the distance 0 or less.
class FclDistance {
public:
    FclDistance(const Polyhedron& moving, const Polyhedron& fixed)
        : moving_(fcl_model_of(moving)), fixed_(fcl_model_of(fixed)) {}

    [[nodiscard]] double operator()(const Pose& at) const {
        fcl::DistanceResultd found;
        fcl::distance(moving_.get(), at.isometry(), fixed_.get(), fcl::Transform3d::Identity(),
                      fcl::DistanceRequestd(false, false, 0, 0), found);
        return found.min_distance;
    }

private:
    std::shared_ptr<const FclModel> moving_;
    std::shared_ptr<const FclModel> fixed_;
};

} // namespace chasles::test
