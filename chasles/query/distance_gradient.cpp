#include "chasles/query/distance_gradient.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/turn_about.h"
#include "chasles/query/agreement.h"
#include "chasles/query/witnesses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace chasles {

namespace {

using motion::AnyTrajectory;
using query::Witness;
using Vector = DistanceGradient::Vector;

/// The turn of the moving body as seen from the fixed one is within 1e-3 radians of a half turn, beyond which the
/// shorter way round is another one.
bool is_near_half_turn(const AnyTrajectory& trajectory) {
    constexpr double least_cosine = 5e-4; // of half the turn
    const auto seen_at = [&](double time) {
        return Eigen::Quaterniond(trajectory.fixed_pose_at(time).rotation).normalized().conjugate() *
               Eigen::Quaterniond(trajectory.pose_at(time).rotation).normalized();
    };
    return std::abs(seen_at(0).dot(seen_at(1))) < least_cosine;
}

/// Moves the goal of a motion, and follows a point of the body at one time. The time stays, and so do the points: that
/// they wander changes their distance in second order only.
class GoalSteps {
public:
    explicit GoalSteps(const AnyTrajectory& trajectory) : trajectory_(trajectory), goal_(trajectory.pose_at(1)) {}

    [[nodiscard]] Vector gradient_of(const Witness& witness) const {
        Vector gradient;
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
            gradient[i] = rate(witness, translation_step(),
                               [&](double step) { return Pose(goal_.translation + step * axis, goal_.rotation); });
            gradient[3 + i] = rate(witness, turn_step, [&](double step) {
                return Pose(goal_.translation, turn_about(axis, step) * goal_.rotation);
            });
        }
        return gradient;
    }

private:
    static constexpr double turn_step = 0x1p-17;

    /// Places depend on it linearly, so that a long step has the least rounding.
    [[nodiscard]] double translation_step() const {
        const double size = goal_.translation.norm() + trajectory_.pose_at(0).translation.norm();
        return size > 0 ? std::ldexp(1.0, std::ilogb(size) - 9) : 1;
    }

    template <class Goal>
    [[nodiscard]] double rate(const Witness& witness, double step, const Goal& goal) const {
        const auto place = [&](double signed_step) -> Eigen::Vector3d {
            return trajectory_.with_goal(goal(signed_step))->pose_at(witness.time).isometry() * witness.on_moving;
        };
        return witness.normal.dot(place(step) - place(-step)) / (2 * step);
    }

    const AnyTrajectory& trajectory_;
    Pose goal_;
};

} // namespace

DistanceGradient least_distance_gradient(const LeastDistanceQuery& query, const LeastDistance& answer) {
    const AnyTrajectory& trajectory = query.motion.trajectory();
    const motion::SharedTrajectory same = trajectory.with_goal(trajectory.pose_at(1));
    if (!same)
        throw InvalidInput("gradient: the motion has no goal pose to change; screws, sweeps, constant velocities and "
                           "constant twists between two poses have one");
    DistanceGradient result;
    if (!(answer.distance.upper > 0))
        return result;
    const query::Witnesses witnesses =
        query::witnesses_of({query.moving.body(), query.fixed.body(), trajectory}, answer.time.lower);
    const GoalSteps steps(trajectory);
    query::Agreement gradients(witnesses.all.front().on_moving.norm());
    for (const Witness& witness : witnesses.all)
        if (!gradients.add(steps.gradient_of(witness)))
            break;
    result.by_goal = gradients.first();
    result.isolated = witnesses.are_all && gradients.is_one() && !is_near_half_turn(*same);
    return result;
}

} // namespace chasles
