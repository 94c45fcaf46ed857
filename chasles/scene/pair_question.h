// The question about two bodies of a scene. Source: docs/derivations/27-scenes.md, "One world".
#pragma once

#include "chasles/base/invalid_input.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/frames.h"
#include "chasles/motion/smooth_trajectory.h"
#include "chasles/query/first_contact.h"
#include "chasles/scene/scene.h"

#include <cstddef>
#include <string>
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

Mover mover(const Scene& scene, std::size_t index);

/// Throws InvalidInput "scene: NAME: WHY".
[[noreturn]] void refuse(std::string_view name, std::string_view why);
/// Refuses an index without a body.
void require_body(const Scene& scene, std::size_t index);

/// What ask(trajectory) returns for the motion as seen from the fixed body. The frames are those that the bodies hold;
/// `relative` would make them anew for each pair. Throws InvalidInput with the names of both bodies where their motion
/// is refused.
template <class Ask>
auto along(const Mover& moving, const Mover& fixed, const Ask& ask) {
    const auto& [a, frame_of_moving, moving_rests] = moving.motion;
    const auto& [b, frame_of_fixed, fixed_rests] = fixed.motion;
    try {
        if (a.trajectory().straight_ends() && b.trajectory().straight_ends())
            return ask(relative(a, b).trajectory());
        return ask(motion::ErasedTrajectory(motion::SmoothTrajectory(
            {motion::relative_frame(frame_of_moving, frame_of_fixed), frame_of_moving, frame_of_fixed})));
    } catch (const InvalidInput& error) {
        refuse(std::string(moving.name) + " and " + std::string(fixed.name), error.what());
    }
}

/// The first contact of two bodies, with options that have been checked. Contacts after `until` need not be found.
/// Throws as `along`.
FirstContact first_contact_of(const Mover& moving, const Mover& fixed, const QueryOptions& options, double until);

} // namespace chasles::scene
