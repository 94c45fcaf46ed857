// How near does a robot come along a path? Source: docs/derivations/29-robots.md, "Clearance".
#include "chasles/base/limit_of_thread.h"
#include "chasles/query/nearest_of.h"
#include "chasles/query/requirements.h"
#include "chasles/robot/handovers.h"
#include "chasles/robot/segment_pairs.h"

#include <algorithm>
#include <optional>

namespace chasles {

using robot::SegmentPairs;
using robot::Task;

namespace {

using Prepared = RobotChecker::Prepared;

class ClearanceSearch {
public:
    ClearanceSearch(const robot::Stretches& stretches, const JointPath& path, const LeastDistanceOptions& options)
        : stretches_(stretches), path_(path), nearest_(options) {}

    RobotClearance run();

private:
    void visit_segments();
    void visit(std::size_t segment);
    void visit(const SegmentPairs& pairs, const Task& task, std::size_t segment);

    const robot::Stretches& stretches_;
    const JointPath& path_;
    query::NearestOf nearest_;
    RobotClearance found_;
};

RobotClearance ClearanceSearch::run() {
    visit_segments();
    found_.nearest = nearest_.result();
    found_.distance = found_.nearest.distance;
    found_.certain = found_.nearest.certain;
    found_.work = found_.nearest.work;
    found_.untested = stretches_.untested();
    if (found_.pair) {
        found_.time = robot::stamps_of(path_.segments()[found_.segment], found_.nearest.time);
        found_.configuration = path_.at(found_.time.lower);
    }
    return std::move(found_);
}

/// At the limit of the thread no bound is known of the pairs that are left.
void ClearanceSearch::visit_segments() {
    try {
        for (std::size_t segment = 0; segment < path_.segments().size() && !nearest_.touches(); ++segment) {
            if (segment > 0)
                throw_if_cancelled();
            visit(segment);
        }
    } catch (const Cancelled&) {
        nearest_.leave(0);
    }
}

/// All pairs within a distance, which grows until some pair is nearer, or is that of the nearest pair of all.
void ClearanceSearch::visit(std::size_t segment) {
    const Prepared& prepared = stretches_.at(segment);
    const SegmentPairs pairs(prepared, path_, segment);
    if (prepared.self_pairs.empty() && prepared.bodies.empty())
        return;
    for (double distance = nearest_.has_any() ? nearest_.upper() : robot::first_distance(prepared);;) {
        for (const Task& task : near_tasks(prepared, pairs.motion(), distance))
            pairs.naming(task, [&] { visit(pairs, task, segment); });
        if (nearest_.upper() <= distance || distance == Pose::largest_length)
            return;
        constexpr double growth = 8;
        distance = std::min(nearest_.has_any() ? nearest_.upper() : growth * distance, Pose::largest_length);
    }
}

void ClearanceSearch::visit(const SegmentPairs& pairs, const Task& task, std::size_t segment) {
    ++found_.pairs;
    const Prepared& prepared = pairs.prepared();
    std::optional<LeastDistance> distance =
        nearest_.ask(prepared.moving(task).shape.body(), prepared.fixed_shape(task).body(), pairs.trajectory(task));
    if (!distance)
        return;
    distance->time = distance->tau = robot::in_segment(distance->time, task.part);
    robot::slow_down(distance->contacts, task.part);
    if (nearest_.take(std::move(*distance))) {
        found_.segment = segment;
        found_.pair = pairs.name_of(task);
    }
}

} // namespace

RobotClearance RobotChecker::least_distance(const JointPath& path, const LeastDistanceOptions& options,
                                            std::span<const Handover> handovers) const {
    query::check_options(options);
    const robot::Stretches stretches(*prepared_, path, handovers);
    return ClearanceSearch(stretches, path, options).run();
}

RobotClearance RobotChecker::least_distance(const Configuration& start, const Configuration& goal,
                                            const LeastDistanceOptions& options) const {
    const std::array ends{start, goal};
    return least_distance(JointPath::straight(prepared_->robot, ends), options);
}

} // namespace chasles
