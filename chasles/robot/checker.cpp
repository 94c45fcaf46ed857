// Asks the pairs of a robot and its world that come near each other, in order of time.
// Source: docs/derivations/29-robots.md, "Answers".
#include "chasles/base/invalid_input.h"
#include "chasles/base/limit_of_thread.h"
#include "chasles/base/parallel_for.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"
#include "chasles/robot/handovers.h"
#include "chasles/robot/segment_pairs.h"

#include <algorithm>

namespace chasles {

using robot::SegmentPairs;
using robot::Task;

namespace {

using Prepared = RobotChecker::Prepared;

/// One segment of a path.
class SegmentSearch {
public:
    SegmentSearch(const Prepared& prepared, const JointPath& path, std::size_t segment)
        : prepared_(prepared), segment_(prepared, path, segment) {}

    struct Found {
        RobotPair pair;
        FirstContact contact; ///< with times of the segment
    };
    /// The first contact, or some contact with Find::any; null if the segment is clear.
    std::optional<Found> run();
    /// While `run` goes on: nothing touches before, in the time of the segment.
    [[nodiscard]] double clear_until() const { return clear_until_; }
    [[nodiscard]] bool is_clear() const;
    /// Those in contact at the start of the segment.
    [[nodiscard]] std::vector<RobotPair> pairs_at_start() const;

    [[nodiscard]] std::size_t pairs() const { return pairs_; }
    [[nodiscard]] const Work& work() const { return work_; }

private:
    [[nodiscard]] FirstContact ask(const Task& task, double until, Find find) const;

    const Prepared& prepared_;
    SegmentPairs segment_;
    std::size_t pairs_ = 0;
    double clear_until_ = 0;
    Work work_;
};

/// The answer for a part of a segment, in the time of the segment.
void count_in_segment(FirstContact& found, const Bracket& part) {
    found.clear_until = robot::in_segment({found.clear_until, found.clear_until}, part).lower;
    found.time = robot::in_segment(found.time, part);
    found.tau = found.time;
    robot::slow_down(found.contacts, part);
    robot::slow_down(found.held, part);
    if (found.verdict == Verdict::contact_at_start && part.lower > 0)
        found.verdict = Verdict::contact; // it was clear before
}

FirstContact SegmentSearch::ask(const Task& task, double until, Find find) const {
    const double duration = task.part.upper - task.part.lower;
    QueryOptions options = prepared_.options_of(task);
    options.find = find;
    options.time_tolerance = std::clamp(options.time_tolerance / duration, 1e-15, 1.0);
    const auto trajectory = segment_.trajectory(task);
    const double local_until = std::clamp((until - task.part.lower) / duration * (1 + 1e-12), 0.0, 1.0);
    FirstContact found = segment_.naming(task, [&] {
        return query::answer({prepared_.moving(task).shape.body(), prepared_.fixed_shape(task).body(), trajectory,
                              options, local_until});
    });
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
    for (const Task& task : robot::tasks_of(segment_)) {
        if (first && (finds_any || task.part.lower > best)) {
            clear_until = std::min(clear_until, task.part.lower); // it is not asked
            break;
        }
        ++pairs_;
        clear_until_ = std::min(clear_until, task.part.lower);
        FirstContact contact = ask(task, best, prepared_.options.find);
        work_ += contact.work;
        if (contact.verdict == Verdict::clear)
            continue;
        clear_until = std::min(clear_until, contact.clear_until);
        if (!first || is_earlier(contact, first->contact))
            first = Found{segment_.name_of(task), std::move(contact)};
        best = std::min(best, first->contact.time.upper);
    }
    if (first)
        first->contact.clear_until = std::min(clear_until, best); // others were asked about no later time
    return first;
}

/// The earliest contact is not needed: a pair whose path is not proven clear ends the question.
bool SegmentSearch::is_clear() const {
    return std::ranges::all_of(robot::tasks_of(segment_),
                               [&](const Task& task) { return ask(task, 1, Find::any).verdict == Verdict::clear; });
}

std::vector<RobotPair> SegmentSearch::pairs_at_start() const {
    std::vector<RobotPair> pairs;
    for (const Task& task : robot::tasks_of(segment_)) {
        const RobotPair pair = segment_.name_of(task);
        const auto is_same = [&](const RobotPair& other) {
            return other.first == pair.first && other.second == pair.second;
        };
        if (task.part.lower <= 0 && std::ranges::none_of(pairs, is_same) &&
            ask(task, 0, Find::any).verdict != Verdict::clear)
            pairs.push_back(pair);
    }
    return pairs;
}

} // namespace

RobotChecker::RobotChecker(const Robot& robot, const Scene* scene, const RobotQuery& query)
    : prepared_(std::make_shared<const Prepared>(robot, scene, query)) {}
RobotChecker::~RobotChecker() = default;
RobotChecker::RobotChecker(const RobotChecker&) = default;
RobotChecker& RobotChecker::operator=(const RobotChecker&) = default;
RobotChecker::RobotChecker(RobotChecker&&) noexcept = default;
RobotChecker& RobotChecker::operator=(RobotChecker&&) noexcept = default;

const Robot& RobotChecker::robot() const {
    return prepared_->robot;
}

const UntestedPairs& RobotChecker::untested() const {
    return *prepared_->untested;
}

namespace {

/// Adds the contact of a segment to an answer.
void set_contact(RobotAnswer& answer, const JointPath& path, SegmentSearch::Found found) {
    const JointPath::Segment& segment = path.segments()[answer.segment];
    FirstContact& contact = found.contact;
    const bool is_later = answer.segment > 0 && contact.verdict == Verdict::contact_at_start;
    answer.verdict = is_later ? Verdict::contact : contact.verdict;
    answer.time = robot::stamps_of(segment, contact.time);
    answer.certain = contact.certain;
    answer.pair = std::move(found.pair);
    answer.clear_until = robot::stamps_of(segment, {contact.clear_until, contact.clear_until}).lower;
    answer.configuration = path.at(answer.time.lower);
    answer.clear_configuration = path.at(answer.clear_until);
    answer.contact = std::move(contact);
}

/// Cancelled in a segment, at this time of it.
void set_unknown(RobotAnswer& answer, const JointPath& path, double clear_until) {
    answer.clear_until = robot::stamps_of(path.segments()[answer.segment], {clear_until, clear_until}).lower;
    answer.time = {answer.clear_until, answer.clear_until};
    answer.contact.clear_until = clear_until;
    answer.contact.time = {clear_until, clear_until};
    answer.configuration = answer.clear_configuration = path.at(answer.clear_until);
}

} // namespace

RobotAnswer RobotChecker::first_contact(const JointPath& path, std::span<const Handover> handovers) const {
    const robot::Stretches stretches(*prepared_, path, handovers);
    RobotAnswer answer;
    answer.untested = stretches.untested();
    const std::vector<JointPath::Segment>& segments = path.segments();
    for (answer.segment = 0; answer.segment < segments.size(); ++answer.segment) {
        SegmentSearch search(stretches.at(answer.segment), path, answer.segment);
        std::optional<SegmentSearch::Found> found;
        try {
            if (answer.segment > 0) // one that is far apart is answered without a look at the limit
                throw_if_cancelled();
            found = search.run();
        } catch (const Cancelled&) {
            set_unknown(answer, path, search.clear_until());
            return answer;
        }
        answer.pairs += search.pairs();
        answer.work += search.work();
        if (found) {
            set_contact(answer, path, std::move(*found));
            return answer;
        }
    }
    --answer.segment;
    answer.verdict = Verdict::clear;
    answer.certain = true;
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
    return SegmentSearch(*prepared_, path, 0).is_clear();
}

bool RobotChecker::is_clear(const Configuration& configuration) const {
    return is_clear(configuration, configuration);
}

std::vector<RobotPair> RobotChecker::pairs_in_contact(const Configuration& configuration) const {
    const std::array at_rest{configuration, configuration};
    const JointPath path = JointPath::straight(prepared_->robot, at_rest);
    return SegmentSearch(*prepared_, path, 0).pairs_at_start();
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
        for (std::size_t i = begin; i < end && !is_cancelled(); ++i)
            answers[i] = first_contact(paths[i]);
    });
    return answers;
}

} // namespace chasles
