// From contact to contact: bodies move until two of them come near, the caller decides how they go on, and so forth.
// Source: docs/derivations/28-stepping.md.
#pragma once

#include "chasles/scene/scene.h"

#include <memory>
#include <optional>

namespace chasles {

/// How to step.
struct StepOptions {
    /// Bodies that come as near as this touch; positive, mesh unit. Bodies that are nearer already may come half as
    /// near as they are, so they can slide and roll on each other. Pairs and groups with margins of their own in the
    /// scene (Scene::set_margin) keep them.
    double margin = 0;
    /// The contact sets of an event list what is as near as this; more than all margins, mesh unit. 0: twice the margin
    /// of the pair.
    double reach = 0;
    double time_tolerance = 1e-12; ///< as in QueryOptions
    unsigned threads = 0;          ///< at most so many; 0: all cores
};

/// Some pairs of bodies have come near each other at a time of the step.
struct StepEvent {
    double time = 0; ///< in [0, 1]
    /// The pairs, in the order of their names. Each contact set is that of the time of the event and lists all contacts
    /// within the reach; its approach speeds are per step, and its brackets are {time, time}.
    std::vector<SceneContact> contacts;
    /// Other pairs within the reach of each other, from body to body that moves: the rest of a stack, if one of its
    /// bodies is hit. Likewise.
    std::vector<SceneContact> connected;
};

/// One step of a scene, from time 0 to time 1. The scene must outlive it and must not change.
///
///     Stepper stepper(scene, {.margin = 1e-3});
///     while (const auto event = stepper.advance())
///         for (const SceneContact& pair : event->contacts)
///             stepper.move(pair.moving, ...); // away from the contact
class CHASLES_EXPORT Stepper {
public:
    /// Throws InvalidInput for an option out of its range, and for a scene in which a pair or a group has the margin 0.
    Stepper(const Scene& scene, const StepOptions& options);
    ~Stepper();
    Stepper(Stepper&& other) noexcept;
    Stepper& operator=(Stepper&& other) noexcept;

    /// Goes on to the next event; nothing at the end of the step. Up to there all pairs that are not ignored stay
    /// farther apart than their margin, or than 0.49 of their distance where that was less. This is proven. Throws
    /// InvalidInput "scene: A on B: ..." for bodies nearer than a millionth of their margin: they started there, or
    /// many events have not moved them away from each other.
    std::optional<StepEvent> advance();

    [[nodiscard]] double time() const;                ///< of the last event, or 1 at the end
    [[nodiscard]] Pose pose(std::size_t index) const; ///< of a body, now
    /// How a body goes on: a motion from its present pose, whose time 0 is now and whose time 1 is the end of the step.
    /// Throws InvalidInput for motions that Scene::add does not take, and for one that starts elsewhere.
    void move(std::size_t index, const Motion& rest);

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace chasles
