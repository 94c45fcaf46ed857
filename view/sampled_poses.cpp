// Poses of a motion follow the pieces of a long screw, whose slide differs from the uncut screw's.
#include "view/sampled_poses.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {
namespace {

constexpr std::size_t fewest_poses = 241;
constexpr std::size_t most_poses = 3841; ///< too few only for a screw of nearly half a turn in one piece
constexpr double probed_part = 0.381966; ///< of a step: no number of full turns in one step ends here where it began
constexpr double largest_turn_deviation = 2e-3; ///< radians

/// Relative to the extent of the longer trajectory: less than half a pixel if this trajectory fills a screen.
constexpr double largest_deviation = 1e-4;

template <class PoseAt>
std::vector<Pose> poses_at_equal_times(std::size_t count, PoseAt pose_at) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < count; ++i)
        poses.push_back(pose_at(static_cast<double>(i) / static_cast<double>(count - 1)));
    return poses;
}

Eigen::Quaterniond rotation_of(const Pose& pose) {
    return Eigen::Quaterniond(pose.rotation).normalized();
}

// Whether every step is a short turn, and a probe inside of it is where the interpolation puts it.
template <class PoseAt>
bool turns_are_dense(const std::vector<Pose>& poses, PoseAt pose_at) {
    const double step = 1 / static_cast<double>(poses.size() - 1);
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
        const Eigen::Quaterniond from = rotation_of(poses[i]), to = rotation_of(poses[i + 1]);
        const Eigen::Quaterniond probe = rotation_of(pose_at((static_cast<double>(i) + probed_part) * step));
        if (from.angularDistance(to) > largest_turn_of_step ||
            from.slerp(probed_part, to).angularDistance(probe) > largest_turn_deviation)
            return false;
    }
    return true;
}

// The largest distance of an odd pose from the middle of its two neighbours.
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

double turn_between(const Pose& a, const Pose& b) {
    return rotation_of(a).angularDistance(rotation_of(b));
}

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
    const auto pose_at = [&](double time) { return motion.pose_at(time); };
    const auto fixed_pose_at = [&](double time) { return motion.fixed_pose_at(time); };
    std::vector<Pose> moving, fixed;
    std::size_t count = fewest_poses;
    while (true) {
        moving = poses_at_equal_times(count, pose_at);
        fixed = poses_at_equal_times(count, fixed_pose_at);
        if (count >= most_poses ||
            (are_dense(moving, fixed) && turns_are_dense(moving, pose_at) && turns_are_dense(fixed, fixed_pose_at)))
            break;
        count = 2 * count - 1;
    }
    if (std::ranges::all_of(fixed, [&](const Pose& pose) { return are_same(pose, fixed.front()); }))
        fixed.resize(1);
    return {pose_rows(moving), pose_rows(fixed)};
}

} // namespace chasles::view
