// How near does a robot come to its world and to itself over a path?
// Source: docs/derivations/39-profile.md, "Many pairs".
#include "chasles/base/limit_of_thread.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"
#include "chasles/robot/segment_pairs.h"

#include <algorithm>
#include <tuple>

namespace chasles {

using robot::SegmentPairs;
using robot::Task;

namespace {

using Prepared = RobotChecker::Prepared;

class PathProfile {
public:
    PathProfile(const Prepared& prepared, const JointPath& path, const ProfileOptions& options)
        : prepared_(prepared), path_(path), options_(options) {}

    RobotProfile run();

private:
    [[nodiscard]] DistanceProfile of_segment(std::size_t segment);
    void add(query::LowerEnvelope& envelope, const SegmentPairs& pairs, const Task& task);
    [[nodiscard]] std::optional<Task> any_task() const;
    [[nodiscard]] std::uint32_t name_of(const Task& task);
    void append(const DistanceProfile& of_segment, std::size_t segment);

    const Prepared& prepared_;
    const JointPath& path_;
    const ProfileOptions& options_;
    double share_ = 1;        ///< of the path, in time: the segment
    double reach_ = 0;        ///< so far apart are pairs looked for at first
    std::vector<Task> tasks_; ///< what names count
    RobotProfile found_;
};

RobotProfile PathProfile::run() {
    reach_ = robot::first_distance(prepared_);
    const auto& segments = path_.segments();
    found_.distance.certain = true;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        share_ = (segments[i].end - segments[i].begin) / (segments.back().end - segments.front().begin);
        append(of_segment(i), i);
    }
    std::vector<RobotPair> names;
    const SegmentPairs pairs(prepared_, path_, 0);
    for (const Task& task : tasks_)
        names.push_back(pairs.name_of(task));
    found_.pairs = query::used_names(found_.distance.nearest, names);
    found_.untested = prepared_.untested;
    return std::move(found_);
}

/// All pairs within a distance, which grows until nothing farther away can be the nearest.
DistanceProfile PathProfile::of_segment(std::size_t segment) {
    const SegmentPairs pairs(prepared_, path_, segment);
    query::LowerEnvelope envelope;
    const std::optional<Task> some = any_task();
    for (double distance = reach_; some && !is_cancelled();) {
        for (const Task& task : near_tasks(prepared_, pairs.motion(), distance))
            if (!is_cancelled())
                add(envelope, pairs, task);
        const double greatest = envelope.greatest_upper();
        reach_ = std::min(greatest, distance);
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

/// A pair, if there is one.
std::optional<Task> PathProfile::any_task() const {
    if (!prepared_.self_pairs.empty())
        return Task{Task::Kind::self, 0, 0, {0, 1}};
    for (std::size_t e = 0; e < prepared_.extents.size(); ++e) {
        for (std::size_t i = 0; i < prepared_.obstacles.size(); ++i)
            if (!prepared_.is_ignored(e, prepared_.obstacles[i].body))
                return Task{Task::Kind::obstacle, e, i, {0, 1}};
        for (std::size_t i = 0; i < prepared_.movers.size(); ++i)
            if (!prepared_.is_ignored(e, prepared_.movers[i]))
                return Task{Task::Kind::mover, e, i, {0, 1}};
    }
    return std::nullopt;
}

void PathProfile::add(query::LowerEnvelope& envelope, const SegmentPairs& pairs, const Task& task) {
    ProfileOptions options = options_;
    const double share = share_ * (task.part.upper - task.part.lower);
    options.time_tolerance = std::clamp(options.time_tolerance / share, 1e-9, 1.0);
    pairs.naming(task, [&] {
        envelope.add(query::answer({prepared_.moving(task).shape.body(), prepared_.fixed_shape(task).body(),
                                    pairs.trajectory(task), options, envelope, task.part}),
                     task.part, name_of(task));
    });
}

std::uint32_t PathProfile::name_of(const Task& task) {
    const auto key = [](const Task& t) { return std::tuple(t.kind, t.first, t.second); };
    auto place = std::ranges::find(tasks_, key(task), key);
    if (place == tasks_.end())
        place = tasks_.insert(place, task);
    return std::uint32_t(place - tasks_.begin());
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

RobotProfile RobotChecker::profile(const JointPath& path, const ProfileOptions& options) const {
    query::check_options(options);
    return PathProfile(*prepared_, path, options).run();
}

} // namespace chasles
