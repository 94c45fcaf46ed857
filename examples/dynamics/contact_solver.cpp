#include "examples/dynamics/contact_solver.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chasles::examples {

using Eigen::Vector3d;

namespace {

Vector3d relative_velocity(const Touch& touch, const std::vector<RigidBody>& bodies) {
    return bodies[touch.moving].velocity_at(touch.point) - bodies[touch.fixed].velocity_at(touch.point);
}

/// What an impulse of 1 along a direction does to both bodies.
struct Effect {
    Vector3d direction;
    Velocity of_moving;
    Velocity of_fixed;
    double ease = 0;    ///< how much faster they separate
    double impulse = 0; ///< so far
};

Effect effect_along(const Vector3d& direction, const Touch& touch, const std::vector<RigidBody>& bodies) {
    const auto speed_of = [&](const RigidBody& body, const Velocity& change) {
        return direction.dot(change.linear + change.angular.cross(touch.point - body.centre_in_world()));
    };
    const RigidBody& moving = bodies[touch.moving];
    const RigidBody& fixed = bodies[touch.fixed];
    Effect effect{direction, moving.answer_to(direction, touch.point), fixed.answer_to(-direction, touch.point)};
    effect.ease = speed_of(moving, effect.of_moving) - speed_of(fixed, effect.of_fixed);
    return effect;
}

/// Along the normal, and two directions across.
std::array<Effect, 3> effects_of(const Touch& touch, const std::vector<RigidBody>& bodies) {
    const Vector3d across = touch.normal.unitOrthogonal();
    return {effect_along(touch.normal, touch, bodies), effect_along(across, touch, bodies),
            effect_along(touch.normal.cross(across), touch, bodies)};
}

/// Changes the impulse so that the bodies separate at the wanted speed, as far as its limits allow. Returns by how much
/// the speed has changed.
double improve(Effect& effect, const Touch& touch, double wanted_speed, const Bracket& limits,
               std::vector<RigidBody>& bodies) {
    const double missing = wanted_speed - effect.direction.dot(relative_velocity(touch, bodies));
    const double impulse = std::clamp(effect.impulse + missing / effect.ease, limits.lower, limits.upper);
    const double change = impulse - effect.impulse;
    effect.impulse = impulse;
    for (const auto& [index, answer] :
         {std::pair(touch.moving, &effect.of_moving), std::pair(touch.fixed, &effect.of_fixed)}) {
        bodies[index].velocity.linear += change * answer->linear;
        bodies[index].velocity.angular += change * answer->angular;
    }
    return std::abs(change) * effect.ease;
}

/// The normal first: it limits the friction.
double improve(std::array<Effect, 3>& effects, const Touch& touch, double friction, std::vector<RigidBody>& bodies) {
    auto& [along, across, aside] = effects;
    const double change = improve(along, touch, touch.least_speed, {0, HUGE_VAL}, bodies);
    const double most = friction * along.impulse;
    return std::max(
        {change, improve(across, touch, 0, {-most, most}, bodies), improve(aside, touch, 0, {-most, most}, bodies)});
}

} // namespace

std::vector<Touch> touches_of(const std::vector<SceneContact>& pairs) {
    std::vector<Touch> touches;
    for (const SceneContact& pair : pairs)
        for (const Contact& contact : pair.contact.contacts)
            touches.push_back({pair.moving, pair.fixed, contact.point + 0.5 * contact.gap * contact.normal,
                               contact.normal, contact.gap});
    return touches;
}

double separation_speed(const Touch& touch, const std::vector<RigidBody>& bodies) {
    return touch.normal.dot(relative_velocity(touch, bodies));
}

void resolve(const std::vector<Touch>& touches, double friction, double tolerance, std::vector<RigidBody>& bodies) {
    constexpr int most_rounds = 300;
    std::vector<std::array<Effect, 3>> effects;
    for (const Touch& touch : touches)
        effects.push_back(effects_of(touch, bodies));
    double greatest = 0;
    for (int round = 0; round < most_rounds; ++round) {
        double change = 0;
        for (std::size_t i = 0; i < touches.size(); ++i)
            change = std::max(change, improve(effects[i], touches[i], friction, bodies));
        greatest = std::max(greatest, change);
        if (change <= tolerance * greatest)
            return;
    }
}

} // namespace chasles::examples
