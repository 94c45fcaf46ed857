// A queue of pairs by the time before which they are proven apart. The first pair whose contact is known and before
// which no other pair may touch makes the event. Source: docs/derivations/28-stepping.md.
#include "chasles/scene/stepper.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/base/parallel_for.h"
#include "chasles/base/sort.h"
#include "chasles/scene/pair_question.h"
#include "chasles/scene/pair_tasks.h"
#include "chasles/scene/prospect.h"
#include "chasles/scene/step_margins.h"

#include <algorithm>
#include <set>

namespace chasles {

namespace {

using scene::IndexPair;
using scene::Prospect;
using scene::Prospects;
using scene::WorldMotion;

/// Bodies nearer than this share of the margin have no way to go on.
constexpr double least_level = 0x1p-20;
/// A level is used for bodies that are farther apart than this times the level.
constexpr double above_level = 1.001;
/// Contacts after this share of the rest of the step are no matter of rounding.
constexpr double soon = 0.01;

} // namespace

class Stepper::Implementation {
public:
    Implementation(const Scene& scene, const StepOptions& options);

    std::optional<StepEvent> advance();
    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] Pose pose(std::size_t index) const;
    void move(std::size_t index, const Motion& rest);

private:
    /// How a body moves from a time of the step on.
    struct Course {
        WorldMotion motion;
        double since = 0;
        std::uint32_t changes = 0;   ///< so often has it changed
        scene::SweptBody swept = {}; ///< from then until the end of the step; the box is wide enough for the margin

        /// A time of the step, as a share of the time from `since` to the end.
        [[nodiscard]] double share_at(double time) const { return (time - since) / (1 - since); }
    };

    [[nodiscard]] const std::string& name(std::size_t index) const { return scene_.bodies()[index].name; }
    [[nodiscard]] WorldMotion rest(std::size_t index, double from) const;
    [[nodiscard]] FirstContact ask(const IndexPair& pair, double from, const QueryOptions& options,
                                   double until = 1) const;
    [[nodiscard]] bool are_within(double distance, const IndexPair& pair, double time) const;
    [[nodiscard]] Prospect asked(Prospect prospect) const;
    [[nodiscard]] bool is_valid(const Prospect& prospect) const;
    void drop_invalid(Prospects& queue) const;

    void foresee(const IndexPair& pair, double earliest);
    void foresee_neighbours(std::uint32_t index);
    void foresee_changes();
    void ask_all(std::vector<Prospect>& batch);
    void ask_what_may_be_first();
    [[nodiscard]] std::vector<IndexPair> take_first_contacts();
    void sort_by_names(std::vector<IndexPair>& pairs) const;
    [[nodiscard]] scene::MovingBall ball_now(std::uint32_t index) const;
    [[nodiscard]] SceneContact contact_set(const IndexPair& pair) const;
    [[nodiscard]] std::vector<SceneContact> contact_sets(const std::vector<IndexPair>& pairs) const;
    [[nodiscard]] std::vector<SceneContact> connected_with(const std::vector<IndexPair>& pairs) const;

    const Scene& scene_;
    StepOptions options_;
    scene::StepMargins margins_;
    double time_ = 0;
    std::vector<Course> courses_;
    scene::BoxTree tree_;
    Prospects unasked_;
    Prospects contacts_;
    std::vector<std::uint32_t> changed_; ///< bodies since the last event
    std::vector<IndexPair> last_;        ///< pairs of the last event
};

Stepper::Implementation::Implementation(const Scene& scene, const StepOptions& options)
    : scene_(scene), options_(options), margins_(scene, options), tree_({}) {
    const SceneQuery query{.options = {.margin = options.margin}, .threads = options.threads};
    const std::vector<scene::SweptBody> swept = scene::swept_bodies(scene, query);
    for (std::size_t i = 0; i < swept.size(); ++i)
        courses_.push_back({.motion = scene.motion_of(i), .swept = swept[i]});
    tree_ = scene::BoxTree(swept, options.threads);
    for (const scene::PairTask& task : scene::near_pairs(scene, query, swept, tree_))
        foresee(task.pair, task.earliest);
}

WorldMotion Stepper::Implementation::rest(std::size_t index, double from) const {
    constexpr double latest = 0x1.fffffffffffffp-1; // just before the end, to which a share may be rounded
    const Course& course = courses_[index];
    return scene::rest_of(course.motion, std::min(latest, course.share_at(from)));
}

FirstContact Stepper::Implementation::ask(const IndexPair& pair, double from, const QueryOptions& options,
                                          double until) const {
    const WorldMotion moving = rest(pair.first, from), fixed = rest(pair.second, from);
    const SceneBody &a = scene_.bodies()[pair.first], &b = scene_.bodies()[pair.second];
    return scene::first_contact_of({a.name, a.shape, moving}, {b.name, b.shape, fixed}, options, until);
}

/// With the time of the first contact, at the margin or at the first half, quarter, and so on of it that is less than
/// the distance now; later than 1 if there is none.
Prospect Stepper::Implementation::asked(Prospect prospect) const {
    const double margin = margins_.of(prospect.pair);
    QueryOptions options{.margin = margin, .time_tolerance = options_.time_tolerance};
    for (; options.margin >= least_level * margin; options.margin /= 2) {
        const FirstContact found = ask(prospect.pair, prospect.from, options);
        if (found.verdict == Verdict::clear) {
            prospect.time = {2, 2};
            return prospect;
        }
        // After an event the distance is the level up to rounding. A contact there would be no step forward.
        const bool is_soon = found.time.lower < soon;
        if (found.verdict == Verdict::contact_at_start ||
            (is_soon && are_within(above_level * options.margin, prospect.pair, prospect.from)))
            continue;
        const auto in_step = [&](double time) { return prospect.from + time * (1 - prospect.from); };
        prospect.time = {in_step(found.time.lower), in_step(found.time.upper)};
        return prospect;
    }
    const bool is_nested = ask(prospect.pair, prospect.from, {}).inside.has_value();
    scene::refuse(name(prospect.pair.first) + " on " + name(prospect.pair.second),
                  "at time " + std::to_string(prospect.from) +
                      (is_nested ? " one of them is inside of the other one"
                                 : " they are nearer than a millionth of the margin, and cannot go on"));
}

bool Stepper::Implementation::is_valid(const Prospect& prospect) const {
    return courses_[prospect.pair.first].changes == prospect.changes.first &&
           courses_[prospect.pair.second].changes == prospect.changes.second;
}

void Stepper::Implementation::drop_invalid(Prospects& queue) const {
    while (!queue.empty() && !is_valid(queue.top()))
        queue.pop();
}

/// Two bodies that both stand still stay as they are, even where they touch.
void Stepper::Implementation::foresee(const IndexPair& pair, double earliest) {
    if (courses_[pair.first].motion.rests && courses_[pair.second].motion.rests)
        return;
    const IndexPair changes{courses_[pair.first].changes, courses_[pair.second].changes};
    unasked_.push({{earliest, earliest}, pair, time_, changes});
}

/// From now on.
scene::MovingBall Stepper::Implementation::ball_now(std::uint32_t index) const {
    const Course& course = courses_[index];
    return rest_of(course.swept.ball, course.share_at(time_));
}

/// The pairs of a body whose course has changed. Where both have changed, the pair is that of the first one.
void Stepper::Implementation::foresee_neighbours(std::uint32_t index) {
    for (const std::uint32_t other : tree_.overlapping(courses_[index].swept.box)) {
        const bool is_done = other == index || (other < index && std::ranges::binary_search(changed_, other));
        if (is_done || scene_.is_ignored(index, other))
            continue;
        const double share = scene::earliest_meeting(ball_now(index), ball_now(other), margins_.of({index, other}));
        if (share <= 1)
            foresee(scene::in_their_roles(scene_, {index, other}), time_ + share * (1 - time_));
    }
}

void Stepper::Implementation::foresee_changes() {
    sort_unique(changed_);
    for (const std::uint32_t index : changed_)
        foresee_neighbours(index);
    const auto is_changed = [&](std::uint32_t index) { return std::ranges::binary_search(changed_, index); };
    for (const IndexPair& pair : last_)
        if (!is_changed(pair.first) && !is_changed(pair.second))
            foresee(pair, time_);
    changed_.clear();
    last_.clear();
}

/// Where an answer fails, all of them are asked again by the next step.
void Stepper::Implementation::ask_all(std::vector<Prospect>& batch) {
    try {
        parallel_for(options_.threads, batch.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                batch[i] = asked(batch[i]);
        });
    } catch (...) {
        for (const Prospect& prospect : batch)
            unasked_.push(prospect);
        throw;
    }
}

/// Until no pair that was not asked may touch before the first contact ends.
void Stepper::Implementation::ask_what_may_be_first() {
    constexpr std::size_t most = 16; // at once, for any number of threads
    for (;;) {
        drop_invalid(contacts_);
        const double end = contacts_.empty() ? 1 : contacts_.top().time.upper;
        std::vector<Prospect> batch;
        for (; batch.size() < most && !unasked_.empty() && unasked_.top().time.lower <= end; unasked_.pop())
            if (is_valid(unasked_.top()))
                batch.push_back(unasked_.top());
        if (batch.empty())
            return;
        ask_all(batch);
        for (const Prospect& prospect : batch)
            if (prospect.time.lower < 1)
                contacts_.push(prospect);
    }
}

/// All that may be at the same time as the first contact, in the order of their names.
std::vector<IndexPair> Stepper::Implementation::take_first_contacts() {
    std::vector<IndexPair> pairs;
    const Bracket first = contacts_.top().time;
    time_ = std::max(time_, first.lower);
    for (; !contacts_.empty() && contacts_.top().time.lower <= first.upper; contacts_.pop())
        if (is_valid(contacts_.top()))
            pairs.push_back(contacts_.top().pair);
    sort_by_names(pairs);
    return pairs;
}

void Stepper::Implementation::sort_by_names(std::vector<IndexPair>& pairs) const {
    chasles::sort(pairs, {}, [&](const IndexPair& pair) { return scene::names_of(scene_, pair); });
}

/// All contacts within the reach, now.
SceneContact Stepper::Implementation::contact_set(const IndexPair& pair) const {
    const QueryOptions options{.margin = margins_.reach_of(pair),
                               .time_tolerance = options_.time_tolerance,
                               .find = Find::first_with_all_contacts};
    SceneContact set{pair.first, pair.second, ask(pair, time_, options)};
    if (set.contact.verdict != Verdict::contact_at_start) // by rounding
        set.contact.contacts.clear();
    set.contact.verdict = Verdict::contact;
    set.contact.time = {time_, time_};
    for (Contact& contact : set.contact.contacts)
        contact.approach_speed /= 1 - time_;
    return set;
}

std::vector<SceneContact> Stepper::Implementation::contact_sets(const std::vector<IndexPair>& pairs) const {
    std::vector<SceneContact> sets;
    sets.reserve(pairs.size());
    for (const IndexPair& pair : pairs)
        sets.push_back(contact_set(pair));
    return sets;
}

/// From body to body, as long as they move.
std::vector<SceneContact> Stepper::Implementation::connected_with(const std::vector<IndexPair>& pairs) const {
    std::set<IndexPair> known(pairs.begin(), pairs.end());
    std::vector<std::uint32_t> bodies;
    for (const auto& [moving, fixed] : pairs)
        bodies.insert(bodies.end(), {moving, fixed});
    std::vector<IndexPair> found;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const std::uint32_t index = bodies[i];
        if (courses_[index].motion.rests)
            continue;
        for (const std::uint32_t other :
             tree_.overlapping(scene::widened(courses_[index].swept.box, margins_.largest_reach()))) {
            const IndexPair pair = scene::in_their_roles(scene_, {index, other});
            const double reach = margins_.reach_of(pair);
            const bool are_near = other != index && !scene_.is_ignored(index, other) &&
                                  scene::earliest_meeting(ball_now(index), ball_now(other), reach) == 0;
            if (are_near && known.insert(pair).second && are_within(reach, pair, time_)) {
                found.push_back(pair);
                bodies.push_back(other);
            }
        }
    }
    sort_by_names(found);
    return contact_sets(found);
}

bool Stepper::Implementation::are_within(double distance, const IndexPair& pair, double time) const {
    const QueryOptions options{.margin = distance, .time_tolerance = options_.time_tolerance, .find = Find::any};
    return ask(pair, time, options, 0).verdict == Verdict::contact_at_start;
}

std::optional<StepEvent> Stepper::Implementation::advance() {
    foresee_changes();
    ask_what_may_be_first();
    if (contacts_.empty()) {
        time_ = 1;
        return std::nullopt;
    }
    last_ = take_first_contacts();
    const LimitOfThread without(nullptr); // what is left takes little time, and the contacts are taken
    return StepEvent{time_, contact_sets(last_), connected_with(last_)};
}

Pose Stepper::Implementation::pose(std::size_t index) const {
    scene::require_body(scene_, index);
    return courses_[index].motion.motion.pose_at(courses_[index].share_at(time_));
}

void Stepper::Implementation::move(std::size_t index, const Motion& rest) {
    scene::require_body(scene_, index);
    if (time_ >= 1)
        scene::refuse(name(index), "move: the step is over");
    WorldMotion motion = scene::world_motion(rest, name(index));
    const Body& body = scene_.bodies()[index].shape.body();
    const Eigen::Isometry3d now = pose(index).isometry(), start = rest.pose_at(0).isometry();
    const Eigen::Vector3d centre = body.bvh().centre();
    const double away =
        (now * centre - start * centre).norm() + (now.linear() - start.linear()).norm() * body.ball_radius();
    if (!(away <= 1e-3 * margins_.least()))
        scene::refuse(name(index), "move: the motion starts " + std::to_string(away) + " away from where the body is");
    Course& course = courses_[index];
    course = {std::move(motion), time_, course.changes + 1};
    course.swept = scene::swept({body, *course.motion.frame, course.motion.rests}, 1);
    course.swept.box = scene::widened(course.swept.box, margins_.largest());
    tree_.replace(std::uint32_t(index), course.swept.box);
    changed_.push_back(std::uint32_t(index));
}

Stepper::Stepper(const Scene& scene, const StepOptions& options)
    : implementation_(std::make_unique<Implementation>(scene, options)) {}
Stepper::~Stepper() = default;
Stepper::Stepper(Stepper&& other) noexcept = default;
Stepper& Stepper::operator=(Stepper&& other) noexcept = default;

std::optional<StepEvent> Stepper::advance() {
    return implementation_->advance();
}

double Stepper::time() const {
    return implementation_->time();
}

Pose Stepper::pose(std::size_t index) const {
    return implementation_->pose(index);
}

void Stepper::move(std::size_t index, const Motion& rest) {
    implementation_->move(index, rest);
}

} // namespace chasles
