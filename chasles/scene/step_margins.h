// The distances at which pairs of bodies make the events of a step. Source: docs/derivations/28-stepping.md, "Levels".
#pragma once

#include "chasles/scene/box_pairs.h"
#include "chasles/scene/stepper.h"

namespace chasles::scene {

/// Keeps the scene by reference.
class StepMargins {
public:
    /// Throws InvalidInput for an option out of its range, and for a pair or a group with a margin of 0.
    StepMargins(const Scene& scene, const StepOptions& options);

    /// A pair that comes as near as this makes an event.
    [[nodiscard]] double of(const IndexPair& pair) const { return scene_.margin_of(pair.first, pair.second, margin_); }
    /// The contact set of the pair lists what is as near as this.
    [[nodiscard]] double reach_of(const IndexPair& pair) const { return reach_ == 0 ? 2 * of(pair) : reach_; }

    [[nodiscard]] double least() const { return all_.lower; }
    [[nodiscard]] double largest() const { return all_.upper; }
    [[nodiscard]] double largest_reach() const { return reach_ == 0 ? 2 * largest() : reach_; }

private:
    const Scene& scene_;
    double margin_; ///< of pairs without one of their own
    double reach_;  ///< 0 for twice the margin of each pair
    Bracket all_;   ///< the least and the largest margin of all pairs
};

} // namespace chasles::scene
