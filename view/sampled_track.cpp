// An interval of time is halved until probes inside of it agree with the interpolation.
#include "view/sampled_track.h"

#include <algorithm>
#include <set>

namespace chasles::view {
namespace {

/// Parts of an interval, in the order of the test. Most motions that deviate do so in the middle. The other parts are
/// multiples of the golden ratio: no number of full turns puts a body in the interpolated pose at all of them.
constexpr double probed_parts[] = {1 / 2.,   0.618034, 0.236068, 0.854102, 0.472136, 0.090170,
                                   0.708204, 0.326238, 0.944272, 0.562306, 0.180340};
constexpr int most_halvings = 13; ///< of an interval between two exact times
constexpr int probes_of_way = 32;
constexpr double deviation_over_diagonal = 1e-3; ///< a third of a pixel where the body fills a third of a screen
constexpr double deviation_over_way = 1e-5;

using Corners = Eigen::Matrix<double, 3, 8>;

struct TimedPose {
    double time;
    Pose pose;
};

Corners corners_of(const Eigen::AlignedBox3d& box) {
    Corners corners;
    for (int i = 0; i < 8; ++i)
        corners.col(i) = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    return corners;
}

// The interpolation of the page.
Eigen::Isometry3d interpolated(const Pose& from, const Pose& to, double part) {
    const Eigen::Quaterniond start = Eigen::Quaterniond(from.rotation).normalized();
    const Eigen::Quaterniond goal = Eigen::Quaterniond(to.rotation).normalized();
    Eigen::Isometry3d pose(start.slerp(part, goal));
    pose.translation() = (1 - part) * from.translation + part * to.translation;
    return pose;
}

class Sampler {
public:
    Sampler(const Motion& motion, const Eigen::AlignedBox3d& box) : motion_(motion), corners_(corners_of(box)) {
        Eigen::AlignedBox3d way;
        for (int i = 0; i <= probes_of_way; ++i)
            way.extend(motion.pose_at(static_cast<double>(i) / probes_of_way).translation);
        tolerance_ = deviation_over_diagonal * box.diagonal().norm() + deviation_over_way * way.diagonal().norm();
    }

    [[nodiscard]] TimedPose at(double time) const { return {time, motion_.pose_at(time)}; }

    /// Adds poses after `from`, up to and including `to`.
    void add(const TimedPose& from, const TimedPose& to, int halvings, std::vector<TimedPose>& samples) const {
        if (halvings > 0 && deviates(from, to)) {
            const TimedPose middle = at((from.time + to.time) / 2);
            add(from, middle, halvings - 1, samples);
            add(middle, to, halvings - 1, samples);
        } else {
            samples.push_back(to);
        }
    }

private:
    [[nodiscard]] bool deviates(const TimedPose& from, const TimedPose& to) const {
        return turn_between(from.pose, to.pose) > largest_turn_of_step || probes_deviate(from, to);
    }
    [[nodiscard]] bool probes_deviate(const TimedPose& from, const TimedPose& to) const {
        return std::ranges::any_of(probed_parts, [&](double part) {
            const Eigen::Isometry3d there = at((1 - part) * from.time + part * to.time).pose.isometry();
            const Corners off = there * corners_ - interpolated(from.pose, to.pose, part) * corners_;
            return !(off.colwise().norm().maxCoeff() <= tolerance_);
        });
    }

    const Motion& motion_;
    Corners corners_;
    double tolerance_ = 0;
};

} // namespace

Eigen::AlignedBox3d box_around(const Polyhedron& shape) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : shape.vertices())
        box.extend(vertex);
    return box;
}

SampledTrack sampled_track(const Motion& motion, const Eigen::AlignedBox3d& box,
                           const std::vector<double>& exact_times) {
    std::set<double> stops(exact_times.begin(), exact_times.end());
    stops.insert({0, 1});
    const Sampler sampler(motion, box);
    std::vector<TimedPose> samples{sampler.at(0)};
    for (auto stop = std::next(stops.begin()); stop != stops.end(); ++stop)
        sampler.add(TimedPose(samples.back()), sampler.at(*stop), most_halvings, samples);
    std::vector<Pose> poses;
    SampledTrack track;
    for (const TimedPose& sample : samples) {
        track.times.push_back(sample.time);
        poses.push_back(sample.pose);
    }
    track.poses = pose_rows(poses);
    if (std::ranges::all_of(track.poses, [&](const PoseRow& row) { return row == track.poses.front(); }))
        return {{}, {track.poses.front()}};
    return track;
}

} // namespace chasles::view
