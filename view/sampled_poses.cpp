// A query cuts a long screw into pieces. The poses follow these pieces, whose slide differs from the uncut screw's.
#include "view/sampled_poses.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {
namespace {

constexpr std::size_t fewest_poses = 241;
constexpr std::size_t most_poses = 3841; ///< too few only for a screw of nearly half a turn in one piece

/// Relative to the extent of the trajectory: less than half a pixel if the trajectory fills a screen.
constexpr double largest_deviation = 1e-4;

/// The pose of the moving body in the world, along the pieces of the cut motion.
class CutMotion {
public:
    CutMotion(const Motion& motion, double max_turn) : motion_(motion) {
        if (const auto* const screw = std::get_if<ScrewMotion>(&motion))
            pieces_ = screw->cut(max_turn);
    }

    [[nodiscard]] Pose pose_at(double time) const {
        if (pieces_.size() < 2)
            return std::visit([&](const auto& any) { return any.pose_at(time); }, motion_);
        const double place = time * static_cast<double>(pieces_.size());
        const std::size_t index = std::min(static_cast<std::size_t>(place), pieces_.size() - 1);
        return pieces_[index].pose_at(place - static_cast<double>(index));
    }

private:
    const Motion& motion_;
    std::vector<ScrewMotion> pieces_;
};

std::vector<Pose> poses_at_equal_times(const CutMotion& motion, std::size_t count) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < count; ++i)
        poses.push_back(motion.pose_at(static_cast<double>(i) / static_cast<double>(count - 1)));
    return poses;
}

// The largest distance of an odd pose from the middle of its two neighbours, relative to the extent of the trajectory.
// Rotations need no test: at most half a turn in 240 equal steps is interpolated to an accuracy of 1e-6.
double deviation(const std::vector<Pose>& poses) {
    Eigen::AlignedBox3d box;
    double largest = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        box.extend(poses[i].translation);
        if (i % 2 == 1) {
            const Eigen::Vector3d middle = (poses[i - 1].translation + poses[i + 1].translation) / 2;
            largest = std::max(largest, (poses[i].translation - middle).norm());
        }
    }
    const double extent = box.diagonal().norm();
    return extent > 0 ? largest / extent : 0;
}

std::vector<PoseRow> rows_of(const std::vector<Pose>& poses) {
    std::vector<PoseRow> rows;
    Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
    for (const Pose& pose : poses) {
        Eigen::Quaterniond rotation = Eigen::Quaterniond(pose.rotation).normalized();
        if (rotation.dot(before) < 0)
            rotation.coeffs() = -rotation.coeffs();
        const Eigen::Vector3d& at = pose.translation;
        rows.push_back({at.x(), at.y(), at.z(), rotation.w(), rotation.x(), rotation.y(), rotation.z()});
        before = rotation;
    }
    return rows;
}

std::vector<Pose> fixed_poses(const MotionEnds& ends, std::size_t count) {
    if (!ends.fixed)
        return {Pose()};
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < count; ++i)
        poses.push_back(ends.fixed_pose_at(static_cast<double>(i) / static_cast<double>(count - 1)));
    return poses;
}

} // namespace

SampledPoses sampled_poses(const Motion& motion, double max_turn) {
    const CutMotion cut(motion, max_turn);
    std::vector<Pose> poses = poses_at_equal_times(cut, fewest_poses);
    while (deviation(poses) > largest_deviation && poses.size() < most_poses)
        poses = poses_at_equal_times(cut, 2 * poses.size() - 1);
    const MotionEnds& ends = std::visit([](const auto& any) -> const MotionEnds& { return any.ends(); }, motion);
    return {rows_of(poses), rows_of(fixed_poses(ends, poses.size()))};
}

} // namespace chasles::view
