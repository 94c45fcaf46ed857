#include "chasles/search/piece_search.h"

#include "chasles/search/distance_stages.h"
#include "chasles/search/enclosed_stages.h"
#include "chasles/search/touch_stages.h"
#include "chasles/search/traverse.h"

namespace chasles::search {

namespace {

PieceResult search_among(std::span<const NeighbourList::Near> pairs, PieceContext& context,
                         const SearchOptions& options) {
    LeafSearch<DistanceStages> leaves(context, options);
    test_pairs(context, options.margin, pairs, {options.from, 1}, leaves);
    return leaves.take();
}

} // namespace

PieceResult search_piece(PieceContext& context, const SearchOptions& options) {
    if (context.is_enclosed())
        return search_enclosed_piece(context, options);
    if (options.margin <= 0)
        return traverse<TouchStages>(context, options);
    Work work;
    const auto pairs = options.neighbours ? options.neighbours->within(context, options.margin, work) : std::nullopt;
    PieceResult result = pairs ? search_among(*pairs, context, options) : traverse<DistanceStages>(context, options);
    result.work += work;
    return result;
}

} // namespace chasles::search
