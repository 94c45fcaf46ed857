#include "chasles/culling/coarse_scene.h"

#include "chasles/culling/body_ball.h"
#include "chasles/culling/time_tree.h"

#include <algorithm>

namespace chasles::culling {

double CoarseScene::deviation() const {
    return deviation_of(motion.deviation, motion.turn_deviation);
}

double CoarseScene::start_deviation() const {
    return deviation_of(motion.start_deviation, motion.start_turn_deviation);
}

double CoarseScene::deviation_of(double reference, double turn) const {
    const Bvh& mover = moving.bvh();
    const Bvh& target = fixed.bvh();
    const double bodies = mover.centre().lpNorm<1>() + mover.radius() + target.centre().lpNorm<1>() + target.radius();
    const double arm = length(motion::vector_in<double>(mover.centre()) - motion.reference) + mover.radius() + margin;
    return reference + turn * arm + motion::coarse_rounding * (motion.size + bodies + 2 * margin);
}

Placement CoarseScene::placement(double tau) const {
    const motion::MatrixPose pose = position_at(motion.path, tau);
    const auto centre = pose.rotation * motion::vector_in<double>(moving.bvh().centre()) +
                        (pose.translation - motion::vector_in<double>(fixed.bvh().centre()));
    Placement placed;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            placed.rotation(i, j) = pose.rotation.row[i][j];
        placed.offset[i] = centre[i];
    }
    return placed;
}

CoarseBounds::CoarseBounds(const CoarseScene& scene)
    : margin_(scene.margin), deviation_(scene.deviation()),
      moving_(ball_around(scene.moving.bvh(), margin_ + deviation_)),
      fixed_(ball_around(scene.fixed.bvh(), margin_ + deviation_)), chords_(scene.motion.path, moving_, fixed_) {}

BoxSlack CoarseBounds::slack(const TimeRange& part, const Placement& start, const Placement& end) const {
    const double distance = std::max(start.offset.lpNorm<1>(), end.offset.lpNorm<1>());
    const double size = moving_.radius + fixed_.radius + distance;
    const double widening = deviation_ + float_rounding(size, margin_) + flushed_floats;
    const auto& [from, to] = part;
    return {chords_.of_moving(from, to) + widening, chords_.of_fixed(from, to) + widening, margin_};
}

} // namespace chasles::culling
