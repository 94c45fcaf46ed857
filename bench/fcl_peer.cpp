#include "bench/fcl_peer.h"

#include "bench/bodies.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/motion/screw_motion.h>
#include <fcl/math/motion/translation_motion.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <map>
#include <memory>

namespace chasles::bench {

namespace {

template <class BoundingVolume>
using Model = std::shared_ptr<const fcl::BVHModel<BoundingVolume>>;

template <class BoundingVolume>
Model<BoundingVolume> model_of(const Polyhedron& body) {
    std::vector<fcl::Triangle> triangles;
    for (const auto& [a, b, c] : triangles_of(body))
        triangles.emplace_back(a, b, c);
    const std::vector<fcl::Vector3d> vertices(body.vertices().begin(), body.vertices().end());
    auto model = std::make_shared<fcl::BVHModel<BoundingVolume>>();
    model->beginModel(int(triangles.size()), int(vertices.size()));
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
}

/// One model of a body for all who hold it: those of large bodies take a hundred megabytes.
template <class BoundingVolume>
class Models {
public:
    Model<BoundingVolume> of(const Polyhedron& body) {
        std::weak_ptr<const fcl::BVHModel<BoundingVolume>>& place = made_[body.vertices().data()];
        Model<BoundingVolume> model = place.lock();
        if (!model)
            place = model = model_of<BoundingVolume>(body);
        return model;
    }

private:
    std::map<const void*, std::weak_ptr<const fcl::BVHModel<BoundingVolume>>> made_;
};

template <class BoundingVolume>
using SharedModels = std::shared_ptr<Models<BoundingVolume>>;

/// FCL's screw goes wrong where nothing turns: it takes the travel for the axis without normalising it, so that the
/// body goes d |d| instead of d. Who knows that asks for a translation then.
fcl::CCDMotionType motion_type(const Displacement& motion) {
    const double turn =
        Eigen::Quaterniond(motion.start.rotation).angularDistance(Eigen::Quaterniond(motion.goal.rotation));
    return turn < 1e-9 ? fcl::CCDM_TRANS : fcl::CCDM_SCREW;
}

Eigen::Isometry3d pose_at(const Displacement& motion, double time) {
    fcl::Transform3d pose;
    const auto follow = [&](const auto& path) {
        path.integrate(time);
        path.getCurrentTransform(pose);
    };
    if (motion_type(motion) == fcl::CCDM_TRANS)
        follow(fcl::TranslationMotion<double>(motion.start.isometry(), motion.goal.isometry()));
    else
        follow(fcl::ScrewMotion<double>(motion.start.isometry(), motion.goal.isometry()));
    return pose;
}

template <class BoundingVolume>
Peer continuous(const std::string& name, const SharedModels<BoundingVolume>& models,
                const fcl::ContinuousCollisionRequestd& request) {
    const auto prepare = [=](const Polyhedron& moving, const Polyhedron& fixed) {
        const auto ask = [request, moving = models->of(moving), fixed = models->of(fixed)](const Displacement& motion) {
            fcl::ContinuousCollisionRequestd asked = request;
            asked.ccd_motion_type = motion_type(motion);
            const fcl::Transform3d still = fcl::Transform3d::Identity();
            fcl::ContinuousCollisionResultd found;
            fcl::continuousCollide(moving.get(), motion.start.isometry(), motion.goal.isometry(), fixed.get(), still,
                                   still, asked, found);
            return found.is_collide ? PeerAnswer{true, found.time_of_contact} : PeerAnswer{};
        };
        return PeerPair{ask, pose_at};
    };
    return {.name = name, .prepare = prepare};
}

Peer sampled(const SharedModels<fcl::OBBd>& models, std::size_t samples) {
    fcl::ContinuousCollisionRequestd request;
    request.ccd_solver_type = fcl::CCDC_NAIVE;
    request.num_max_iterations = samples;
    return continuous("FCL, " + std::to_string(samples) + " samples", models, request);
}

Peer advancement(const SharedModels<fcl::OBBRSSd>& models) {
    fcl::ContinuousCollisionRequestd request;
    request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
    return continuous("FCL, conservative advancement", models, request);
}

/// One test at one pose: what yes or no costs whoever does not ask about the motion.
Peer discrete(const SharedModels<fcl::OBBd>& models) {
    const auto prepare = [=](const Polyhedron& moving, const Polyhedron& fixed) {
        const auto ask = [moving = models->of(moving), fixed = models->of(fixed)](const Displacement& motion) {
            const fcl::CollisionRequestd request(1, false); // one contact is enough, and nobody asks where it is
            fcl::CollisionResultd found;
            fcl::collide(moving.get(), motion.start.isometry(), fixed.get(), fcl::Transform3d::Identity(), request,
                         found);
            return PeerAnswer{.touches = found.isCollision(), .time = {}};
        };
        return PeerPair{ask, pose_at};
    };
    return {.name = "FCL, start pose only", .prepare = prepare};
}

} // namespace

std::vector<Peer> fcl_peers() {
    const auto boxes = std::make_shared<Models<fcl::OBBd>>();
    const auto boxes_and_swept_spheres = std::make_shared<Models<fcl::OBBRSSd>>(); // for distances
    return {discrete(boxes), sampled(boxes, 10), sampled(boxes, 100), advancement(boxes_and_swept_spheres)};
}

} // namespace chasles::bench
