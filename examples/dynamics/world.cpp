#include "examples/dynamics/world.h"

#include <algorithm>
#include <set>

namespace chasles::examples {

using Eigen::Vector3d;

namespace {

/// Shares of speeds.
constexpr double tolerance = 1e-6;
constexpr double fine_tolerance = 1e-15;

const std::string fixed = "fixed"; ///< the group of the bodies that stay

} // namespace

World::World(const WorldOptions& options) : options_(options) {
    scene_.ignore_groups(fixed, fixed);
}

std::size_t World::add(const std::string& name, const Polyhedron& shape, const RigidBody& body) {
    bodies_.push_back(body);
    return scene_.add({name, shape, Motion::at_rest(body.pose), body.moves() ? "" : fixed});
}

double World::kinetic_energy() const {
    double energy = 0;
    for (const RigidBody& body : bodies_)
        energy += body.kinetic_energy();
    return energy;
}

void World::accelerate(double duration) {
    for (RigidBody& body : bodies_)
        if (body.moves())
            body.push(duration * body.mass * options_.gravity, body.centre_in_world());
}

/// The least speed of separation at a gap. Bodies rest at one and a half margins, where they make no events. A larger
/// gap may shrink to that, and a smaller one grows. Otherwise sliding contacts would come nearer in every event, as
/// they do not move on straight lines.
double World::least_speed(double gap, double duration) const {
    return (1.5 * options_.margin - gap) / duration;
}

/// What is within twice the margin at the start.
void World::keep_apart(double duration) {
    SceneQuery query{.until = 0, .threads = options_.threads};
    query.options.margin = 2 * options_.margin;
    query.options.find = Find::first_with_all_contacts;
    std::vector<Touch> touches = touches_of(scene_.all_contacts(query).contacts);
    for (Touch& touch : touches)
        touch.least_speed = least_speed(touch.gap, duration);
    resolve(touches, options_.friction, tolerance, bodies_);
}

/// Contacts at the margin get impulses. Those within twice the margin are kept from meeting.
void World::meet(const StepEvent& event, double duration) {
    if (options_.restitution == 1)
        return meet_elastically(event);
    std::vector<Touch> touches = touches_of(event.contacts);
    for (const Touch& touch : touches_of(event.connected))
        touches.push_back(touch);
    for (Touch& touch : touches) {
        const double approach = -separation_speed(touch, bodies_);
        touch.least_speed = least_speed(touch.gap, duration);
        if (touch.gap <= 1.001 * options_.margin)
            touch.least_speed = std::max(touch.least_speed, options_.restitution * approach);
    }
    resolve(touches, options_.friction, tolerance, bodies_);
}

/// What is nearest leaves as fast as it came.
void World::meet_elastically(const StepEvent& event) {
    std::vector<Touch> touches = touches_of(event.contacts);
    const double nearest = std::ranges::min(touches, {}, &Touch::gap).gap;
    std::erase_if(touches, [&](const Touch& touch) { return touch.gap > 1.001 * nearest; });
    for (Touch& touch : touches)
        touch.least_speed = std::max(0.0, -separation_speed(touch, bodies_));
    resolve(touches, 0, fine_tolerance, bodies_);
}

void World::place_all(const Stepper& stepper) {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].moves())
            bodies_[i].place(stepper.pose(i).isometry());
}

void World::move_all(double duration) {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].moves())
            scene_.move(i, bodies_[i].flight(duration));
}

void World::step(double duration) {
    if (options_.gravity != Vector3d::Zero()) {
        move_all(duration);
        accelerate(duration);
        keep_apart(duration);
    }
    move_all(duration);
    Stepper stepper(scene_, {.margin = options_.margin, .threads = options_.threads});
    const double start = time_;
    while (const auto event = stepper.advance()) {
        place_all(stepper);
        time_ = start + event->time * duration;
        ++events_;
        if (before_impulses)
            before_impulses(*event);
        const double rest = (1 - event->time) * duration;
        meet(*event, duration);
        if (after_impulses)
            after_impulses(*event);
        std::set<std::size_t> changed;
        for (const auto* pairs : {&event->contacts, &event->connected})
            for (const SceneContact& pair : *pairs)
                changed.insert({pair.moving, pair.fixed});
        for (const std::size_t index : changed)
            if (bodies_[index].moves())
                stepper.move(index, bodies_[index].flight(rest));
    }
    place_all(stepper);
    time_ = start + duration;
}

} // namespace chasles::examples
