// What a checker keeps for each stretch of a path between handovers. Source: docs/derivations/42-several-robots.md,
// "Handovers".
#pragma once

#include "chasles/robot/prepared.h"

#include <span>
#include <vector>

namespace chasles::robot {

/// The robot before the first handover, after it, after the second one, and so on. Without handovers the one that is
/// given, which is kept by reference.
class Stretches {
public:
    /// Throws InvalidInput "handover I: WHY".
    Stretches(const RobotChecker::Prepared& prepared, const JointPath& path, std::span<const Handover> handovers);

    [[nodiscard]] const RobotChecker::Prepared& at(std::size_t segment) const;
    /// What is not tested in some stretch.
    [[nodiscard]] const std::shared_ptr<const UntestedPairs>& untested() const { return untested_; }

private:
    struct Stretch {
        std::size_t first_segment;
        std::shared_ptr<const RobotChecker::Prepared> prepared;
    };
    void count_pairs_at_rest();

    const RobotChecker::Prepared& given_;
    std::vector<Stretch> stretches_;
    std::shared_ptr<const UntestedPairs> untested_;
};

} // namespace chasles::robot
