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

/// The frames are those that the bodies hold; `relative` would make them anew for each pair.
FirstContact first_contact_of(const Mover& moving, const Mover& fixed, const QueryOptions& options, double until) {
    const auto ask_along = [&](const motion::AnyTrajectory& trajectory) {
        return query::answer({moving.shape.body(), fixed.shape.body(), trajectory, options, until});
    };
    const Motion& a = moving.motion.motion;
    const Motion& b = fixed.motion.motion;
    if (a.trajectory().straight_ends() && b.trajectory().straight_ends())
        return ask_along(relative(a, b).trajectory());
    const motion::SharedFrame& of_moving = moving.motion.frame;
    const motion::SharedFrame& of_fixed = fixed.motion.frame;
    return ask_along(motion::ErasedTrajectory(
        motion::SmoothTrajectory({motion::relative_frame(of_moving, of_fixed), of_moving, of_fixed})));
}

} // namespace chasles::scene
