#include "chasles/scene/pair_question.h"

#include "chasles/base/invalid_input.h"
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

Mover mover(const Scene& scene, std::size_t index) {
    const SceneBody& body = scene.bodies()[index];
    return {body.name, body.shape, scene.motion_of(index)};
}

FirstContact first_contact_of(const Mover& moving, const Mover& fixed, const QueryOptions& options, double until) {
    return along(moving, fixed, [&](const motion::AnyTrajectory& trajectory) {
        return query::answer({moving.shape.body(), fixed.shape.body(), trajectory, options, until});
    });
}

} // namespace chasles::scene
