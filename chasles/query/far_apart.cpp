#include "chasles/query/far_apart.h"

#include "chasles/query/body_ball.h"

namespace chasles::query {

namespace {

using Vector = algebra::Vector3<double>;

/// Of the sizes of all that enters: a hundred roundings would take a hundredth of it.
constexpr double slack = 1e-12;

double size_of(const GivenPose& given) {
    return given.pose.translation.norm() + (given.seen_from ? given.seen_from->translation.norm() : 0);
}

} // namespace

bool are_far_apart(const Polyhedron& moving, const Polyhedron& fixed, const MotionEnds& ends) {
    const motion::Ball mover = ball_around(moving.hierarchy());
    const motion::Ball target = ball_around(fixed.hierarchy());
    const auto start = motion::in_fixed_frame<double>(ends.given_start);
    const auto goal = motion::in_fixed_frame<double>(ends.given_goal);
    const auto start_turn = motion::rotation_matrix(start.rotation);
    const auto goal_turn = motion::rotation_matrix(goal.rotation);
    const Vector centre = motion::vector_in<double>(mover.centre);
    const Vector from = start_turn * centre + start.translation;
    const Vector to = goal_turn * centre + goal.translation;
    double travel = length(to - from); // twice as far as the ball's centre gets from the middle of both
    double size = mover.centre.norm() + target.centre.norm() + mover.radius + target.radius +
                  size_of(ends.given_start) + size_of(ends.given_goal);
    if (ends.swept_centre) {
        const Vector arm = motion::vector_in<double>(mover.centre - *ends.swept_centre);
        const Vector turned = goal_turn * arm - start_turn * arm;
        travel = length(to - from - turned) + length(turned);
        size += 2 * ends.swept_centre->norm();
    }
    const double away = length(scale(from + to, 0.5) - motion::vector_in<double>(target.centre));
    return away - mover.radius - target.radius - travel / 2 > slack * size;
}

} // namespace chasles::query
