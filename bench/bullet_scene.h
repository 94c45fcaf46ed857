// A scene in Bullet's world with continuous collision detection: one step of the world over the same motions.
#pragma once

#include "bench/pair_sets.h"
#include "chasles/scene/scene.h"

#include <memory>

namespace chasles::bench {

/// Bodies of one shape that turn about one point of it while this point moves straight, as the scenes of scenes_bench.
class BulletScene {
public:
    /// Keeps the scene by reference. `centre` is the point, in the frame of the shape.
    BulletScene(const Scene& scene, const Eigen::Vector3d& centre);
    ~BulletScene();
    BulletScene(const BulletScene&) = delete;
    BulletScene& operator=(const BulletScene&) = delete;

    /// Puts all bodies to the start.
    void reset();
    /// One step of the world: a discrete test at the start, and sweeps of a ball in each body until the goal.
    void step();
    /// The pairs that touch at the start, are predicted to touch by the sweeps, or touch at the goal. After a step.
    [[nodiscard]] PairSet contacts();

private:
    class World;
    std::unique_ptr<World> world_;
};

} // namespace chasles::bench
