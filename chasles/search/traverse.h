// The traversal of one search with given stages. Each kind of stages is compiled in a file of its own: compiled
// together, the traversals would be inlined less, which costs screws 5 % of all instructions.
#pragma once

#include "chasles/search/leaf_search.h"

namespace chasles::search {

template <class Stages>
PieceResult traverse(PieceContext& context, const SearchOptions& options) {
    Work work;
    const culling::TimeRange range{options.from, 1};
    const auto pairs = options.memory.pairs_worth_testing(context, options.margin, range, work);
    LeafSearch<Stages> leaves(context, options);
    const culling::TimeTree times = context.time_tree(options.margin, leaves.parts());
    culling::BvhTraversal traversal(context.moving().bvh(), context.fixed().bvh(), times, options.margin,
                                    !options.finds_any, leaves);
    try {
        work.node_pairs += pairs ? traversal.run_among(*pairs, range) : traversal.run(range);
    } catch (const Stopped&) {
        throw Stopped{std::min(traversal.visited_until(), leaves.first_candidate())};
    }
    PieceResult result = leaves.take();
    result.work += work;
    if (!pairs)
        options.memory.learn(context, result.work);
    return result;
}

} // namespace chasles::search
