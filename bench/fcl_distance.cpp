#include "bench/fcl_distance.h"

#include "bench/fcl_model.h"
#include "chasles/motion/any_trajectory.h"

#include <algorithm>
#include <fcl/narrowphase/distance.h>

namespace chasles::bench {

struct FclDistance::Models {
    std::shared_ptr<const fcl::BVHModel<fcl::OBBRSSd>> moving; // the volumes that FCL's distances are fastest with
    std::shared_ptr<const fcl::BVHModel<fcl::OBBRSSd>> fixed;
};

FclDistance::FclDistance(const Polyhedron& moving, const Polyhedron& fixed)
    : models_(std::make_unique<const Models>(Models{fcl_model_of(moving), fcl_model_of(fixed)})) {}

FclDistance::~FclDistance() = default;

double FclDistance::least(const Motion& motion, int samples) const {
    double least = 1e300;
    for (int i = 0; i < samples; ++i) {
        const double time = double(i) / (samples - 1);
        const fcl::Transform3d pose = motion.trajectory().pose_at(time).isometry();
        fcl::DistanceResultd result;
        fcl::distance(models_->moving.get(), pose, models_->fixed.get(), fcl::Transform3d(fcl::Transform3d::Identity()),
                      fcl::DistanceRequestd(), result);
        least = std::min(least, std::max(0.0, result.min_distance));
    }
    return least;
}

} // namespace chasles::bench
