// How near does a robot come to its world and to itself over a path?
// Source: docs/derivations/39-profile.md, "Many pairs".
#include "chasles/base/limit_of_thread.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"
#include "chasles/robot/handovers.h"
#include "chasles/robot/segment_pairs.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace chasles {

using robot::SegmentPairs;
using robot::Task;

namespace {

using Prepared = RobotChecker::Prepared;

class PathProfile {
public:
    PathProfile(const robot::Stretches& stretches, const JointPath& path, const ProfileOptions& options)
        : stretches_(stretches), path_(path), options_(options) {}

    RobotProfile run();

private:
    [[nodiscard]] DistanceProfile of_segment(std::size_t segment);
    void add(query::LowerEnvelope& envelope, const SegmentPairs& pairs, const Task& task);
    [[nodiscard]] std::uint32_t name_of(const SegmentPairs& pairs, const Task& task);
    void append(const DistanceProfile& of_segment, std::size_t segment);

    const robot::Stretches& stretches_;
    const JointPath& path_;
    const ProfileOptions& options_;
    double share_ = 1; ///< of the path, in time: the segment
    double reach_ = 0; ///< so far apart are pairs looked for at first
    /// What names count, and what they mean in a stretch: pairs of tasks.
    std::vector<RobotPair> names_;
    std::map<std::tuple<const Prepared*, Task::Kind, std::size_t, std::size_t>, std::uint32_t> name_of_;
    RobotProfile found_;
};

/// A pair, if there is one.
std::optional<Task> any_task(const Prepared& prepared) {
    if (!prepared.self_pairs.empty())
        return Task{Task::Kind::self, 0, 0, {0, 1}};
    for (std::size_t e = 0; e < prepared.extents.size(); ++e) {
        for (std::size_t i = 0; i < prepared.obstacles.size(); ++i)
            if (!prepared.is_ignored(e, prepared.obstacles[i].body))
                return Task{Task::Kind::obstacle, e, i, {0, 1}};
        for (std::size_t i = 0; i < prepared.movers.size(); ++i)
            if (!prepared.is_ignored(e, prepared.movers[i]))
                return Task{Task::Kind::mover, e, i, {0, 1}};
    }
    return std::nullopt;
}

RobotProfile PathProfile::run() {
    reach_ = robot::first_distance(stretches_.at(0));
    const auto& segments = path_.segments();
    found_.distance.certain = true;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        share_ = (segments[i].end - segments[i].begin) / (segments.back().end - segments.front().begin);
        append(of_segment(i), i);
    }
    found_.pairs = query::used_names(found_.distance.nearest, names_);
    found_.untested = stretches_.untested();
    return std::move(found_);
}

/// All pairs within a distance, which grows until nothing farther away can be the nearest.
DistanceProfile PathProfile::of_segment(std::size_t segment) {
    const Prepared& prepared = stretches_.at(segment);
    const SegmentPairs pairs(prepared, path_, segment);
    query::LowerEnvelope envelope;
    const std::optional<Task> some = any_task(prepared);
    for (double distance = reach_; some && !is_cancelled();) {
        for (const Task& task : near_tasks(prepared, pairs.motion(), distance))
            if (!is_cancelled())
                add(envelope, pairs, task);
        const double greatest = envelope.greatest_upper();
        reach_ = std::max(robot::first_distance(prepared), std::min(greatest, distance));
        if (greatest <= distance || distance == Pose::largest_length)
            break;
        constexpr double growth = 8;
        distance = std::min({greatest, growth * distance, Pose::largest_length});
    }
    if (is_cancelled() && some) {
        add(envelope, pairs, *some);
        envelope.leave(0);
    }
    return envelope.result();
}

void PathProfile::add(query::LowerEnvelope& envelope, const SegmentPairs& pairs, const Task& task) {
    ProfileOptions options = options_;
    const double share = share_ * (task.part.upper - task.part.lower);
    options.time_tolerance = std::clamp(options.time_tolerance / share, 1e-9, 1.0);
    pairs.naming(task, [&] {
        envelope.add(
            query::answer({pairs.prepared().moving(task).shape.body(), pairs.prepared().fixed_shape(task).body(),
                           pairs.trajectory(task), options, envelope, task.part}),
            task.part, name_of(pairs, task));
    });
}

/// A pair may be other tasks in another stretch.
std::uint32_t PathProfile::name_of(const SegmentPairs& pairs, const Task& task) {
    const auto [known, is_new] = name_of_.try_emplace({&pairs.prepared(), task.kind, task.first, task.second}, 0);
    if (!is_new)
        return known->second;
    const RobotPair name = pairs.name_of(task);
    const auto key = [](const RobotPair& p) {
        return std::tie(p.first, p.second, p.is_with_scene, p.first_shape, p.second_shape);
    };
    auto place = std::ranges::find_if(names_, [&](const RobotPair& p) { return key(p) == key(name); });
    if (place == names_.end())
        place = names_.insert(place, name);
    return known->second = std::uint32_t(place - names_.begin());
}

/// In stamps. The last entries of a segment are those at its end, where the next one begins.
void PathProfile::append(const DistanceProfile& of_segment, std::size_t segment) {
    DistanceProfile& all = found_.distance;
    const JointPath::Segment& own = path_.segments()[segment];
    const std::size_t steps = of_segment.times.size() - 1;
    if (segment > 0) {
        all.times.pop_back();
        all.lower.pop_back();
        all.upper.pop_back();
    }
    for (const double time : of_segment.times)
        all.times.push_back(time == 1 ? own.end : own.begin + time * (own.end - own.begin));
    all.lower.insert(all.lower.end(), of_segment.lower.begin(), of_segment.lower.end());
    all.upper.insert(all.upper.end(), of_segment.upper.begin(), of_segment.upper.end());
    all.nearest.insert(all.nearest.end(), of_segment.nearest.begin(), of_segment.nearest.begin() + long(steps));
    all.certain &= of_segment.certain;
    all.work += of_segment.work;
}

} // namespace

RobotProfile RobotChecker::profile(const JointPath& path, const ProfileOptions& options,
                                   std::span<const Handover> handovers) const {
    query::check_options(options);
    const robot::Stretches stretches(*prepared_, path, handovers);
    return PathProfile(stretches, path, options).run();
}

} // namespace chasles
