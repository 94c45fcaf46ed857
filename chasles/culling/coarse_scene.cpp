#include "chasles/culling/coarse_scene.h"

namespace chasles::culling {

double CoarseScene::deviation() const {
    const Bvh& mover = moving.bvh();
    const Bvh& target = fixed.bvh();
    const double bodies = mover.centre().lpNorm<1>() + mover.radius() + target.centre().lpNorm<1>() + target.radius();
    const double arm = length(motion::vector_in<double>(mover.centre()) - motion.reference) + mover.radius() + margin;
    return motion.deviation + motion.turn_deviation * arm +
           motion::coarse_rounding * (motion.size + bodies + 2 * margin);
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

} // namespace chasles::culling
