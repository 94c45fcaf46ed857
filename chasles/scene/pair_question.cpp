#include "chasles/scene/pair_question.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/frames.h"
#include "chasles/motion/smooth_trajectory.h"
#include "chasles/query/pair_query.h"
#include "chasles/scene/swept_body.h"

#include <string>

namespace chasles::scene {

void refuse(std::string_view name, std::string_view why) {
    throw InvalidInput("scene: " + std::string(name) + ": " + std::string(why));
}

void require_body(const Scene& scene, std::size_t index) {
    const std::size_t count = scene.bodies().size();
    if (index >= count)
        refuse("body " + std::to_string(index), "there are " + std::to_string(count) + " bodies");
}

WorldMotion world_motion(const Motion& motion, std::string_view name) {
    motion::SharedFrame frame = motion.trajectory().frame();
    if (!frame)
        refuse(name, "motion: takes no paper's screw and no sweep, which are motions as seen from another body "
                     "(constant twist and constant velocity are the ones in the world), and no relative motion");
    const bool rests = is_at_rest(*frame);
    return {motion, std::move(frame), rests};
}

WorldMotion rest_of(const WorldMotion& motion, double from) {
    if (motion.rests || from == 0)
        return motion;
    Motion rest = chasles::rest_of(motion.motion, from);
    motion::SharedFrame frame = rest.trajectory().frame();
    return {std::move(rest), std::move(frame), false};
}

namespace {

/// Calls ask(trajectory) for the motion as seen from the fixed body. The frames are those that the bodies hold;
/// `relative` would make them anew for each pair.
template <class Ask>
auto ask_along(const Mover& moving, const Mover& fixed, const Ask& ask) {
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

} // namespace

FirstContact first_contact_of(const Mover& moving, const Mover& fixed, const QueryOptions& options, double until) {
    return ask_along(moving, fixed, [&](const motion::AnyTrajectory& trajectory) {
        return query::answer({moving.shape.body(), fixed.shape.body(), trajectory, options, until});
    });
}

LeastDistance least_distance_of(const Mover& moving, const Mover& fixed, const LeastDistanceOptions& options) {
    return ask_along(moving, fixed, [&](const motion::AnyTrajectory& trajectory) {
        return query::answer(query::LeastPairQuery{moving.shape.body(), fixed.shape.body(), trajectory, options});
    });
}

} // namespace chasles::scene
