// The pairs of faces that a helical motion may bring together, for searches that follow each other on one axis: the
// turns of a nut, or of a hinge. Source: docs/derivations/32-orbits.md.
#pragma once

#include "chasles/culling/orbit_pairs.h"
#include "chasles/search/find.h"
#include "chasles/search/piece_context.h"

#include <optional>
#include <vector>

namespace chasles::search {

/// Keeps what the faces of two bodies look like from one axis, once searches about this axis have cost enough. Bodies
/// are kept by reference. For one thread. What it holds changes the time of the next searches, and their brackets
/// within the tolerance.
class OrbitFilter {
public:
    OrbitFilter(const Body& moving, const Body& fixed);

    /// The pairs of leaves that may come within the margin of each other in the piece. Empty if the piece turns about
    /// another axis than the pieces before, or if the filter does not pay.
    std::optional<std::vector<culling::NodePair>> pairs(const PieceContext& context, double margin, Work& work);
    /// A piece was searched without the filter, at this cost.
    void add_cost(const PieceContext& context, const Work& work);

private:
    struct Trees {
        culling::OrbitTree moving;
        culling::OrbitTree fixed;
    };

    [[nodiscard]] std::optional<motion::Orbit> orbit_of(const PieceContext& context) const;
    /// The way of an orbit about the axis. Empty if it is about another one.
    [[nodiscard]] std::optional<culling::OrbitWay> way_of(const motion::Orbit& orbit, double margin) const;

    void make_trees();
    void give_up();

    const Body& moving_;
    const Body& fixed_;
    motion::Ball ball_;                 ///< around the moving body
    double most_deviation_;             ///< from an orbit, and of orbits that count as one, in the length unit
    std::optional<motion::Orbit> axis_; ///< of the latest searches that were dear
    std::optional<Trees> trees_;        ///< about the axis
    double cost_ = 0;                   ///< of searches about the axis without the filter, in pairs of nodes
    double dearest_ = 0;                ///< of these searches
    double cost_to_pay_;                ///< before trees are made
};

} // namespace chasles::search
