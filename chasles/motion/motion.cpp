// The public motions: handles of trajectories.
#include "chasles/motion/motion.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/even_trajectory.h"
#include "chasles/motion/frames.h"
#include "chasles/motion/screw_trajectory.h"
#include "chasles/motion/sweep_trajectory.h"

namespace chasles {

namespace {

using motion::EvenTrajectory;
using motion::MotionEnds;
using motion::ScrewTrajectory;
using motion::SweepTrajectory;

template <class Trajectory>
Motion erased(Trajectory trajectory) {
    return Motion(std::make_shared<const motion::ErasedTrajectory<Trajectory>>(std::move(trajectory)));
}

template <class Trajectory>
const Trajectory& typed(const Motion& motion) {
    return static_cast<const motion::ErasedTrajectory<Trajectory>&>(motion.trajectory()).get();
}

} // namespace

Motion Motion::screw(const Pose& start, const Pose& goal, double max_turn) {
    return ScrewMotion::between(start, goal, max_turn);
}

Motion Motion::sweep(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre) {
    return SweepMotion::between(start, goal, centre);
}

Pose Motion::pose_at(double time) const {
    return trajectory_->pose_at(time);
}

Pose Motion::fixed_pose_at(double time) const {
    return trajectory_->fixed_pose_at(time);
}

Motion Motion::reversed() const {
    motion::SharedTrajectory back = trajectory_->reversed();
    if (!back)
        throw InvalidInput("motion: reversed: takes no screw, which slides unevenly, so that the way back is another "
                           "motion; the constant twist between the same poses has one");
    return Motion(std::move(back));
}

ScrewMotion ScrewMotion::between(const Pose& start, const Pose& goal, double max_turn) {
    return ScrewMotion(erased(ScrewTrajectory(MotionEnds::between(start, goal), max_turn)));
}

ScrewMotion ScrewMotion::relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                  const Pose& fixed_goal, double max_turn) {
    const MotionEnds ends = MotionEnds::relative(moving_start, moving_goal, fixed_start, fixed_goal);
    return ScrewMotion(erased(ScrewTrajectory(ends, max_turn)));
}

const motion::ScrewTrajectory& ScrewMotion::trajectory() const {
    return typed<ScrewTrajectory>(motion_);
}

double ScrewMotion::angle() const {
    return trajectory().clock().angle();
}

double ScrewMotion::slide() const {
    return trajectory().numbers().slide;
}

Eigen::Vector3d ScrewMotion::axis_direction() const {
    return trajectory().numbers().axis_direction;
}

Eigen::Vector3d ScrewMotion::axis_point() const {
    return trajectory().numbers().axis_point;
}

double ScrewMotion::max_turn() const {
    return trajectory().max_turn();
}

ScrewMotion ScrewMotion::with_max_turn(double max_turn) const {
    return ScrewMotion(erased(ScrewTrajectory(trajectory().ends(), max_turn)));
}

double ScrewMotion::tau_at(double time) const {
    return trajectory().clock().tau_at(time);
}

double ScrewMotion::time_at(double tau) const {
    return trajectory().clock().time_at(tau);
}

double ScrewMotion::tau_rate(double tau) const {
    return trajectory().clock().tau_rate(tau);
}

Pose ScrewMotion::pose_at(double time) const {
    return trajectory().uncut_pose_at(time);
}

std::vector<ScrewMotion> ScrewMotion::pieces() const {
    const motion::ScrewPieces all = trajectory().pieces();
    std::vector<ScrewMotion> pieces;
    for (std::size_t i = 0; i < all.size(); ++i)
        pieces.push_back(ScrewMotion(erased(ScrewTrajectory(all[i].ends(), max_turn()))));
    return pieces;
}

std::size_t ScrewMotion::piece_count() const {
    return trajectory().clock().piece_count(max_turn());
}

SweepMotion SweepMotion::between(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre) {
    return SweepMotion(erased(SweepTrajectory(MotionEnds::between(start, goal), centre)));
}

SweepMotion SweepMotion::relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                  const Pose& fixed_goal) {
    const MotionEnds ends = MotionEnds::relative(moving_start, moving_goal, fixed_start, fixed_goal);
    return SweepMotion(erased(SweepTrajectory(ends, Eigen::Vector3d::Zero())));
}

SweepMotion SweepMotion::reversed() const {
    return SweepMotion(Motion(trajectory().reversed()));
}

SweepMotion SweepMotion::about(const Eigen::Vector3d& centre) const {
    return SweepMotion(erased(SweepTrajectory(trajectory().ends(), centre)));
}

const motion::SweepTrajectory& SweepMotion::trajectory() const {
    return typed<SweepTrajectory>(motion_);
}

ScrewMotion SweepMotion::screw_of_same_poses() const {
    return ScrewMotion(erased(ScrewTrajectory(trajectory().ends(), ScrewMotion::default_max_turn)));
}

double SweepMotion::angle() const {
    const motion::RelativeEnds ends(trajectory().ends());
    return motion::turn_angle(ends.start, ends.goal).angle;
}

Eigen::Vector3d SweepMotion::displacement() const {
    return motion::rounded(trajectory().piece().cubic().displacement);
}

Pose SweepMotion::pose_at(double time) const {
    return trajectory().pose_at(time);
}

namespace {

/// A sweep that does not turn, which is also an even motion, or a body at rest, which has no kind.
class StraightTrajectory : public SweepTrajectory {
public:
    StraightTrajectory(const MotionEnds& ends, const Eigen::Vector3d& centre,
                       std::optional<EvenTrajectory::Kind> kind = {})
        : SweepTrajectory(ends, centre), kind_(kind) {}
    [[nodiscard]] motion::SharedFrame frame() const {
        return ends().start.translation == ends().goal.translation
                   ? motion::frame_at_rest(ends().start)
                   : motion::velocity_frame(ends().start, ends().goal, centre());
    }
    [[nodiscard]] const MotionEnds* straight_ends() const { return &ends(); }
    /// To a goal that is turned it is no sweep.
    [[nodiscard]] motion::SharedTrajectory with_goal(const Pose& goal_in_world) const {
        return kind_ ? EvenTrajectory(*kind_, ends(), centre()).with_goal(goal_in_world) : nullptr;
    }
    [[nodiscard]] motion::SharedTrajectory reversed() const {
        return std::make_shared<const motion::ErasedTrajectory<StraightTrajectory>>(
            StraightTrajectory(ends().reversed(), centre(), kind_));
    }

private:
    std::optional<EvenTrajectory::Kind> kind_;
};

/// Without a turn it is a sweep, which is exact. Only a quick test tells, as most motions turn.
Motion even_motion(EvenTrajectory::Kind kind, const MotionEnds& ends, const Eigen::Vector3d& centre) {
    const EvenTrajectory trajectory(kind, ends, centre);
    const auto turn = turn_between(motion::pose_in<double>(ends.start), motion::pose_in<double>(ends.goal));
    const bool may_not_turn = norm1(turn.v) <= 0x1p-40 * turn.w;
    if (may_not_turn && !(0 < double(motion::EvenFrame::turn_between(ends.start, ends.goal).angle)))
        return erased(StraightTrajectory(ends, centre, kind));
    return erased(trajectory);
}

} // namespace

Motion Motion::at_rest(const Pose& pose) {
    return erased(StraightTrajectory(MotionEnds::between(pose, pose), Eigen::Vector3d::Zero()));
}

ConstantVelocity ConstantVelocity::between(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre) {
    return {even_motion(EvenTrajectory::Kind::velocity, MotionEnds::between(start, goal), centre), centre};
}

double ConstantVelocity::angle() const {
    return motion::turn_angle(motion::exact(pose_at(0)), motion::exact(pose_at(1))).angle;
}

Eigen::Vector3d ConstantVelocity::displacement() const {
    return pose_at(1).isometry() * centre_ - pose_at(0).isometry() * centre_;
}

ConstantTwist ConstantTwist::between(const Pose& start, const Pose& goal) {
    return ConstantTwist(
        even_motion(EvenTrajectory::Kind::twist, MotionEnds::between(start, goal), Eigen::Vector3d::Zero()));
}

ScrewMotion ConstantTwist::screw_of_same_poses() const {
    return ScrewMotion::between(pose_at(0), pose_at(1));
}

std::vector<Motion> screws_along(std::span<const Pose> poses, double max_turn) {
    if (poses.size() < 2)
        throw InvalidInput("path: poses: at least two are needed");
    std::vector<Motion> motions;
    motions.reserve(poses.size() - 1);
    for (std::size_t i = 0; i + 1 < poses.size(); ++i)
        motions.push_back(ScrewMotion::between(poses[i], poses[i + 1], max_turn));
    return motions;
}

} // namespace chasles
