// The pairs of faces that come within a distance of each other in one part of a piece after the other, each with a
// bound of its distance. All searches with `hold` share one traversal. Source: docs/derivations/17-hold.md, "One
// traversal".
#pragma once

#include "chasles/search/neighbour_list.h"
#include "chasles/search/orbit_filter.h"

#include <tuple>
#include <utility>
#include <vector>

namespace chasles::search {

/// Two faces that may come within the distance in a part of a piece.
struct PartPair {
    culling::FacePair faces;
    double at_start; ///< the faces are no nearer at tau = 0, up to the distance of the search; infinite if beyond it
    double least;    ///< likewise in the part
};

/// Whether the two faces may come within a distance of each other at a time in the part.
inline bool may_be_within(const PartPair& pair, double tau, double distance) {
    constexpr double rounding = 0x1p-50; // of the ends of windows
    const auto& [interval, when] = std::tie(pair.faces.interval, pair.faces.when);
    return !((tau > 0 ? pair.least : pair.at_start) > distance) && interval.at(when.lower) <= tau + rounding &&
           tau - rounding <= interval.at(when.upper);
}

/// The pairs of one part of a piece at a time. The first part begins at 0. Each further part begins where the part
/// before ends.
class PartPairs {
public:
    /// How to find the pairs. Both may be null.
    struct Memory {
        NeighbourList* neighbours = nullptr;
        OrbitFilter* orbits = nullptr;
    };

    /// Pairs within `distances.far`, positive, in the first part. For most pairs it is known whether they come within
    /// `distances.near`. The context is kept by reference.
    PartPairs(PieceContext& context, const culling::FaceSeparation::Distances& distances, const Memory& memory);

    [[nodiscard]] const culling::TimeRange& part() const { return part_; }
    /// Whether all pairs within a distance at a time are listed.
    [[nodiscard]] bool reaches(double tau, double distance) const {
        return is_complete_ && part_.lower <= tau && tau <= part_.upper && distance <= distances_.far;
    }
    /// False if there are too many pairs to list. Then there is no list for the rest of the piece. False as well if the
    /// maps of the piece only enclose the motion.
    [[nodiscard]] bool is_complete() const { return is_complete_; }
    /// About in the order in which they come within the distance.
    [[nodiscard]] const std::vector<PartPair>& all() const { return pairs_; }
    /// The pairs of the next part. False if there is none.
    bool go_on();
    /// The work since the last call.
    Work take_work() { return std::exchange(work_, {}); }

private:
    void take(std::span<const NeighbourList::Near> near);
    void find();

    PieceContext& context_;
    culling::FaceSeparation::Distances distances_;
    Memory memory_;
    culling::TimeRange part_;
    bool is_complete_;
    std::vector<PartPair> pairs_;
    Work work_;
};

} // namespace chasles::search
