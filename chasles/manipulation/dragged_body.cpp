#include "chasles/manipulation/dragged_body.h"

#include "chasles/base/sort.h"
#include "chasles/manipulation/checked_options.h"
#include "chasles/manipulation/hand_force.h"
#include "chasles/manipulation/stride.h"
#include "chasles/manipulation/surroundings.h"
#include "chasles/query/pair_query.h"
#include "chasles/scene/pair_question.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <tuple>

namespace chasles {

using manipulation::Distances;
using manipulation::ModelledContact;
using manipulation::Neighbourhood;
using manipulation::Other;
using manipulation::Passage;
using manipulation::Slide;
using manipulation::SlideKind;
using manipulation::SlideProblem;
using manipulation::Stride;

namespace {

constexpr double listed_within = 2;    // margins: the contacts that a step lists at most
constexpr double least_step = 0x1p-10; // margins: a body that has no more to go rests
/// Likewise after the first round of an update. What is left is for the next update: it is not worth a round.
constexpr double least_further_step = 0x1p-3;

/// The longest way of a corner of the body's box from one pose to another one.
double longest_way(const MeshReport& box, const Pose& from, const Pose& to) {
    double longest = 0;
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d corner((i & 1 ? box.upper : box.lower).x(), (i & 2 ? box.upper : box.lower).y(),
                                     (i & 4 ? box.upper : box.lower).z());
        longest = std::max(longest, (to.isometry() * corner - from.isometry() * corner).norm());
    }
    return longest;
}

bool is_equal(const Pose& a, const Pose& b) {
    return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

/// The body and the features by which a contact is known from update to update.
auto identity(const DragContact& contact) {
    return std::tuple(contact.body, contact.contact.kind, contact.contact.moving, contact.contact.fixed);
}

/// Appends an event for each contact that is not among the others.
void append_events(std::vector<DragEvent>& events, const std::vector<DragContact>& contacts,
                   const std::vector<DragContact>& others, bool begins) {
    std::vector<decltype(identity(others.front()))> known;
    std::ranges::transform(others, std::back_inserter(known), identity);
    chasles::sort(known);
    for (const DragContact& contact : contacts)
        if (!std::ranges::binary_search(known, identity(contact)))
            events.push_back({begins, contact.body, contact.contact});
}

/// A bound of time for the rounds of an update.
class Deadline {
public:
    explicit Deadline(double seconds) : seconds_(seconds) {}
    [[nodiscard]] bool is_over() const {
        return seconds_ > 0 && std::chrono::duration<double>(Clock::now() - start_).count() > seconds_;
    }

private:
    using Clock = std::chrono::steady_clock;
    double seconds_;
    Clock::time_point start_ = Clock::now();
};

} // namespace

class DraggedBody::Implementation {
public:
    Implementation(Scene& scene, const std::string& name, const DragOptions& options);

    DragStep update(const Pose& goal, double seconds);
    [[nodiscard]] DragForce force(const Pose& wanted) const;
    [[nodiscard]] const Pose& pose() const { return pose_; }
    [[nodiscard]] const Distances& distances() const { return distances_; }

private:
    [[nodiscard]] Pose checked(const Pose& wanted) const;
    void grip();
    void look_around(DragStep& step);
    void meet(const Other& other, DragStep& step) const;
    void read_scene(DragStep& step);
    bool take_from_scene();
    void renumber_contacts();
    struct Way {
        Pose end;
        Passage passage; ///< on the screw to the end
    };
    Way search(const Slide& slide, bool is_urgent, DragStep& step);
    bool go(const Slide& slide, bool is_urgent, DragStep& step);
    [[nodiscard]] DragState go_on(const Pose& goal, double seconds, DragStep& step);
    void report(const Pose& goal, DragStep& step);

    Scene& scene_;
    std::string name_;
    Polyhedron shape_;
    DragOptions options_;
    Distances distances_;
    manipulation::HandSpring spring_;
    double size_;
    Motion placed_; ///< that the scene has of the body, unless somebody else moved it
    Pose pose_;
    manipulation::Lock lock_;
    manipulation::SharedGrip grip_; ///< for the forces that other threads ask for
    manipulation::Stride stride_;
    manipulation::Surroundings surroundings_;
    Neighbourhood near_;                        ///< at the pose
    std::vector<DragContact> contacts_;         ///< of the last update
    std::vector<std::string> contact_partners_; ///< the names of their other bodies
};

DraggedBody::Implementation::Implementation(Scene& scene, const std::string& name, const DragOptions& options)
    : scene_(scene), name_(name), shape_(scene.bodies()[scene.index_of(name)].shape), options_(options),
      distances_(manipulation::distances_of(options, shape_)), spring_(manipulation::mass_of(options, shape_)),
      size_(manipulation::diagonal(shape_)), placed_(scene.bodies()[scene.index_of(name)].motion),
      pose_(placed_.pose_at(1)), lock_(options.lock, pose_), stride_(distances_.margin), surroundings_(distances_) {
    manipulation::check_rounding(distances_, shape_, pose_);
    manipulation::prepare(shape_.body());
    DragStep step;
    surroundings_.refresh(scene_, scene_.index_of(name_));
    look_around(step);
    grip();
}

/// Keeps what the forces on the hand depend on.
void DraggedBody::Implementation::grip() {
    grip_.replace(std::make_shared<manipulation::Grip>(manipulation::Grip{
        spring_, lock_, distances_.margin, options_.friction, options_.stiffness, pose_, near_.contacts}));
}

void DraggedBody::Implementation::look_around(DragStep& step) {
    near_ = surroundings_.near(shape_.body(), pose_);
    step.work += near_.work;
}

/// The motion of another body, while this one stood still.
void DraggedBody::Implementation::meet(const Other& other, DragStep& step) const {
    const scene::WorldMotion& motion = scene_.motion_of(other.index);
    if (other.is_ignored || motion.rests)
        return; // where it stands is looked at in any case
    const scene::WorldMotion here = scene::world_motion(Motion::at_rest(pose_), name_);
    FirstContact found = scene::first_contact_of({name_, shape_, here}, {other.name, other.shape, motion}, {}, 1);
    step.work += found.work;
    if (found.verdict != Verdict::clear)
        step.intrusions.push_back({other.index, std::move(found)});
}

/// Whether somebody else has moved the body since: another hand, or the program. Then it is where they put it.
bool DraggedBody::Implementation::take_from_scene() {
    const Motion& motion = scene_.bodies()[scene_.index_of(name_)].motion;
    if (&motion.trajectory() == &placed_.trajectory())
        return false;
    const Pose pose = motion.pose_at(1);
    manipulation::check_rounding(distances_, shape_, pose);
    placed_ = motion;
    pose_ = pose;
    lock_ = manipulation::Lock(options_.lock, pose_);
    return true;
}

void DraggedBody::Implementation::read_scene(DragStep& step) {
    const bool is_taken = take_from_scene();
    const auto moved = surroundings_.refresh(scene_, scene_.index_of(name_));
    if (!moved && !is_taken)
        return;
    renumber_contacts();
    if (moved)
        for (const std::size_t place : *moved)
            meet(surroundings_.others()[place], step);
    look_around(step);
}

/// If bodies were removed from the scene, the others may have new indices. Contacts of removed bodies are dropped.
void DraggedBody::Implementation::renumber_contacts() {
    std::vector<DragContact> left;
    std::vector<std::string> partners;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const auto other = std::ranges::find(surroundings_.others(), contact_partners_[i], &Other::name);
        if (other == surroundings_.others().end())
            continue;
        left.push_back(contacts_[i]);
        left.back().body = other->index;
        partners.push_back(other->name);
    }
    contacts_ = std::move(left);
    contact_partners_ = std::move(partners);
}

/// Searches the way to the end of a slide: until the body is blocked, and if time is short, until the search gets long.
DraggedBody::Implementation::Way DraggedBody::Implementation::search(const Slide& slide, bool is_urgent,
                                                                     DragStep& step) {
    const double length = longest_way(shape_.report(), pose_, slide.end);
    std::uint64_t node_pairs = 0;
    for (double share = stride_.first_share(length);; share = Stride::next_share(share)) {
        const Pose end = share < 1 ? lock_.onto(Motion::screw(pose_, slide.end).pose_at(share)) : slide.end;
        const Passage passage = surroundings_.passage(shape_.body(), pose_, end, near_.distances);
        step.work += passage.work;
        node_pairs += passage.work.node_pairs;
        const bool is_blocked = passage.until < 1;
        if (is_blocked || share == 1 || (is_urgent && Stride::is_long(node_pairs))) {
            stride_.learn(passage.until * share * length, is_blocked, node_pairs);
            return {end, passage};
        }
    }
}

/// One certified step. False if nothing could be gone.
bool DraggedBody::Implementation::go(const Slide& slide, bool is_urgent, DragStep& step) {
    const auto& [end, passage] = search(slide, is_urgent, step);
    step.blocking.clear();
    if (passage.blocked_by)
        step.blocking.push_back(*passage.blocked_by);
    if (passage.until <= 0)
        return false;
    const Motion screw = Motion::screw(pose_, end);
    step.pieces.push_back({screw, passage.until, passage.clearance});
    pose_ = passage.until < 1 ? screw.pose_at(passage.until) : end;
    look_around(step);
    return true;
}

DragState DraggedBody::Implementation::go_on(const Pose& goal, double seconds, DragStep& step) {
    const Deadline deadline(seconds);
    const Pose target = lock_.nearest(spring_, goal);
    SlideProblem problem{spring_,           pose_,  goal,   near_.contacts, distances_.margin, size_, 0,
                         options_.friction, &lock_, &target};
    for (int round = 0; round < options_.rounds && !(round > 0 && deadline.is_over()); ++round) {
        if (!near_.touching.empty())
            return DragState::touching;
        if (is_equal(pose_, target))
            return DragState::reached;
        problem.contacts = near_.contacts;
        problem.rest = (round == 0 ? least_step : least_further_step) * distances_.margin;
        const Slide slide = next_slide(problem);
        if (slide.kind == SlideKind::rest || !go(slide, seconds > 0, step))
            return DragState::resting;
    }
    return is_equal(pose_, target) ? DragState::reached : DragState::moving;
}

/// What is in contact at the pose reached, and with which force.
void DraggedBody::Implementation::report(const Pose& goal, DragStep& step) {
    grip();
    const std::shared_ptr<const manipulation::Grip> grip = grip_.get();
    const manipulation::ContactForces pushed = grip->forces_at(goal);
    std::vector<DragContact> contacts;
    for (std::size_t i = 0; i < near_.contacts.size(); ++i) {
        const ModelledContact& near = near_.contacts[i];
        const double force = options_.stiffness * pushed.normal[Eigen::Index(i)];
        if (force > 0)
            step.blocking.push_back(near.body);
        if (near.contact.gap <= listed_within * distances_.margin)
            contacts.push_back(
                {near.body, near.contact, force, options_.stiffness * pushed.friction.col(Eigen::Index(i))});
    }
    sort_unique(step.blocking);
    append_events(step.events, contacts, contacts_, true);
    append_events(step.events, contacts_, contacts, false);
    contacts_ = contacts;
    contact_partners_.clear();
    for (const DragContact& contact : contacts)
        contact_partners_.push_back(scene_.bodies()[contact.body].name);
    step.contacts = std::move(contacts);
    const auto& [force, torque] = grip->on_hand(pushed);
    step.force = force;
    step.torque = torque;
    step.touching = near_.touching;
    step.distance = longest_way(shape_.report(), pose_, goal);
    step.pose = pose_;
}

Pose DraggedBody::Implementation::checked(const Pose& wanted) const {
    Pose goal(wanted.translation, Eigen::Quaterniond(wanted.rotation)); // checks what was filled in by hand
    constexpr bool is_goal = true;
    manipulation::check_rounding(distances_, shape_, goal, is_goal);
    return goal;
}

DragForce DraggedBody::Implementation::force(const Pose& wanted) const {
    const std::shared_ptr<const manipulation::Grip> grip = grip_.get();
    const auto& [force, torque] = grip->on_hand(grip->forces_at(checked(wanted)));
    return {force, torque};
}

DragStep DraggedBody::Implementation::update(const Pose& wanted, double seconds) {
    manipulation::require(seconds >= 0, "seconds", "must not be negative");
    const Pose goal = checked(wanted);
    DragStep step;
    read_scene(step);
    step.state = go_on(goal, seconds, step);
    report(goal, step);
    placed_ = Motion::at_rest(pose_);
    scene_.move(scene_.index_of(name_), placed_);
    return step;
}

DraggedBody::DraggedBody(Scene& scene, const std::string& name, const DragOptions& options)
    : implementation_(std::make_unique<Implementation>(scene, name, options)) {}
DraggedBody::~DraggedBody() = default;
DraggedBody::DraggedBody(DraggedBody&& other) noexcept = default;
DraggedBody& DraggedBody::operator=(DraggedBody&& other) noexcept = default;

DragStep DraggedBody::update(const Pose& goal, double seconds) {
    return implementation_->update(goal, seconds);
}

DragForce DraggedBody::force(const Pose& goal) const {
    return implementation_->force(goal);
}

const Pose& DraggedBody::pose() const {
    return implementation_->pose();
}

double DraggedBody::margin() const {
    return implementation_->distances().margin;
}

double DraggedBody::reach() const {
    return implementation_->distances().reach;
}

} // namespace chasles
