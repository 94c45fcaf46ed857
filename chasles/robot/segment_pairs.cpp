#include "chasles/robot/segment_pairs.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace chasles::robot {

namespace {

/// The stamp at a time of a segment, and the end of the segment at its end.
double stamp_at(const JointPath::Segment& segment, double time) {
    return time == 0 ? segment.begin : time == 1 ? segment.end : segment.begin + time * (segment.end - segment.begin);
}

/// A segment as a part of the whole path, which is not empty however short the segment is.
Bracket share_of(const JointPath& path, std::size_t segment) {
    const auto& segments = path.segments();
    const double begin = segments.front().begin, end = segments.back().end;
    const auto share = [&](double stamp) { return std::clamp((stamp - begin) / (end - begin), 0.0, 1.0); };
    const double lower = std::min(share(segments[segment].begin), 1 - 0x1p-53);
    return {lower, std::max(share(segments[segment].end), std::nextafter(lower, 1.0))};
}

/// Refuses a path of a robot with other variables: its polynomials would be those of other joints, or go the other way
/// round.
void check_variables(const Model& model, const JointPath& path) {
    if (!path.variables() || path.variables() == model.variables_of_paths)
        return;
    for (std::size_t i = 0; i < model.variables.size(); ++i) {
        const RobotVariable &own = model.variables[i], &other = path.variables()->at(i);
        const std::string place = "path: belongs to another robot: variable " + std::to_string(i) + " is ";
        if (own.name != other.name)
            throw InvalidInput(place + io::in_quotes(other.name) + " in the path, and " + io::in_quotes(own.name) +
                               " in the robot");
        if (own.is_continuous != other.is_continuous)
            throw InvalidInput(place + io::in_quotes(own.name) + " in both, but " +
                               (other.is_continuous ? "the path goes the shorter way round, and the robot straight"
                                                    : "the path goes straight, and the robot the shorter way round"));
    }
}

const JointPath::Segment& checked_segment(const Model& model, const JointPath& path, std::size_t segment) {
    const JointPath::Segment& checked = path.segments()[segment];
    if (checked.coefficients.cols() != Eigen::Index(model.variables.size()))
        throw InvalidInput("path: belongs to a robot with another number of variables");
    check_variables(model, path);
    return checked;
}

/// The part of a frame that a task is about.
motion::SharedFrame part_of(const motion::SharedFrame& frame, const Bracket& part) {
    return part.lower == 0 && part.upper == 1 ? frame : motion::part_frame(frame, part.lower, part.upper);
}

} // namespace

Bracket in_segment(const Bracket& local, const Bracket& part) {
    constexpr double rounding = 0x1p-51;
    const auto at = [&](double time) { return part.lower + time * (part.upper - part.lower); };
    return {std::max(part.lower, at(local.lower) * (1 - rounding)),
            std::min(part.upper, at(local.upper) * (1 + rounding))};
}

Bracket stamps_of(const JointPath::Segment& segment, const Bracket& time) {
    const double infinity = std::numeric_limits<double>::infinity();
    const auto rounded = [&](double share, double direction) {
        const bool is_exact = share == 0 || share == 1; // both ends are
        const double stamp = stamp_at(segment, share);
        return is_exact ? stamp : std::clamp(std::nextafter(stamp, direction), segment.begin, segment.end);
    };
    return {rounded(time.lower, -infinity), rounded(time.upper, infinity)};
}

void slow_down(std::span<Contact> contacts, const Bracket& part) {
    for (Contact& contact : contacts)
        contact.approach_speed /= part.upper - part.lower;
}

SegmentPairs::SegmentPairs(const RobotChecker::Prepared& prepared, const JointPath& path, std::size_t segment)
    : prepared_(prepared), motion_(prepared.model().motion_of(checked_segment(prepared.model(), path, segment))),
      of_scene_(share_of(path, segment)) {}

RobotPair name_of(const RobotChecker::Prepared& prepared, const Task& task) {
    const Model& model = prepared.model();
    RobotPair pair;
    std::tie(pair.first, pair.first_shape) = model.name_of(prepared.moving(task));
    pair.is_with_scene = task.kind != Task::Kind::self;
    if (pair.is_with_scene)
        pair.second = prepared.bodies[prepared.body_of(task)].name;
    else
        std::tie(pair.second, pair.second_shape) = model.name_of(model.elements[prepared.self_pairs[task.first].fixed]);
    return pair;
}

motion::SharedFrame SegmentPairs::frame_of(const Element& element) const {
    return motion::chain_frame(prepared_.model().chain(motion_, element.group, element.place));
}

motion::SmoothMotion SegmentPairs::motion_of_self(const Task& task) const {
    const Model& model = prepared_.model();
    const auto& [moving, fixed, margin] = prepared_.self_pairs[task.first];
    const Element &a = model.elements[moving], &b = model.elements[fixed];
    return {part_of(motion::chain_frame(model.chain_between(motion_, b, a)), task.part),
            part_of(frame_of(a), task.part), part_of(frame_of(b), task.part)};
}

motion::SmoothMotion SegmentPairs::motion_to_obstacle(const Task& task) const {
    const Model& model = prepared_.model();
    const Element& moving = model.elements[task.first];
    const motion::FixedPose& pose = prepared_.obstacles[task.second].pose;
    motion::Chain relative, at_rest;
    relative.add(pose.inverse());
    model.add_chain(relative, motion_, moving.group, moving.place);
    at_rest.add(pose);
    return {part_of(motion::chain_frame(std::move(relative)), task.part), part_of(frame_of(moving), task.part),
            motion::chain_frame(std::move(at_rest))};
}

motion::SmoothMotion SegmentPairs::motion_to_mover(const Task& task) const {
    const motion::SharedFrame moving = frame_of(prepared_.model().elements[task.first]);
    const motion::SharedFrame fixed = part_of(prepared_.motions[prepared_.body_of(task)]->frame, of_scene_);
    return {motion::relative_frame(moving, fixed), moving, fixed};
}

motion::SmoothMotion SegmentPairs::motion_of(const Task& task) const {
    switch (task.kind) {
    case Task::Kind::self:
        return motion_of_self(task);
    case Task::Kind::obstacle:
        return motion_to_obstacle(task);
    default:
        return motion_to_mover(task);
    }
}

motion::ErasedTrajectory<motion::SmoothTrajectory> SegmentPairs::trajectory(const Task& task) const {
    return motion::ErasedTrajectory<motion::SmoothTrajectory>{motion::SmoothTrajectory(motion_of(task))};
}

double first_distance(const RobotChecker::Prepared& prepared) {
    double radius = 0;
    for (const RobotChecker::Prepared::Extent& extent : prepared.extents)
        radius = std::max(radius, extent.radius);
    return std::clamp(0.1 * radius, 1e-30, Pose::largest_length);
}

std::vector<Task> tasks_of(const SegmentPairs& segment) {
    std::vector<Task> tasks = near_tasks(segment.prepared(), segment.motion());
    if (!segment.prepared().options.hold)
        return tasks;
    std::vector<Task> joined; // parts of one pair are in order of time
    for (const Task& task : tasks) {
        const auto held = std::ranges::find_if(joined, [&](const Task& earlier) {
            return earlier.kind == task.kind && earlier.first == task.first && earlier.second == task.second &&
                   earlier.part.lower == 0;
        });
        if (held == joined.end())
            joined.push_back(task);
        else
            held->part.upper = task.part.upper;
    }
    return joined;
}

} // namespace chasles::robot
