// The question about two bodies of a scene. Source: docs/derivations/27-scenes.md, "One world".
#pragma once

#include "chasles/motion/moving_frame.h"
#include "chasles/query/least_distance.h"
#include "chasles/scene/scene.h"

#include <cstddef>
#include <string_view>

namespace chasles::scene {

/// A body with its motion in the world, whose frame is made once.
struct WorldMotion {
    Motion motion;
    motion::SharedFrame frame;
    bool rests = false; ///< the frame never moves
};

/// Throws InvalidInput with the name of the body for a motion that has no pose in the world.
WorldMotion world_motion(const Motion& motion, std::string_view name);

/// The rest of a motion from a time in [0, 1) on.
WorldMotion rest_of(const WorldMotion& motion, double from);

struct Mover {
    std::string_view name;
    const Polyhedron& shape;
    const WorldMotion& motion;
};

/// The first contact of two bodies, with options that have been checked. Contacts after `until` need not be found.
/// Throws InvalidInput with the names of both bodies where their motion is refused.
FirstContact first_contact_of(const Mover& moving, const Mover& fixed, const QueryOptions& options, double until);
/// The least distance of two bodies, with options that have been checked.
LeastDistance least_distance_of(const Mover& moving, const Mover& fixed, const LeastDistanceOptions& options);

/// Throws InvalidInput "scene: NAME: WHY".
[[noreturn]] void refuse(std::string_view name, std::string_view why);
/// Refuses an index without a body.
void require_body(const Scene& scene, std::size_t index);

} // namespace chasles::scene
