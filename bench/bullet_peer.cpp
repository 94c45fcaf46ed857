#include "bench/bullet_peer.h"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <LinearMath/btTransformUtil.h>
#include <memory>

namespace chasles::bench {

namespace {

std::shared_ptr<btConvexHullShape> hull_of(const Polyhedron& body) {
    auto hull = std::make_shared<btConvexHullShape>();
    for (const Eigen::Vector3d& vertex : body.vertices())
        hull->addPoint({vertex.x(), vertex.y(), vertex.z()}, false);
    hull->recalcLocalAabb();
    hull->setMargin(0);
    return hull;
}

btTransform transform(const Pose& pose) {
    const auto& turn = pose.rotation;
    const Eigen::Vector3d& shift = pose.translation;
    return btTransform({turn.x(), turn.y(), turn.z(), turn.w()}, {shift.x(), shift.y(), shift.z()});
}

Eigen::Isometry3d pose_at(const Displacement& motion, double time) {
    const btTransform start = transform(motion.start);
    btVector3 travel;
    btVector3 turn;
    btTransformUtil::calculateVelocity(start, transform(motion.goal), 1, travel, turn);
    btTransform reached;
    btTransformUtil::integrateTransform(start, travel, turn, time, reached);
    const btQuaternion rotation = reached.getRotation();
    const btVector3& shift = reached.getOrigin();
    return Pose({shift.x(), shift.y(), shift.z()}, {rotation.w(), rotation.x(), rotation.y(), rotation.z()}).isometry();
}

PeerPair prepare(const Polyhedron& moving, const Polyhedron& fixed) {
    const auto ask = [moving = hull_of(moving), fixed = hull_of(fixed)](const Displacement& motion) {
        btVoronoiSimplexSolver simplex;
        btGjkEpaPenetrationDepthSolver penetration;
        btContinuousConvexCollision cast(moving.get(), fixed.get(), &simplex, &penetration);
        btConvexCast::CastResult found;
        const btTransform still = btTransform::getIdentity();
        const bool touches =
            cast.calcTimeOfImpact(transform(motion.start), transform(motion.goal), still, still, found);
        return touches ? PeerAnswer{true, found.m_fraction} : PeerAnswer{};
    };
    return {ask, pose_at};
}

} // namespace

Peer bullet_peer() {
    return {.name = "Bullet, convex cast", .prepare = prepare, .is_for_convex_bodies_only = true};
}

} // namespace chasles::bench
