#include "bench/bullet_scene.h"

#include "bench/bodies.h"
#include "chasles/mesh/body.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <Eigen/Geometry>
#include <btBulletDynamicsCommon.h>
#include <vector>

namespace chasles::bench {

namespace {

using Eigen::Vector3d;

/// Bullet's own choice, 0.04, would report bodies that are far apart.
constexpr double collision_margin = 1e-6;
/// Of the ball that is swept, over the radius of the body: as in drag_peers_bench.
constexpr double swept_share = 0.1;

btVector3 vector_of(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

std::unique_ptr<btTriangleMesh> mesh_of(const Polyhedron& body, const Vector3d& origin) {
    auto mesh = std::make_unique<btTriangleMesh>();
    const auto corner = [&](std::uint32_t id) { return vector_of(body.vertices()[id] - origin); };
    for (const auto& triangle : triangles_of(body))
        mesh->addTriangle(corner(triangle[0]), corner(triangle[1]), corner(triangle[2]));
    return mesh;
}

/// A world that tells which contacts its sweeps have predicted.
class PredictingWorld : public btDiscreteDynamicsWorld {
public:
    using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
    [[nodiscard]] const btAlignedObjectArray<btPersistentManifold*>& predicted() const { return m_predictiveManifolds; }
};

} // namespace

class BulletScene::World {
public:
    World(const Scene& scene, const Vector3d& centre)
        : scene_(scene), centre_(centre), dispatcher_(&configuration_),
          world_(&dispatcher_, &broad_phase_, &solver_, &configuration_),
          mesh_(mesh_of(scene.bodies().front().shape, centre)), shape_(mesh_.get()) {
        btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
        world_.setGravity({0, 0, 0});
        shape_.setMargin(collision_margin);
        shape_.updateBound();
        shape_.postUpdate();
        const double radius = scene.bodies().front().shape.body().ball_radius();
        for (std::size_t i = 0; i < scene.bodies().size(); ++i)
            add_body(int(i), radius);
        reset();
    }
    ~World() {
        for (const auto& body : bodies_)
            world_.removeRigidBody(body.get());
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    void reset() {
        found_.clear();
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const Motion& motion = scene_.bodies()[i].motion;
            const Eigen::Isometry3d start = motion.pose_at(0).isometry(), goal = motion.pose_at(1).isometry();
            const Eigen::AngleAxisd turn(Eigen::Matrix3d(goal.linear() * start.linear().transpose()));
            const Eigen::Quaterniond at(start.linear());
            const btTransform place({at.x(), at.y(), at.z(), at.w()}, vector_of(start * centre_));
            bodies_[i]->setWorldTransform(place);
            bodies_[i]->setInterpolationWorldTransform(place);
            bodies_[i]->setLinearVelocity(vector_of(goal * centre_ - start * centre_));
            bodies_[i]->setAngularVelocity(vector_of(turn.angle() * turn.axis()));
        }
    }
    void step() { world_.stepSimulation(1, 0); }

    PairSet contacts() {
        for (int i = 0; i < world_.predicted().size(); ++i)
            add(*world_.predicted()[i]);
        add_touching(); // of the start
        world_.performDiscreteCollisionDetection();
        add_touching();
        return found_;
    }

private:
    void add_body(int index, double radius) {
        const btVector3 inertia(1, 1, 1); // the same about all axes, so that the turn is even
        bodies_.push_back(std::make_unique<btRigidBody>(1, nullptr, &shape_, inertia));
        btRigidBody& body = *bodies_.back();
        body.setUserIndex(index);
        body.setActivationState(DISABLE_DEACTIVATION);
        body.setCcdMotionThreshold(swept_share * radius);
        body.setCcdSweptSphereRadius(swept_share * radius);
        world_.addRigidBody(&body);
    }
    void add(const btPersistentManifold& manifold) {
        const auto index = [](const btCollisionObject* body) { return std::size_t(body->getUserIndex()); };
        found_.insert(std::minmax(index(manifold.getBody0()), index(manifold.getBody1())));
    }
    void add_touching() {
        for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
            const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
            for (int k = 0; k < manifold.getNumContacts(); ++k)
                if (manifold.getContactPoint(k).getDistance() <= 0)
                    add(manifold);
        }
    }

    const Scene& scene_;
    Vector3d centre_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btSequentialImpulseConstraintSolver solver_;
    PredictingWorld world_;
    std::unique_ptr<btTriangleMesh> mesh_;
    btGImpactMeshShape shape_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    PairSet found_;
};

BulletScene::BulletScene(const Scene& scene, const Vector3d& centre) : world_(std::make_unique<World>(scene, centre)) {}
BulletScene::~BulletScene() = default;

void BulletScene::reset() {
    world_->reset();
}

void BulletScene::step() {
    world_->step();
}

PairSet BulletScene::contacts() {
    return world_->contacts();
}

} // namespace chasles::bench
