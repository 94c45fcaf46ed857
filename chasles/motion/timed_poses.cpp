// Stamps are mapped to [0, 1] once; brackets are mapped back outward.
#include "chasles/motion/timed_poses.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/motion/motion_ends.h"
#include "chasles/motion/smooth_trajectory.h"
#include "chasles/motion/splines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace chasles {

namespace {

void require_stamps(const std::vector<double>& stamps, const std::vector<Pose>& poses) {
    const auto refuse = [](const std::string& why) { throw InvalidInput("timed poses: " + why); };
    if (poses.size() < 2)
        refuse("poses: at least two are needed");
    if (stamps.size() != poses.size())
        refuse("stamps: there are " + std::to_string(stamps.size()) + " for " + std::to_string(poses.size()) +
               " poses");
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        if (!std::isfinite(stamps[i]))
            refuse("stamps: stamp " + std::to_string(i) + " is NaN or infinite");
        if (i > 0 && !(stamps[i - 1] < stamps[i]))
            refuse("stamps: must ascend, but stamp " + std::to_string(i) + " is " + number_text(stamps[i]) + " after " +
                   number_text(stamps[i - 1]));
    }
    if (!std::isfinite(stamps.back() - stamps.front()))
        refuse("stamps: they are too far apart");
}

} // namespace

TimedPoses TimedPoses::through(std::vector<double> stamps, const std::vector<Pose>& poses, Between between,
                               const Eigen::Vector3d& centre) {
    require_stamps(stamps, poses);
    std::vector<double> times;
    times.reserve(stamps.size());
    for (const double stamp : stamps)
        times.push_back((stamp - stamps.front()) / (stamps.back() - stamps.front()));
    const motion::SmoothTrajectory trajectory(motion::SmoothMotion::of_one(
        motion::even_track(std::move(times), poses, between, motion::checked_centre(centre))));
    return {std::move(stamps),
            Motion(std::make_shared<const motion::ErasedTrajectory<motion::SmoothTrajectory>>(trajectory))};
}

Bracket TimedPoses::stamp_of(const Bracket& time) const {
    constexpr double rounding = 0x1p-51;
    const double first = stamps_.front(), last = stamps_.back();
    const double slack = rounding * (std::abs(first) + std::abs(last));
    const auto at = [&](double t, double outwards) { // the ends are exact
        return t == 0 ? first : t == 1 ? last : std::clamp(first + t * (last - first) + outwards, first, last);
    };
    return {at(time.lower, -slack), at(time.upper, slack)};
}

double TimedPoses::time_of(double stamp) const {
    return std::clamp((stamp - stamps_.front()) / (stamps_.back() - stamps_.front()), 0.0, 1.0);
}

std::size_t TimedPoses::segment_of(double time) const {
    const auto after = std::ranges::lower_bound(stamps_, time, {}, [&](double stamp) { return time_of(stamp); });
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - stamps_.begin(), 1)) - 1;
}

} // namespace chasles
