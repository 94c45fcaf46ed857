#include "chasles/search/piece_search.h"

#include "chasles/search/distance_stages.h"
#include "chasles/search/enclosed_stages.h"
#include "chasles/search/leaf_search.h"
#include "chasles/search/touch_stages.h"

namespace chasles::search {

namespace {

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

} // namespace

PieceResult search_piece(PieceContext& context, const SearchOptions& options) {
    const bool within_margin = options.margin > 0;
    if (context.is_enclosed())
        return within_margin ? traverse<EnclosedStages<true>>(context, options)
                             : traverse<EnclosedStages<false>>(context, options);
    return within_margin ? traverse<DistanceStages>(context, options) : traverse<TouchStages>(context, options);
}

} // namespace chasles::search
