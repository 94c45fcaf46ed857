// Compares the ball around the path of the moving body's centre with the ball around the fixed body.
// Source: docs/derivations/07-swept-boxes.md, "Far apart".
#include "chasles/culling/far_apart.h"

#include "chasles/motion/screw_path.h"

namespace chasles::culling {

namespace {

/// The rounding allowance over the sum of all lengths. The actual rounding is at most a tenth of it.
constexpr double slack = 1e-12;

/// The 1-norm.
double size_of(const Eigen::Vector3d& v) {
    return norm1(motion::vector_in<double>(v));
}

} // namespace

bool are_far_apart(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory, double margin) {
    const Bvh& mover = moving.bvh();
    const Bvh& target = fixed.bvh();
    const motion::PathBall path = trajectory.ball_around_path(motion::vector_in<double>(mover.centre()));
    const double distance = length(path.centre - motion::vector_in<double>(target.centre()));
    const double size = size_of(mover.centre()) + size_of(target.centre()) + path.size + distance + 2 * path.radius;
    const double reach = mover.radius() + target.radius() + moving.radius() + fixed.radius();
    return distance - reach - path.radius - margin > slack * (size + moving.radius() + fixed.radius());
}

} // namespace chasles::culling
