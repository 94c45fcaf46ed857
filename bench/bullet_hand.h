// A body in a hand by Bullet: a rigid body of its world, tied to a kinematic body that is where the hand is.
// Choices: docs/decisions/0079-peers-of-dragged-bodies.md.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/pose.h"

#include <memory>

namespace chasles::bench {

/// What ties the body to the hand.
enum class BulletTie : std::uint8_t {
    spring, ///< springs of all six degrees of freedom, critically damped
    fixed   ///< all six degrees of freedom are locked
};

struct BulletHandOptions {
    double rate = 240; ///< steps in a second
    BulletTie tie = BulletTie::spring;
    bool is_convex = false; ///< the dragged body: its hull is used, else its triangles (GImpact)
};

class BulletHand {
public:
    BulletHand(const Polyhedron& moving, const Polyhedron& fixed, const Pose& start, const BulletHandOptions& options);
    ~BulletHand();
    BulletHand(const BulletHand&) = delete;
    BulletHand& operator=(const BulletHand&) = delete;

    /// One step of the world with the hand at a pose.
    void step(const Pose& goal);
    [[nodiscard]] Pose pose() const;

private:
    class World;
    std::unique_ptr<World> world_;
};

} // namespace chasles::bench
