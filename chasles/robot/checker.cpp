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

namespace chasles {

using robot::Element;
using robot::Model;
using robot::SegmentMotion;
using robot::Task;

namespace {

using Prepared = RobotChecker::Prepared;

/// More obstacles than this have a tree.
constexpr std::size_t few_obstacles = 32;

Prepared::Extent extent_of(const Element& element) {
    const MeshReport report = element.shape.report();
    Prepared::Extent extent;
    extent.place = element.place.in_double;
    extent.centre = element.shape.body().bvh().centre();
    extent.half = (report.upper - extent.centre).cwiseMax(extent.centre - report.lower);
    extent.radius = element.shape.body().vertex_radius();
    extent.size = norm1(extent.place.translation) + extent.centre.lpNorm<1>() + extent.half.lpNorm<1>();
    return extent;
}

scene::Box box_of(const Polyhedron& shape, const scene::WorldMotion& motion) {
    return scene::swept({shape.body(), *motion.frame, true}, 0).box;
}

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
    [[nodiscard]] motion::SharedFrame frame_of(const Element& element) const;
    [[nodiscard]] const Polyhedron& fixed_shape(const Task& task) const;
    [[nodiscard]] std::size_t moving_element(const Task& task) const;
    [[nodiscard]] RobotPair name_of(const Task& task) const;

    const Prepared& prepared_;
    SegmentMotion motion_;
    Bracket of_scene_;
    std::size_t pairs_ = 0;
    Work work_;
};

std::size_t SegmentSearch::moving_element(const Task& task) const {
    return task.kind == Task::Kind::self ? prepared_.self_pairs[task.first].moving : task.first;
}

const Polyhedron& SegmentSearch::fixed_shape(const Task& task) const {
    switch (task.kind) {
    case Task::Kind::self:
        return prepared_.model().elements[prepared_.self_pairs[task.first].fixed].shape;
    case Task::Kind::obstacle:
        return prepared_.bodies[prepared_.obstacles[task.second].body].shape;
    default:
        return prepared_.bodies[prepared_.movers[task.second]].shape;
    }
}

RobotPair SegmentSearch::name_of(const Task& task) const {
    const Model& model = prepared_.model();
    const Element& first = model.elements[moving_element(task)];
    RobotPair pair;
    pair.first = model.owners[first.owner].name;
    pair.first_shape = first.shape_index;
    if (task.kind == Task::Kind::self) {
        const Element& second = model.elements[prepared_.self_pairs[task.first].fixed];
        pair.second = model.owners[second.owner].name;
        pair.second_shape = second.shape_index;
        return pair;
    }
    pair.is_with_scene = true;
    const bool is_mover = task.kind == Task::Kind::mover;
    const std::size_t body = is_mover ? prepared_.movers[task.second] : prepared_.obstacles[task.second].body;
    pair.second = prepared_.bodies[body].name;
    return pair;
}

motion::SharedFrame SegmentSearch::frame_of(const Element& element) const {
    return motion::chain_frame(prepared_.model().chain(motion_, element.group, element.place));
}

/// The moving element as seen from the fixed body, by the joints between them alone, and both in the world.
motion::SmoothMotion SegmentSearch::motion_of(const Task& task) const {
    const Model& model = prepared_.model();
    const Element& moving = model.elements[moving_element(task)];
    const auto part = [&](const motion::SharedFrame& frame) {
        return task.part.lower == 0 && task.part.upper == 1 ? frame : motion::part_frame(frame, task.part);
    };
    const motion::SharedFrame of_moving = frame_of(moving);
    switch (task.kind) {
    case Task::Kind::self: {
        const Element& fixed = model.elements[prepared_.self_pairs[task.first].fixed];
        return {part(motion::chain_frame(model.chain_between(motion_, fixed, moving))), part(of_moving),
                part(frame_of(fixed))};
    }
    case Task::Kind::obstacle: {
        const motion::FixedPose& pose = prepared_.obstacles[task.second].pose;
        motion::Chain chain;
        chain.add(pose.inverse());
        model.add_chain(chain, motion_, moving.group, moving.place);
        motion::Chain at_rest;
        at_rest.add(pose);
        return {part(motion::chain_frame(std::move(chain))), part(of_moving), motion::chain_frame(std::move(at_rest))};
    }
    default: {
        const motion::SharedFrame whole = prepared_.motions[prepared_.movers[task.second]]->frame;
        const motion::SharedFrame fixed =
            of_scene_.lower == 0 && of_scene_.upper == 1 ? whole : motion::part_frame(whole, of_scene_);
        return {motion::relative_frame(of_moving, fixed), of_moving, fixed};
    }
    }
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
    FirstContact found = query::answer({prepared_.model().elements[moving_element(task)].shape.body(),
                                        fixed_shape(task).body(), trajectory, options, local_until});
    if (found.verdict == Verdict::clear)
        return found;
    found.clear_until = in_segment({found.clear_until, found.clear_until}, task.part).lower;
    found.time = in_segment(found.time, task.part);
    found.tau = found.time;
    for (Contact& contact : found.contacts)
        contact.approach_speed /= duration;
    if (found.verdict == Verdict::contact_at_start && task.part.lower > 0)
        found.verdict = Verdict::contact; // it was clear before
    return found;
}

std::optional<SegmentSearch::Found> SegmentSearch::run() {
    const std::vector<Task> tasks = near_tasks(prepared_, motion_);
    std::optional<Found> first;
    double best = 1;
    for (const Task& task : tasks) {
        if (first && task.part.lower > best)
            break;
        ++pairs_;
        FirstContact contact = ask(task, best, prepared_.options.find);
        work_ += contact.work;
        if (contact.verdict == Verdict::clear)
            continue;
        if (!first || std::pair(contact.time.lower, contact.time.upper) <
                          std::pair(first->contact.time.lower, first->contact.time.upper))
            first = Found{name_of(task), std::move(contact)};
        if (prepared_.options.find == Find::any)
            break;
        best = std::min(best, first->contact.time.upper);
    }
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

RobotChecker::Prepared::Prepared(const Robot& given, const Scene* scene, const RobotQuery& query)
    : robot(given), options(query.options) {
    query::check_options(options);
    query::require(!options.hold, "hold", "is not supported for robots");
    const Model& m = model();
    for (const Element& element : m.elements)
        extents.push_back(extent_of(element));
    for (std::size_t i = 0; i < m.elements.size(); ++i)
        for (std::size_t j = i + 1; j < m.elements.size(); ++j) {
            const Element &a = m.elements[i], &b = m.elements[j];
            const auto owners = std::minmax(a.owner, b.owner);
            if (a.group == b.group || m.ignored.contains(owners))
                continue;
            const auto margin = m.margins.find(owners);
            const bool second_moves = m.groups[b.group].depth >= m.groups[a.group].depth;
            self_pairs.push_back({second_moves ? j : i, second_moves ? i : j,
                                  margin == m.margins.end() ? options.margin : margin->second});
        }
    if (!scene)
        return;
    bodies.assign(scene->bodies().begin(), scene->bodies().end());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        motions.push_back(std::make_shared<const scene::WorldMotion>(scene->motion_of(i)));
        if (motions[i]->rests && motions[i]->frame->is_refined())
            obstacles.push_back(
                {i, motion::FixedPose(pose_of<algebra::DoubleDouble>(*motions[i]->frame, algebra::DoubleDouble(0.0))),
                 box_of(bodies[i].shape, *motions[i])});
        else
            movers.push_back(i);
    }
    if (obstacles.size() > few_obstacles) {
        std::vector<scene::SweptBody> boxes;
        for (const Obstacle& obstacle : obstacles)
            boxes.push_back({obstacle.box, {}});
        tree.emplace(boxes);
    }
}

bool RobotChecker::Prepared::is_ignored(std::size_t element, std::size_t body) const {
    const Model& m = model();
    return !m.ignored_in_scene.empty() &&
           m.ignored_in_scene.contains({m.owners[m.elements[element].owner].name, bodies[body].name});
}

RobotChecker::RobotChecker(const Robot& robot, const Scene* scene, const RobotQuery& query)
    : prepared_(std::make_unique<const Prepared>(robot, scene, query)) {}
RobotChecker::~RobotChecker() = default;
RobotChecker::RobotChecker(RobotChecker&&) noexcept = default;
RobotChecker& RobotChecker::operator=(RobotChecker&&) noexcept = default;

const Robot& RobotChecker::robot() const {
    return prepared_->robot;
}

RobotAnswer RobotChecker::first_contact(const JointPath& path) const {
    RobotAnswer answer;
    const std::vector<JointPath::Segment>& segments = path.segments();
    const double begin = segments.front().begin, whole = segments.back().end - begin;
    const auto in_scene = [&](double stamp) { return std::clamp((stamp - begin) / whole, 0.0, 1.0); };
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const JointPath::Segment& segment = segments[i];
        SegmentSearch search(*prepared_, segment, {in_scene(segment.begin), in_scene(segment.end)});
        auto found = search.run();
        answer.pairs += search.pairs();
        answer.work += search.work();
        answer.segment = i;
        if (!found)
            continue;
        FirstContact& contact = found->contact;
        answer.verdict = contact.verdict == Verdict::contact_at_start && i > 0 ? Verdict::contact : contact.verdict;
        answer.time = stamps_of(segment, contact.time);
        answer.certain = contact.certain;
        answer.pair = std::move(found->pair);
        answer.clear_until = stamps_of(segment, {contact.clear_until, contact.clear_until}).lower;
        answer.configuration = path.at(answer.time.lower);
        answer.clear_configuration = path.at(answer.clear_until);
        answer.contact = std::move(contact);
        return answer;
    }
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
    std::vector<RobotAnswer> answers(std::size_t(starts.rows()));
    std::vector<JointPath> paths; // made before the threads start, so that an error has the number of its row
    for (Eigen::Index i = 0; i < starts.rows(); ++i) {
        const std::array<Configuration, 2> ends{starts.row(i), goals.row(i)};
        try {
            paths.push_back(JointPath::straight(prepared_->robot, ends));
        } catch (const InvalidInput& error) {
            throw InvalidInput("edge " + std::to_string(i) + ": " + error.what());
        }
    }
    parallel_for(threads, answers.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            answers[i] = first_contact(paths[i]);
    });
    return answers;
}

} // namespace chasles
