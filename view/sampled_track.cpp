// An interval of time is divided until probes inside of it agree with the interpolation: at cuts, then in halves.
#include "view/sampled_track.h"

#include "chasles/motion/any_trajectory.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <span>

namespace chasles::view {
namespace {

/// Parts of an interval that are probed after its middle, where most motions deviate. They are multiples of the golden
/// ratio: no number of full turns puts a body in the interpolated pose at all of them.
constexpr std::array other_probed_parts = {0.618034, 0.236068, 0.854102, 0.472136, 0.090170,
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

struct PosesAtTime {
    double time = 0;
    std::vector<Pose> poses = {};
};

using Indices = std::vector<std::size_t>; ///< of bodies

class Sampler {
public:
    Sampler(const PosedBodies& bodies, double begin, double end)
        : bodies_(bodies), other_parts_(std::span(other_probed_parts).first(bodies.are_smooth_between_stops ? 2 : 10)),
          samples_(bodies.boxes.size()) {
        std::vector<Eigen::AlignedBox3d> ways(bodies.boxes.size());
        for (int i = 0; i <= probes_of_way; ++i) {
            const PosesAtTime there = at(std::lerp(begin, end, static_cast<double>(i) / probes_of_way));
            for (std::size_t body = 0; body < ways.size(); ++body)
                ways[body].extend(there.poses[body].translation);
        }
        for (std::size_t body = 0; body < ways.size(); ++body) {
            corners_.push_back(corners_of(bodies.boxes[body]));
            tolerances_.push_back(deviation_over_diagonal * bodies.boxes[body].diagonal().norm() +
                                  deviation_over_way * ways[body].diagonal().norm());
        }
    }

    [[nodiscard]] PosesAtTime at(double time) const { return {time, bodies_.poses_at(time)}; }

    /// Adds poses after `from`, up to and including `to`. Only bodies that deviate get poses between them.
    void add(const PosesAtTime& from, const PosesAtTime& to, int halvings, const Indices& bodies) {
        const std::span<const double> cuts = cuts_between(from.time, to.time);
        const double division = cuts.empty() ? std::midpoint(from.time, to.time) : cuts[cuts.size() / 2];
        Indices deviating;
        PosesAtTime middle;
        if (halvings > 0 && from.time < division && division < to.time) {
            middle = at(division);
            deviating = deviating_between(from, middle, to, bodies);
        }
        for (const std::size_t body : bodies)
            if (!std::ranges::binary_search(deviating, body))
                samples_[body].push_back({to.time, to.poses[body]});
        if (deviating.empty())
            return;
        const int left = cuts.empty() ? halvings - 1 : halvings;
        add(from, middle, left, deviating);
        add(middle, to, left, deviating);
    }

    /// All samples of each body.
    [[nodiscard]] const std::vector<std::vector<TimedPose>>& samples() const { return samples_; }

private:
    [[nodiscard]] std::span<const double> cuts_between(double from, double to) const {
        const auto first = std::ranges::upper_bound(bodies_.cuts, from);
        return {first, std::max(first, std::ranges::lower_bound(bodies_.cuts, to))};
    }

    /// In ascending order.
    [[nodiscard]] Indices deviating_between(const PosesAtTime& from, const PosesAtTime& middle, const PosesAtTime& to,
                                            Indices bodies) const {
        Indices deviating;
        const auto take = [&](const auto& deviates) {
            const auto taken = std::ranges::partition(bodies, [&](std::size_t body) { return !deviates(body); });
            deviating.insert(deviating.end(), taken.begin(), taken.end());
            bodies.erase(taken.begin(), bodies.end());
        };
        const auto probe = [&](const PosesAtTime& there) {
            const double part = (there.time - from.time) / (to.time - from.time);
            take([&](std::size_t body) {
                const Eigen::Isometry3d shown = interpolated(from.poses[body], to.poses[body], part);
                const Corners off = there.poses[body].isometry() * corners_[body] - shown * corners_[body];
                return !(off.colwise().norm().maxCoeff() <= tolerances_[body]);
            });
        };
        take([&](std::size_t body) { return turn_between(from.poses[body], to.poses[body]) > largest_turn_of_step; });
        probe(middle);
        const auto probe_at = [&](double time) {
            if (!bodies.empty())
                probe(at(time));
        };
        for (const double part : other_parts_)
            probe_at(std::lerp(from.time, to.time, part));
        double before = from.time; // a short stroke between two cuts lies between all other probes
        for (const double cut : cuts_between(from.time, to.time)) {
            probe_at(std::midpoint(before, cut));
            probe_at(cut);
            before = cut;
        }
        if (before > from.time)
            probe_at(std::midpoint(before, to.time));
        std::ranges::sort(deviating);
        return deviating;
    }

    const PosedBodies& bodies_;
    std::span<const double> other_parts_;
    std::vector<Corners> corners_;
    std::vector<double> tolerances_;
    std::vector<std::vector<TimedPose>> samples_;
};

/// Between equal poses a page needs no others.
SampledTrack track_of(const std::vector<TimedPose>& samples) {
    std::vector<Pose> poses;
    for (const TimedPose& sample : samples)
        poses.push_back(sample.pose);
    const std::vector<PoseRow> rows = pose_rows(poses);
    if (std::ranges::all_of(rows, [&](const PoseRow& row) { return row == rows.front(); }))
        return {{}, {rows.front()}};
    SampledTrack track;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (i == 0 || i + 1 == rows.size() || rows[i] != rows[i - 1] || rows[i] != rows[i + 1]) {
            track.times.push_back(samples[i].time);
            track.poses.push_back(rows[i]);
        }
    return track;
}

} // namespace

Eigen::AlignedBox3d box_around(const Polyhedron& shape) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : shape.vertices())
        box.extend(vertex);
    return box;
}

std::vector<SampledTrack> sampled_tracks(const PosedBodies& bodies, const std::vector<double>& stops,
                                         const std::function<void(std::size_t)>& progress) {
    Sampler sampler(bodies, stops.front(), stops.back());
    Indices all(bodies.boxes.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    PosesAtTime last = sampler.at(stops.front());
    sampler.add(last, last, 0, all);
    for (std::size_t i = 1; i < stops.size(); ++i) {
        PosesAtTime next = sampler.at(stops[i]);
        sampler.add(last, next, most_halvings, all);
        last = std::move(next);
        if (progress)
            progress(i);
    }
    std::vector<SampledTrack> tracks;
    for (const std::vector<TimedPose>& samples : sampler.samples())
        tracks.push_back(track_of(samples));
    return tracks;
}

SampledTrack sampled_track(const Motion& motion, const Eigen::AlignedBox3d& box,
                           const std::vector<double>& exact_times) {
    std::set<double> stops(exact_times.begin(), exact_times.end());
    stops.insert({0, 1});
    const auto poses_at = [&](double time) { return std::vector{motion.pose_at(time)}; };
    return sampled_tracks({poses_at, {box}, cuts_of(motion)}, {stops.begin(), stops.end()}).front();
}

std::vector<double> cuts_of(const Motion& motion) {
    std::vector<double> cuts;
    if (const chasles::motion::SharedFrame frame = motion.trajectory().frame()) {
        frame->add_cuts(cuts);
    } else {
        const auto pieces = motion.trajectory().pieces();
        for (std::size_t i = 0; i < pieces->size(); ++i)
            cuts.push_back(pieces->at(i)->time_of({0, 0}).upper);
    }
    std::erase_if(cuts, [](double cut) { return !(0 < cut && cut < 1); });
    std::ranges::sort(cuts);
    return cuts;
}

} // namespace chasles::view
