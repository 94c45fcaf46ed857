// Poses of a motion follow the pieces of a long screw, whose slide differs from the uncut screw's.
#include "view/sampled_poses.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {
namespace {

constexpr std::size_t fewest_poses = 241;
constexpr std::size_t most_poses = 3841; ///< too few only for a screw of nearly half a turn in one piece

/// Relative to the extent of the longer trajectory: less than half a pixel if this trajectory fills a screen.
constexpr double largest_deviation = 1e-4;

template <class PoseAt>
std::vector<Pose> poses_at_equal_times(std::size_t count, PoseAt pose_at) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < count; ++i)
        poses.push_back(pose_at(static_cast<double>(i) / static_cast<double>(count - 1)));
    return poses;
}

// The largest distance of an odd pose from the middle of its two neighbours. Rotations need no test: at most half a
// turn in 240 equal steps is interpolated to an accuracy of 1e-6.
double deviation(const std::vector<Pose>& poses) {
    double largest = 0;
    for (std::size_t i = 1; i + 1 < poses.size(); i += 2) {
        const Eigen::Vector3d middle = (poses[i - 1].translation + poses[i + 1].translation) / 2;
        largest = std::max(largest, (poses[i].translation - middle).norm());
    }
    return largest;
}

double extent(const std::vector<Pose>& poses) {
    Eigen::AlignedBox3d box;
    for (const Pose& pose : poses)
        box.extend(pose.translation);
    return box.diagonal().norm();
}

// A body that rests up to rounding errors needs no more poses, therefore the longer way counts.
bool are_dense(const std::vector<Pose>& moving, const std::vector<Pose>& fixed) {
    return std::max(deviation(moving), deviation(fixed)) <= largest_deviation * std::max(extent(moving), extent(fixed));
}

bool are_same(const Pose& a, const Pose& b) {
    return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

} // namespace

std::vector<PoseRow> pose_rows(const std::vector<Pose>& poses) {
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

SampledPoses sampled_poses(const Motion& motion) {
    std::vector<Pose> moving, fixed;
    const auto sample = [&](std::size_t count) {
        moving = poses_at_equal_times(count, [&](double time) { return motion.pose_at(time); });
        fixed = poses_at_equal_times(count, [&](double time) { return motion.fixed_pose_at(time); });
    };
    sample(fewest_poses);
    while (!are_dense(moving, fixed) && moving.size() < most_poses)
        sample(2 * moving.size() - 1);
    if (std::ranges::all_of(fixed, [&](const Pose& pose) { return are_same(pose, fixed.front()); }))
        fixed.resize(1);
    return {pose_rows(moving), pose_rows(fixed)};
}

} // namespace chasles::view
