// Bounds the distance of both balls from below by the distance of their centres half way and the travel of the centre.
// Source: docs/derivations/07-swept-boxes.md, "Far apart".
#include "chasles/culling/far_apart.h"

namespace chasles::culling {

namespace {

using Vector = algebra::Vector3<double>;

/// The rounding allowance over the sum of all lengths. The actual rounding is at most a tenth of it.
constexpr double slack = 1e-12;

/// The 1-norm.
double size_of(const Eigen::Vector3d& v) {
    return norm1(motion::vector_in<double>(v));
}

/// A point of the moving body in the fixed body's frame.
[[gnu::always_inline]] inline Vector position(const GivenPose& given, const Vector& point) {
    const auto pose = motion::pose_in<double>(given.pose);
    const Vector in_world = rotated(pose.rotation, point) + pose.translation;
    if (!given.seen_from)
        return in_world;
    const auto frame = motion::pose_in<double>(*given.seen_from);
    return rotated(frame.rotation.conjugate(), in_world - frame.translation);
}

} // namespace

bool are_far_apart(const Body& moving, const Body& fixed, const MotionEnds& ends, double margin) {
    const Bvh& mover = moving.bvh();
    const Bvh& target = fixed.bvh();
    const Vector centre = motion::vector_in<double>(mover.centre());
    const Vector from = position(ends.given_start, centre);
    const Vector to = position(ends.given_goal, centre);
    double travel =
        length(to - from); // twice the greatest distance of the ball's centre from the mean of `from` and `to`
    double size = size_of(mover.centre()) + size_of(target.centre());
    // A sweep moves its centre on a straight line and rotates the rest about the centre.
    if (ends.swept_centre) {
        const Vector reference = motion::vector_in<double>(*ends.swept_centre);
        const Vector straight = position(ends.given_goal, reference) - position(ends.given_start, reference);
        travel = length(straight) + length(to - from - straight);
        size += size_of(*ends.swept_centre);
    }
    if (ends.fixed)
        size += size_of(ends.fixed->start.translation) + size_of(ends.fixed->goal.translation);
    // The centre of the moving ball stays within travel / 2 of the mean of its end positions.
    const double distance = length(scale(from + to, 0.5) - motion::vector_in<double>(target.centre()));
    size += distance + travel;
    return distance - (mover.radius() + target.radius()) - travel / 2 - margin > slack * size;
}

} // namespace chasles::culling
