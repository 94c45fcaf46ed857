// Proof that two links overlap in all configurations near one of them: a point of one surface is inside of the other
// body, by more than any point may move.
// Source: docs/derivations/29-robots.md, "Pairs that never touch".
#pragma once

#include "chasles/robot/model.h"
#include "chasles/robot/overlap_surface.h"

#include <vector>

namespace chasles::robot {

class OverlapProof {
public:
    /// Of two links with these shapes. Both are kept by reference.
    OverlapProof(const Model& model, const std::vector<const Element*>& first,
                 const std::vector<const Element*>& second);

    /// Whether the links touch wherever no point is farther than the margin from its place at the configuration, as
    /// seen from the other link. False where that is not proven.
    [[nodiscard]] bool touch_within(double margin, const Configuration& configuration) const;

private:
    const Model& model_;
    const std::vector<const Element*>& first_;
    const std::vector<const Element*>& second_;
    std::vector<OverlapSurface> of_first_, of_second_; ///< of each element
};

} // namespace chasles::robot
