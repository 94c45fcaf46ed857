#include "bench/bullet_hand.h"

#include "bench/bodies.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <Eigen/Geometry>
#include <btBulletDynamicsCommon.h>

namespace chasles::bench {

namespace {

using Eigen::Vector3d;

/// Bullet is made for bodies of about a metre: the dragged body gets this radius.
constexpr double usual_radius = 0.5;
/// Its own choice, 0.04, would close every hole of the scenes.
constexpr double collision_margin = 1e-3;
constexpr double spring_rate = 30; // radians a second: half a radian in a step at 60 Hz

double radius_of(const Polyhedron& body) {
    return (body.report().upper - body.report().lower).norm() / 2;
}

Vector3d middle_of(const Polyhedron& body) {
    return (body.report().upper + body.report().lower) / 2;
}

btVector3 vector_of(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

/// The triangles of a body, scaled and with their origin at a point of it.
std::unique_ptr<btTriangleMesh> mesh_of(const Polyhedron& body, double scale, const Vector3d& origin) {
    auto mesh = std::make_unique<btTriangleMesh>();
    const auto corner = [&](std::uint32_t id) { return vector_of(scale * (body.vertices()[id] - origin)); };
    for (const auto& triangle : triangles_of(body))
        mesh->addTriangle(corner(triangle[0]), corner(triangle[1]), corner(triangle[2]));
    return mesh;
}

} // namespace

class BulletHand::World {
public:
    World(const Polyhedron& moving, const Polyhedron& fixed, const Pose& start, const BulletHandOptions& options)
        : options_(options), scale_(usual_radius / radius_of(moving)), origin_(middle_of(moving)),
          dispatcher_(&configuration_), world_(&dispatcher_, &broad_phase_, &solver_, &configuration_),
          fixed_mesh_(mesh_of(fixed, scale_, Vector3d::Zero())), fixed_shape_(fixed_mesh_.get(), true) {
        btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
        world_.setGravity({0, 0, 0});
        fixed_shape_.setMargin(collision_margin);
        fixed_body_ = std::make_unique<btRigidBody>(0, nullptr, &fixed_shape_);
        world_.addRigidBody(fixed_body_.get());
        add_moving(moving, start);
        add_hand(start);
    }
    ~World() {
        world_.removeConstraint(tie_.get());
        for (btRigidBody* body : {hand_.get(), body_.get(), fixed_body_.get()})
            world_.removeRigidBody(body);
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    void step(const Pose& goal) {
        hand_->setWorldTransform(transform_of(goal));
        hand_->setInterpolationWorldTransform(transform_of(goal));
        body_->activate(true);
        world_.stepSimulation(1 / options_.rate, 0);
    }

    [[nodiscard]] Pose pose() const {
        const btTransform at = body_->getWorldTransform();
        const btQuaternion turn = at.getRotation();
        const Eigen::Quaterniond rotation = Eigen::Quaterniond(turn.w(), turn.x(), turn.y(), turn.z()).normalized();
        const btVector3& middle = at.getOrigin();
        return {Vector3d(middle.x(), middle.y(), middle.z()) / scale_ - rotation * origin_, rotation};
    }

private:
    [[nodiscard]] btTransform transform_of(const Pose& pose) const {
        const Eigen::Quaterniond turn(pose.rotation);
        const Vector3d middle = scale_ * (pose.isometry() * origin_);
        return btTransform({turn.x(), turn.y(), turn.z(), turn.w()}, vector_of(middle));
    }

    void add_moving(const Polyhedron& moving, const Pose& start) {
        if (options_.is_convex) {
            auto hull = std::make_unique<btConvexHullShape>();
            for (const Vector3d& vertex : moving.vertices())
                hull->addPoint(vector_of(scale_ * (vertex - origin_)), false);
            hull->recalcLocalAabb();
            shape_ = std::move(hull);
        } else {
            moving_mesh_ = mesh_of(moving, scale_, origin_);
            auto mesh = std::make_unique<btGImpactMeshShape>(moving_mesh_.get());
            mesh->updateBound();
            shape_ = std::move(mesh);
        }
        shape_->setMargin(collision_margin);
        if (!options_.is_convex)
            static_cast<btGImpactMeshShape&>(*shape_).postUpdate();
        // as by default in Chasles: the box around the body
        const Vector3d size = scale_ * (moving.report().upper - moving.report().lower);
        inertia_ = btVector3(size.y() * size.y() + size.z() * size.z(), size.x() * size.x() + size.z() * size.z(),
                             size.x() * size.x() + size.y() * size.y()) /
                   12;
        body_ = std::make_unique<btRigidBody>(1, nullptr, shape_.get(), inertia_);
        body_->setWorldTransform(transform_of(start));
        body_->setInterpolationWorldTransform(transform_of(start));
        body_->setFriction(0);
        body_->setActivationState(DISABLE_DEACTIVATION);
        // its guard against tunnelling
        body_->setCcdMotionThreshold(0.1 * usual_radius);
        body_->setCcdSweptSphereRadius(0.1 * usual_radius);
        world_.addRigidBody(body_.get());
    }

    void add_hand(const Pose& start) {
        hand_ = std::make_unique<btRigidBody>(0, nullptr, &hand_shape_);
        hand_->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT | btCollisionObject::CF_NO_CONTACT_RESPONSE);
        hand_->setActivationState(DISABLE_DEACTIVATION);
        hand_->setWorldTransform(transform_of(start));
        world_.addRigidBody(hand_.get(), 0, 0);
        const btTransform here = btTransform::getIdentity();
        tie_ = std::make_unique<btGeneric6DofSpring2Constraint>(*hand_, *body_, here, here);
        for (int i = 0; i < 6; ++i) {
            if (options_.tie == BulletTie::fixed) {
                tie_->setLimit(i, 0, 0);
                continue;
            }
            const double mass = i < 3 ? 1 : double(inertia_[i - 3]);
            tie_->setLimit(i, 1, -1); // free
            tie_->enableSpring(i, true);
            tie_->setStiffness(i, mass * spring_rate * spring_rate);
            tie_->setDamping(i, 2 * mass * spring_rate);
            tie_->setEquilibriumPoint(i, 0);
        }
        world_.addConstraint(tie_.get(), true);
    }

    BulletHandOptions options_;
    double scale_;
    Vector3d origin_;
    btVector3 inertia_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    std::unique_ptr<btTriangleMesh> fixed_mesh_;
    std::unique_ptr<btTriangleMesh> moving_mesh_;
    btBvhTriangleMeshShape fixed_shape_;
    btEmptyShape hand_shape_;
    std::unique_ptr<btCollisionShape> shape_;
    std::unique_ptr<btRigidBody> fixed_body_;
    std::unique_ptr<btRigidBody> body_;
    std::unique_ptr<btRigidBody> hand_;
    std::unique_ptr<btGeneric6DofSpring2Constraint> tie_;
};

BulletHand::BulletHand(const Polyhedron& moving, const Polyhedron& fixed, const Pose& start,
                       const BulletHandOptions& options)
    : world_(std::make_unique<World>(moving, fixed, start, options)) {}
BulletHand::~BulletHand() = default;

void BulletHand::step(const Pose& goal) {
    world_->step(goal);
}

Pose BulletHand::pose() const {
    return world_->pose();
}

} // namespace chasles::bench
