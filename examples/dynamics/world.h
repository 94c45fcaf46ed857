// A world of bodies that fall, bounce and rest.
#pragma once

#include "examples/dynamics/contact_solver.h"

#include <functional>
#include <string>

namespace chasles::examples {

struct WorldOptions {
    double margin = 0; ///< bodies that come as near as this touch
    Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
    double restitution = 0; ///< 1: elastic, and without friction
    double friction = 0;
    unsigned threads = 0;
};

/// The paper's idea (section 5.1): bodies are exactly where they touch when the impulses act.
class World {
public:
    explicit World(const WorldOptions& options);

    std::size_t add(const std::string& name, const Polyhedron& shape, const RigidBody& body);

    /// Goes on by a time. Where bodies rest or slide on each other, that time should be short.
    void step(double duration);

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] std::vector<RigidBody>& bodies() { return bodies_; }
    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] std::size_t events() const { return events_; }
    [[nodiscard]] double kinetic_energy() const;

    /// Called at each event, before and after the impulses, with all bodies where they are then; may be empty.
    std::function<void(const StepEvent& event)> before_impulses = {};
    std::function<void(const StepEvent& event)> after_impulses = {};

private:
    void accelerate(double duration);
    [[nodiscard]] double least_speed(double gap, double duration) const;
    void keep_apart(double duration);
    void meet(const StepEvent& event, double duration);
    void meet_elastically(const StepEvent& event);
    void place_all(const Stepper& stepper);
    void move_all(double duration);

    WorldOptions options_;
    Scene scene_;
    std::vector<RigidBody> bodies_;
    double time_ = 0;
    std::size_t events_ = 0;
};

} // namespace chasles::examples
