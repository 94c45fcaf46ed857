// How near does a robot come along a path? Source: docs/derivations/29-robots.md, "Clearance".
#include "chasles/base/limit.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"
#include "chasles/robot/segment_pairs.h"

#include <algorithm>
#include <limits>

namespace chasles {

using robot::SegmentPairs;
using robot::Task;

namespace {

using Prepared = RobotChecker::Prepared;

/// The nearest pair of a path. A pair is searched only if it comes nearer than the nearest one so far.
class ClearanceSearch {
public:
    ClearanceSearch(const Prepared& prepared, const JointPath& path, const LeastDistanceOptions& options)
        : prepared_(prepared), path_(path), options_(options) {}

    RobotClearance run();

private:
    void visit_segments();
    void visit(std::size_t segment);
    void visit(const SegmentPairs& pairs, const Task& task, std::size_t segment);
    [[nodiscard]] bool comes_nearer(const Task& task, const motion::AnyTrajectory& trajectory);
    [[nodiscard]] bool is_better(const LeastDistance& found, std::size_t segment) const;
    [[nodiscard]] bool touches() const { return best_.distance.upper == 0; }
    /// Whatever stays farther apart need not be searched: the bracket may have this width.
    [[nodiscard]] double searched_distance() const { return best_.distance.upper * (1 - 0.5 * options_.tolerance); }
    [[nodiscard]] double first_distance() const;

    const Prepared& prepared_;
    const JointPath& path_;
    const LeastDistanceOptions& options_;
    RobotClearance best_;
};

RobotClearance ClearanceSearch::run() {
    const double infinity = std::numeric_limits<double>::infinity();
    best_.distance = {infinity, infinity};
    best_.untested = prepared_.untested;
    visit_segments();
    if (!best_.pair) {
        best_.certain = best_.distance.lower > 0;
        return best_;
    }
    best_.time = robot::stamps_of(path_.segments()[best_.segment], best_.nearest.time);
    best_.configuration = path_.at(best_.time.lower);
    if (!touches())
        best_.certain = best_.distance.upper - best_.distance.lower <= options_.tolerance * best_.distance.upper;
    best_.nearest.distance = best_.distance; // no other pair is nearer
    best_.nearest.certain = best_.certain;
    return best_;
}

/// At the limit of the thread no bound is known of the pairs that are left.
void ClearanceSearch::visit_segments() {
    try {
        for (std::size_t segment = 0; segment < path_.segments().size() && !touches(); ++segment)
            visit(segment);
    } catch (const Cancelled&) {
        best_.distance.lower = 0;
    }
}

/// A tenth of a link: pairs that are much farther apart need not be searched.
double ClearanceSearch::first_distance() const {
    double radius = 0;
    for (const Prepared::Extent& extent : prepared_.extents)
        radius = std::max(radius, extent.radius);
    return std::clamp(0.1 * radius, 1e-30, Pose::largest_length);
}

/// All pairs within a distance, which grows until some pair is nearer, or is that of the nearest pair of all.
void ClearanceSearch::visit(std::size_t segment) {
    const SegmentPairs pairs(prepared_, path_, segment);
    if (prepared_.self_pairs.empty() && prepared_.bodies.empty())
        return;
    for (double distance = best_.pair ? best_.distance.upper : first_distance();;) {
        for (const Task& task : near_tasks(prepared_, pairs.motion(), distance))
            pairs.naming(task, [&] { visit(pairs, task, segment); });
        if (best_.distance.upper <= distance || distance == Pose::largest_length)
            return;
        constexpr double growth = 8;
        distance = std::min(best_.pair ? best_.distance.upper : growth * distance, Pose::largest_length);
    }
}

void ClearanceSearch::visit(const SegmentPairs& pairs, const Task& task, std::size_t segment) {
    const auto trajectory = pairs.trajectory(task);
    ++best_.pairs;
    if (best_.pair && !comes_nearer(task, trajectory))
        return;
    LeastDistance found =
        query::answer({prepared_.moving(task).shape.body(), prepared_.fixed_shape(task).body(), trajectory, options_});
    best_.work += found.work;
    const double lower = std::min(best_.distance.lower, found.distance.lower);
    found.time = found.tau = robot::in_segment(found.time, task.part);
    robot::slow_down(found.contacts, task.part);
    if (is_better(found, segment)) {
        best_.distance.upper = found.distance.upper;
        best_.segment = segment;
        best_.certain = found.certain;
        best_.pair = pairs.name_of(task);
        best_.nearest = std::move(found);
    }
    best_.distance.lower = std::min(lower, searched_distance());
}

/// Whether a pair comes nearer than the nearest one so far, or touches before it.
bool ClearanceSearch::comes_nearer(const Task& task, const motion::AnyTrajectory& trajectory) {
    QueryOptions options;
    options.find = Find::any;
    options.margin = searched_distance();
    const FirstContact found =
        query::answer({prepared_.moving(task).shape.body(), prepared_.fixed_shape(task).body(), trajectory, options});
    best_.work += found.work;
    return found.verdict != Verdict::clear;
}

/// Nearer, or as near and earlier.
bool ClearanceSearch::is_better(const LeastDistance& found, std::size_t segment) const {
    if (!best_.pair || found.distance.upper != best_.distance.upper)
        return found.distance.upper < best_.distance.upper;
    return segment == best_.segment && found.time.lower < best_.nearest.time.lower;
}

} // namespace

RobotClearance RobotChecker::least_distance(const JointPath& path, const LeastDistanceOptions& options) const {
    query::check_options(options);
    return ClearanceSearch(*prepared_, path, options).run();
}

RobotClearance RobotChecker::least_distance(const Configuration& start, const Configuration& goal,
                                            const LeastDistanceOptions& options) const {
    const std::array ends{start, goal};
    return least_distance(JointPath::straight(prepared_->robot, ends), options);
}

} // namespace chasles
