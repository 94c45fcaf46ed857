// The traversal of one search with given stages. Each kind of stages is compiled in a file of its own: compiled
// together, the traversals would be inlined less, which costs screws 5 % of all instructions.
#pragma once

#include "chasles/search/leaf_search.h"

namespace chasles::search {

template <class Stages>
PieceResult traverse(PieceContext& context, const SearchOptions& options) {
    LeafSearch<Stages> leaves(context, options);
    const culling::TimeTree times = context.time_tree(options.margin, leaves.parts());
    culling::BvhTraversal traversal(context.moving().bvh(), context.fixed().bvh(), times, options.margin,
                                    !options.finds_any, leaves);
    const std::uint64_t node_pairs = traversal.run({options.from, 1});
    PieceResult result = leaves.take();
    result.work.node_pairs += node_pairs;
    return result;
}

} // namespace chasles::search
