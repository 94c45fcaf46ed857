#include "chasles/query/far_apart.h"

#include "chasles/query/body_ball.h"

#include <cmath>

namespace chasles::query {

namespace {

using Vector = algebra::Vector3<double>;
using Rotation = algebra::Matrix3<double>;

/// Of the sizes of all that enters: a hundred roundings would take a hundredth of it.
constexpr double slack = 1e-12;

Vector vector(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

double length(const Vector& v) {
    return std::sqrt(dot(v, v));
}

/// A pose in the frame of the fixed body.
struct Placing {
    Rotation rotation;
    Vector translation;
    double size; ///< of what it is made from

    explicit Placing(const Pose& pose)
        : rotation(motion::rotation_matrix<double>(
              {pose.rotation.w(), {pose.rotation.x(), pose.rotation.y(), pose.rotation.z()}})),
          translation(vector(pose.translation)), size(length(translation)) {}

    static Placing of(const GivenPose& given) {
        Placing placing(given.pose);
        if (!given.seen_from)
            return placing;
        const Placing frame(*given.seen_from);
        const Rotation back = frame.rotation.transposed();
        placing.rotation = back * placing.rotation;
        placing.translation = back * (placing.translation - frame.translation);
        placing.size += frame.size;
        return placing;
    }
};

} // namespace

bool are_far_apart(const Polyhedron& moving, const Polyhedron& fixed, const MotionEnds& ends) {
    const motion::Ball mover = ball_around(moving.hierarchy());
    const motion::Ball target = ball_around(fixed.hierarchy());
    const Placing start = Placing::of(ends.given_start);
    const Placing goal = Placing::of(ends.given_goal);
    const Vector centre = vector(mover.centre);
    const Vector from = start.rotation * centre + start.translation;
    const Vector to = goal.rotation * centre + goal.translation;
    double travel = length(to - from); // twice as far as the ball's centre gets from the middle of both
    double size = length(centre) + target.centre.norm() + mover.radius + target.radius + start.size + goal.size;
    if (ends.swept_centre) {
        const Vector arm = vector(mover.centre - *ends.swept_centre);
        const Vector turned = goal.rotation * arm - start.rotation * arm;
        travel = length(to - from - turned) + length(turned);
        size += 2 * ends.swept_centre->norm();
    }
    const double away = length(scale(from + to, 0.5) - vector(target.centre));
    return away - mover.radius - target.radius - travel / 2 > slack * size;
}

} // namespace chasles::query
