// Pairs of nodes that are apart, kept while the moving body moves on. Together with the pairs of faces that were found
// between them they cover all pairs of faces.
// Source: docs/derivations/31-neighbour-lists.md, "Pairs of nodes".
#pragma once

#include "chasles/culling/swept_boxes.h"
#include "chasles/memory/separations.h"
#include "chasles/memory/way.h"
#include "chasles/search/find.h"

#include <vector>

namespace chasles::memory {

/// The front of a traversal of two hierarchies. Bodies are kept by reference.
class NodeFront {
public:
    NodeFront(const Body& moving, const Body& fixed) : moving_(moving.bvh()), fixed_(fixed.bvh()), apart_(moving) {}

    /// Begins with both roots.
    void restart();
    /// Of pairs whose children are in the front.
    [[nodiscard]] std::size_t size() const { return parents_.size(); }

    /// The body has come to the start of a way.
    void arrive(const Arrival& arrival) { apart_.arrive(arrival); }

    /// What may come within a margin on a way?
    struct Question {
        const culling::SweptBoxes& boxes; ///< of the whole way
        const Way& way;
        double bound;     ///< pairs with greater limits do not come within the margin (`Separations::due`)
        std::size_t most; ///< parents and leaves in all; if there are more, the search stops, and the front is to be
                          ///< restarted
    };
    struct PairOfNodes {
        std::uint32_t moving;
        std::uint32_t fixed;
    };
    /// Splits the pairs that may. Appends pairs of leaves that may.
    void split(const Question& question, std::vector<PairOfNodes>& leaves, Work& work);

private:
    std::size_t add(const PairOfNodes& parent);
    void test(std::size_t place, const Question& question, std::vector<PairOfNodes>& leaves, Work& work);
    [[nodiscard]] double farthest(const PairOfNodes& pair, const culling::MatrixPose& pose) const;

    const Bvh& moving_;
    const Bvh& fixed_;
    std::vector<PairOfNodes> parents_;
    Separations apart_;             ///< four places for the pairs of children of each parent
    std::vector<std::size_t> free_; ///< places in parents_ without children
    std::vector<std::size_t> new_;  ///< places that are not tested yet
};

} // namespace chasles::memory
