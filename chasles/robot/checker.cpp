// Asks the pairs of a robot and its world that come near each other, in order of time.
// Source: docs/derivations/29-robots.md, "Answers".
#include "chasles/base/invalid_input.h"
#include "chasles/base/parallel_for.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/screw_path.h"
#include "chasles/motion/smooth_trajectory.h"
#include "chasles/query/pair_query.h"
#include "chasles/robot/prepared.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace chasles {

using robot::Element;
using robot::Model;
using robot::SegmentMotion;
using robot::Task;

namespace {

using Prepared = RobotChecker::Prepared;

/// Time within a part of a segment, as time within the segment, rounded outwards.
Bracket in_segment(const Bracket& local, const Bracket& part) {
    constexpr double rounding = 0x1p-51;
    const auto at = [&](double time) { return part.lower + time * (part.upper - part.lower); };
    return {std::max(part.lower, at(local.lower) * (1 - rounding)),
            std::min(part.upper, at(local.upper) * (1 + rounding))};
}

/// One segment of a path.
class SegmentSearch {
public:
    /// `of_scene` is the time of the segment in that of the scene.
    SegmentSearch(const Prepared& prepared, const JointPath::Segment& segment, const Bracket& of_scene)
        : prepared_(prepared), motion_(prepared.model().motion_of(segment)), of_scene_(of_scene) {}

    struct Found {
        RobotPair pair;
        FirstContact contact; ///< with times of the segment
    };
    /// The first contact, or some contact with Find::any; null if the segment is clear.
    std::optional<Found> run();
    [[nodiscard]] bool is_clear() const;

    [[nodiscard]] std::size_t pairs() const { return pairs_; }
    [[nodiscard]] const Work& work() const { return work_; }

private:
    [[nodiscard]] FirstContact ask(const Task& task, double until, Find find) const;
    [[nodiscard]] motion::SmoothMotion motion_of(const Task& task) const;
    [[nodiscard]] motion::SmoothMotion motion_of_self(const Task& task) const;
    [[nodiscard]] motion::SmoothMotion motion_to_obstacle(const Task& task) const;
    [[nodiscard]] motion::SmoothMotion motion_to_mover(const Task& task) const;
    [[nodiscard]] motion::SharedFrame frame_of(const Element& element) const;
    [[nodiscard]] RobotPair name_of(const Task& task) const;

    const Prepared& prepared_;
    SegmentMotion motion_;
    Bracket of_scene_;
    std::size_t pairs_ = 0;
    Work work_;
};

RobotPair SegmentSearch::name_of(const Task& task) const {
    const Model& model = prepared_.model();
    RobotPair pair;
    std::tie(pair.first, pair.first_shape) = model.name_of(prepared_.moving(task));
    pair.is_with_scene = task.kind != Task::Kind::self;
    if (pair.is_with_scene)
        pair.second = prepared_.bodies[prepared_.body_of(task)].name;
    else
        std::tie(pair.second, pair.second_shape) =
            model.name_of(model.elements[prepared_.self_pairs[task.first].fixed]);
    return pair;
}

motion::SharedFrame SegmentSearch::frame_of(const Element& element) const {
    return motion::chain_frame(prepared_.model().chain(motion_, element.group, element.place));
}

/// The part of a frame that a task is about.
motion::SharedFrame part_of(const motion::SharedFrame& frame, const Bracket& part) {
    return part.lower == 0 && part.upper == 1 ? frame : motion::part_frame(frame, part);
}

motion::SmoothMotion SegmentSearch::motion_of_self(const Task& task) const {
    const Model& model = prepared_.model();
    const auto& [moving, fixed, margin] = prepared_.self_pairs[task.first];
    const Element &a = model.elements[moving], &b = model.elements[fixed];
    return {part_of(motion::chain_frame(model.chain_between(motion_, b, a)), task.part),
            part_of(frame_of(a), task.part), part_of(frame_of(b), task.part)};
}

motion::SmoothMotion SegmentSearch::motion_to_obstacle(const Task& task) const {
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

motion::SmoothMotion SegmentSearch::motion_to_mover(const Task& task) const {
    const motion::SharedFrame moving = frame_of(prepared_.model().elements[task.first]);
    const motion::SharedFrame fixed = part_of(prepared_.motions[prepared_.body_of(task)]->frame, of_scene_);
    return {motion::relative_frame(moving, fixed), moving, fixed};
}

/// The moving element as seen from the fixed body, by the joints between them alone, and both in the world.
motion::SmoothMotion SegmentSearch::motion_of(const Task& task) const {
    switch (task.kind) {
    case Task::Kind::self:
        return motion_of_self(task);
    case Task::Kind::obstacle:
        return motion_to_obstacle(task);
    default:
        return motion_to_mover(task);
    }
}

/// The answer for a part of a segment, in the time of the segment.
void count_in_segment(FirstContact& found, const Bracket& part) {
    found.clear_until = in_segment({found.clear_until, found.clear_until}, part).lower;
    found.time = in_segment(found.time, part);
    found.tau = found.time;
    for (Contact& contact : found.contacts)
        contact.approach_speed /= part.upper - part.lower;
    if (found.verdict == Verdict::contact_at_start && part.lower > 0)
        found.verdict = Verdict::contact; // it was clear before
}

FirstContact SegmentSearch::ask(const Task& task, double until, Find find) const {
    const double duration = task.part.upper - task.part.lower;
    QueryOptions options = prepared_.options;
    options.find = find;
    if (task.kind == Task::Kind::self)
        options.margin = prepared_.self_pairs[task.first].margin;
    options.time_tolerance = std::clamp(options.time_tolerance / duration, 1e-15, 1.0);
    const motion::ErasedTrajectory trajectory{motion::SmoothTrajectory(motion_of(task))};
    const double local_until = std::clamp((until - task.part.lower) / duration * (1 + 1e-12), 0.0, 1.0);
    FirstContact found = query::answer(
        {prepared_.moving(task).shape.body(), prepared_.fixed_shape(task).body(), trajectory, options, local_until});
    if (found.verdict != Verdict::clear)
        count_in_segment(found, task.part);
    return found;
}

/// By lower ends of brackets, then by upper ones.
bool is_earlier(const FirstContact& a, const FirstContact& b) {
    return std::pair(a.time.lower, a.time.upper) < std::pair(b.time.lower, b.time.upper);
}

std::optional<SegmentSearch::Found> SegmentSearch::run() {
    const bool finds_any = prepared_.options.find == Find::any;
    std::optional<Found> first;
    double best = 1, clear_until = 1;
    for (const Task& task : near_tasks(prepared_, motion_)) {
        if (first && (finds_any || task.part.lower > best)) {
            clear_until = std::min(clear_until, task.part.lower); // it is not asked
            break;
        }
        ++pairs_;
        FirstContact contact = ask(task, best, prepared_.options.find);
        work_ += contact.work;
        if (contact.verdict == Verdict::clear)
            continue;
        clear_until = std::min(clear_until, contact.clear_until);
        if (!first || is_earlier(contact, first->contact))
            first = Found{name_of(task), std::move(contact)};
        best = std::min(best, first->contact.time.upper);
    }
    if (first)
        first->contact.clear_until = clear_until;
    return first;
}

/// The earliest contact is not needed: a pair whose path is not proven clear ends the question.
bool SegmentSearch::is_clear() const {
    return std::ranges::all_of(near_tasks(prepared_, motion_),
                               [&](const Task& task) { return ask(task, 1, Find::any).verdict == Verdict::clear; });
}

/// The stamp at a time of a segment, and the end of the segment at its end.
double stamp_at(const JointPath::Segment& segment, double time) {
    return time == 1 ? segment.end : segment.begin + time * (segment.end - segment.begin);
}

Bracket stamps_of(const JointPath::Segment& segment, const Bracket& time) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double lower = stamp_at(segment, time.lower), upper = stamp_at(segment, time.upper);
    return {time.lower == 0 ? segment.begin : std::max(segment.begin, std::nextafter(lower, -infinity)),
            time.upper == 1 ? segment.end : std::min(segment.end, std::nextafter(upper, infinity))};
}

} // namespace

RobotChecker::RobotChecker(const Robot& robot, const Scene* scene, const RobotQuery& query)
    : prepared_(std::make_unique<const Prepared>(robot, scene, query)) {}
RobotChecker::~RobotChecker() = default;
RobotChecker::RobotChecker(RobotChecker&&) noexcept = default;
RobotChecker& RobotChecker::operator=(RobotChecker&&) noexcept = default;

const Robot& RobotChecker::robot() const {
    return prepared_->robot;
}

namespace {

/// Adds the contact of a segment to an answer.
void set_contact(RobotAnswer& answer, const JointPath& path, SegmentSearch::Found found) {
    const JointPath::Segment& segment = path.segments()[answer.segment];
    FirstContact& contact = found.contact;
    const bool is_later = answer.segment > 0 && contact.verdict == Verdict::contact_at_start;
    answer.verdict = is_later ? Verdict::contact : contact.verdict;
    answer.time = stamps_of(segment, contact.time);
    answer.certain = contact.certain;
    answer.pair = std::move(found.pair);
    answer.clear_until = stamps_of(segment, {contact.clear_until, contact.clear_until}).lower;
    answer.configuration = path.at(answer.time.lower);
    answer.clear_configuration = path.at(answer.clear_until);
    answer.contact = std::move(contact);
}

/// The stamps of a segment as a part of the whole path, which is not empty however short the segment is.
Bracket share_of(const Bracket& stamps, const Bracket& path) {
    const auto share = [&](double stamp) {
        return std::clamp((stamp - path.lower) / (path.upper - path.lower), 0.0, 1.0);
    };
    const double lower = std::min(share(stamps.lower), 1 - 0x1p-53);
    return {lower, std::max(share(stamps.upper), std::nextafter(lower, 1.0))};
}

} // namespace

RobotAnswer RobotChecker::first_contact(const JointPath& path) const {
    RobotAnswer answer;
    const std::vector<JointPath::Segment>& segments = path.segments();
    const Bracket whole{segments.front().begin, segments.back().end};
    if (segments.front().coefficients.cols() != Eigen::Index(prepared_->model().variables.size()))
        throw InvalidInput("path: belongs to a robot with another number of variables");
    for (answer.segment = 0; answer.segment < segments.size(); ++answer.segment) {
        const JointPath::Segment& segment = segments[answer.segment];
        SegmentSearch search(*prepared_, segment, share_of({segment.begin, segment.end}, whole));
        std::optional<SegmentSearch::Found> found = search.run();
        answer.pairs += search.pairs();
        answer.work += search.work();
        if (found) {
            set_contact(answer, path, std::move(*found));
            return answer;
        }
    }
    --answer.segment;
    answer.verdict = Verdict::clear;
    answer.clear_until = segments.back().end;
    answer.configuration = answer.clear_configuration = path.at(answer.clear_until);
    return answer;
}

RobotAnswer RobotChecker::first_contact(const Configuration& start, const Configuration& goal) const {
    const std::array ends{start, goal};
    return first_contact(JointPath::straight(prepared_->robot, ends));
}

bool RobotChecker::is_clear(const Configuration& start, const Configuration& goal) const {
    const std::array ends{start, goal};
    const JointPath path = JointPath::straight(prepared_->robot, ends);
    return SegmentSearch(*prepared_, path.segments().front(), {0, 1}).is_clear();
}

bool RobotChecker::is_clear(const Configuration& configuration) const {
    return is_clear(configuration, configuration);
}

std::vector<RobotAnswer> RobotChecker::first_contacts(const Eigen::MatrixXd& starts, const Eigen::MatrixXd& goals,
                                                      unsigned threads) const {
    query::require(starts.rows() == goals.rows() && starts.cols() == goals.cols(), "edges",
                   "starts and goals must have the same shape");
    std::vector<JointPath> paths; // made before the threads start, so that an error has the number of its row
    for (Eigen::Index i = 0; i < starts.rows(); ++i)
        try {
            paths.push_back(
                JointPath::straight(prepared_->robot, std::array<Configuration, 2>{starts.row(i), goals.row(i)}));
        } catch (const InvalidInput& error) {
            throw InvalidInput("edge " + std::to_string(i) + ": " + error.what());
        }
    std::vector<RobotAnswer> answers(paths.size());
    parallel_for(threads, answers.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            answers[i] = first_contact(paths[i]);
    });
    return answers;
}

} // namespace chasles
