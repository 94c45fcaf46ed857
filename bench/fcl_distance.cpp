#include "bench/fcl_distance.h"

#include "bench/fcl_model.h"

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

double FclDistance::at(const Motion& motion, double time) const {
    const fcl::Transform3d moving = motion.pose_at(time).isometry(), fixed = motion.fixed_pose_at(time).isometry();
    fcl::DistanceResultd result;
    fcl::distance(models_->moving.get(), moving, models_->fixed.get(), fixed, fcl::DistanceRequestd(), result);
    return std::max(0.0, result.min_distance);
}

double FclDistance::least(const Motion& motion, int samples) const {
    double least = 1e300;
    for (int i = 0; i < samples; ++i)
        least = std::min(least, at(motion, double(i) / (samples - 1)));
    return least;
}

} // namespace chasles::bench
