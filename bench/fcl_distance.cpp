#include "bench/fcl_distance.h"

#include "bench/bodies.h"
#include "chasles/motion/any_trajectory.h"

#include <algorithm>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>

namespace chasles::bench {

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>; // the volumes that FCL's distances are fastest with

std::unique_ptr<Model> model_of(const Polyhedron& body) {
    std::vector<fcl::Triangle> triangles;
    for (const auto& [a, b, c] : triangles_of(body))
        triangles.emplace_back(a, b, c);
    auto model = std::make_unique<Model>();
    model->beginModel(int(triangles.size()), int(body.vertices().size()));
    model->addSubModel(std::vector<fcl::Vector3d>(body.vertices().begin(), body.vertices().end()), triangles);
    model->endModel();
    return model;
}

} // namespace

struct FclDistance::Models {
    std::unique_ptr<Model> moving;
    std::unique_ptr<Model> fixed;
};

FclDistance::FclDistance(const Polyhedron& moving, const Polyhedron& fixed)
    : models_(std::make_unique<const Models>(Models{model_of(moving), model_of(fixed)})) {}

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
