#include "bench/fcl_peer.h"

#include "bench/fcl_model.h"
#include "chasles/query/first_contact.h"
#include "scenes/stopwatch.h"

#include <algorithm>
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

/// Models of bodies, shared by all their users: a model of a large body takes a hundred megabytes.
template <class BoundingVolume>
class Models {
public:
    Model<BoundingVolume> of(const Polyhedron& body) {
        std::weak_ptr<const fcl::BVHModel<BoundingVolume>>& place = made_[body.vertices().data()];
        Model<BoundingVolume> model = place.lock();
        if (!model)
            place = model = fcl_model_of<BoundingVolume>(body);
        return model;
    }

private:
    std::map<const void*, std::weak_ptr<const fcl::BVHModel<BoundingVolume>>> made_;
};

template <class BoundingVolume>
using SharedModels = std::shared_ptr<Models<BoundingVolume>>;

/// FCL's screw is wrong for a motion without rotation: FCL uses the displacement d as the axis without normalising it,
/// and the body moves by d |d| instead of d. FCL's translation is correct, so it is used instead.
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

/// The pose at which a discrete test takes longest: a millionth of the motion before the contact, or the goal if clear.
Eigen::Isometry3d hardest_pose(const Polyhedron& moving, const Polyhedron& fixed, const Displacement& motion) {
    const chasles::ScrewMotion screw = chasles::ScrewMotion::between(motion.start, motion.goal);
    const FirstContact found = first_contact({.moving = moving, .fixed = fixed, .motion = screw});
    return screw.pose_at(found.verdict == Verdict::clear ? 1 : found.time.lower * (1 - 1e-6)).isometry();
}

/// The hardest poses of the queries of a pair, each computed once. This computation is not part of the peer's time.
class HardestPoses {
public:
    HardestPoses(const Polyhedron& moving, const Polyhedron& fixed) : moving_(moving), fixed_(fixed) {}

    Eigen::Isometry3d of(const Displacement& motion) {
        const auto place = std::find_if(known_.begin(), known_.end(), [&](const Known& known) {
            return are_same(known.motion.start, motion.start) && are_same(known.motion.goal, motion.goal);
        });
        if (place != known_.end())
            return place->pose;
        known_.push_back({motion, hardest_pose(moving_, fixed_, motion)});
        return known_.back().pose;
    }

private:
    struct Known {
        Displacement motion;
        Eigen::Isometry3d pose;
    };

    static bool are_same(const Pose& a, const Pose& b) {
        return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
    }

    const Polyhedron& moving_;
    const Polyhedron& fixed_;
    std::vector<Known> known_;
};

/// Stops at one contact and does not compute its position.
PeerAnswer answer_at(const Eigen::Isometry3d& pose, const Model<fcl::OBBd>& moving, const Model<fcl::OBBd>& fixed) {
    const fcl::CollisionRequestd request(1, false);
    fcl::CollisionResultd found;
    fcl::collide(moving.get(), pose, fixed.get(), fcl::Transform3d::Identity(), request, found);
    return {.touches = found.isCollision(), .time = {}};
}

/// One discrete test at the start pose: the cost of a yes or no that ignores the motion.
Peer at_the_start(const SharedModels<fcl::OBBd>& models) {
    const auto prepare = [=](const Polyhedron& moving, const Polyhedron& fixed) {
        const auto ask = [moving = models->of(moving), fixed = models->of(fixed)](const Displacement& motion) {
            return answer_at(motion.start.isometry(), moving, fixed);
        };
        return PeerPair{ask, pose_at};
    };
    return {.name = "FCL, start pose only", .prepare = prepare};
}

/// One discrete test at the hardest pose: the largest cost of one sample of a motion.
Peer before_the_contact(const SharedModels<fcl::OBBd>& models) {
    const auto prepare = [=](const Polyhedron& moving, const Polyhedron& fixed) {
        const auto poses = std::make_shared<HardestPoses>(moving, fixed);
        const auto ask = [=, a = models->of(moving), b = models->of(fixed)](const Displacement& motion) {
            const Eigen::Isometry3d pose = poses->of(motion);
            const scenes::Stopwatch watch;
            PeerAnswer answer = answer_at(pose, a, b);
            answer.seconds = watch.seconds();
            return answer;
        };
        return PeerPair{ask, pose_at};
    };
    return {.name = "FCL, pose before the contact", .prepare = prepare};
}

} // namespace

std::vector<Peer> fcl_peers() {
    const auto boxes = std::make_shared<Models<fcl::OBBd>>();
    const auto boxes_and_swept_spheres = std::make_shared<Models<fcl::OBBRSSd>>(); // for distance queries
    return {at_the_start(boxes), before_the_contact(boxes), sampled(boxes, 10), sampled(boxes, 100),
            advancement(boxes_and_swept_spheres)};
}

} // namespace chasles::bench
