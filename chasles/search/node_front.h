// Pairs of nodes that are apart, kept while the moving body moves on. Together with the pairs of faces that were found
// between them they cover all pairs of faces.
// Source: docs/derivations/31-neighbour-lists.md, "Pairs of nodes".
#pragma once

#include "chasles/culling/swept_boxes.h"
#include "chasles/search/find.h"
#include "chasles/search/limits.h"
#include "chasles/search/owned_pairs.h"
#include "chasles/search/way.h"

#include <vector>

namespace chasles::search {

/// The front of a traversal of two hierarchies. Bodies are kept by reference.
class NodeFront {
public:
    NodeFront(const Body& moving, const Body& fixed) : moving_(moving.bvh()), fixed_(fixed.bvh()) {}

    /// Begins with both roots.
    void restart();
    [[nodiscard]] std::size_t size() const { return nodes_.size(); }

    /// What may come within a margin on a way?
    struct Question {
        const culling::SweptBoxes& boxes; ///< of the whole way
        double margin;
        double bound;     ///< pairs with greater limits do not come within the margin
        double travelled; ///< up to the start of the way
        std::size_t most; ///< pairs in all; if there are more, the search stops, and the front is to be restarted
    };
    /// Splits the pairs that may. Appends pairs of faces that may.
    void split(const Question& question, std::vector<TwoFaces>& faces, Work& work);
    /// Raises the limits of the pairs that the last `split` has tested.
    void arrive(const Arrival& arrival);

private:
    struct PairOfNodes {
        std::uint32_t moving;
        std::uint32_t fixed;
    };
    struct Tested {
        std::size_t place;
        double gap_at_end;
    };

    void split(const PairOfNodes& pair, const Question& question, std::vector<TwoFaces>& faces, Work& work);
    void keep(const PairOfNodes& pair, double limit, double gap_at_end);

    const Bvh& moving_;
    const Bvh& fixed_;
    std::vector<PairOfNodes> nodes_; ///< they, or all of their children, are apart
    Limits limits_;                  ///< by at least the limit less the way that is travelled
    std::vector<std::size_t> free_;  ///< places in nodes_ that hold no pair
    std::vector<Tested> tested_;     ///< by the last `split`; each place at most once
    std::vector<PairOfNodes> stack_;
};

} // namespace chasles::search
