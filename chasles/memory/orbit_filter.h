// The pairs of faces that a helical motion may bring together, for searches that follow each other on one axis: the
// turns of a nut, or of a hinge. Source: docs/derivations/32-orbits.md.
#pragma once

#include "chasles/memory/orbit_pairs.h"
#include "chasles/search/memory.h"
#include "chasles/search/piece_context.h"

#include <optional>
#include <vector>

namespace chasles::memory {

/// Keeps what the faces of two bodies look like from one axis, once searches about this axis have cost enough. Bodies
/// are kept by reference. For one thread.
class OrbitFilter : public search::Memory {
public:
    OrbitFilter(const Body& moving, const Body& fixed);

    /// Empty if the piece turns about another axis than the pieces before, if the filter does not pay, and for a part
    /// of a piece.
    std::optional<std::span<const culling::NodePair>> pairs_worth_testing(const search::PieceContext& context,
                                                                          double margin,
                                                                          const culling::TimeRange& range,
                                                                          Work& work) override;
    void learn(const search::PieceContext& context, const Work& work) override;

private:
    struct Trees {
        OrbitTree moving;
        OrbitTree fixed;
    };

    [[nodiscard]] std::optional<motion::Orbit> orbit_of(const search::PieceContext& context) const;
    /// The way of an orbit about the axis. Empty if it is about another one.
    [[nodiscard]] std::optional<OrbitWay> way_of(const motion::Orbit& orbit, double margin) const;

    void make_trees();
    void give_up();

    const Body& moving_;
    const Body& fixed_;
    motion::Ball ball_;                 ///< around the moving body
    double most_deviation_;             ///< from an orbit, and of orbits that count as one, in the length unit
    std::optional<motion::Orbit> axis_; ///< of the latest searches that were dear
    std::optional<Trees> trees_;        ///< about the axis
    std::optional<std::vector<culling::NodePair>> pairs_; ///< of the latest answer
    double cost_ = 0;    ///< total of the searches about the axis without the filter, in pairs of nodes
    double dearest_ = 0; ///< the cost of the most expensive one
    double cost_to_pay_; ///< before trees are made
};

} // namespace chasles::memory
