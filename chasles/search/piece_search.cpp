#include "chasles/search/piece_search.h"

#include "chasles/search/distance_stages.h"
#include "chasles/search/enclosed_stages.h"
#include "chasles/search/touch_stages.h"
#include "chasles/search/traverse.h"

namespace chasles::search {

PieceResult search_piece(PieceContext& context, const SearchOptions& options) {
    if (context.is_enclosed())
        return search_enclosed_piece(context, options);
    if (options.neighbours && options.margin > 0) {
        Work work;
        if (const auto pairs = options.neighbours->within(context, options.margin, work)) {
            PieceResult result = search_among<DistanceStages>(*pairs, context, options);
            result.work += work;
            return result;
        }
    }
    return options.margin > 0 ? traverse<DistanceStages>(context, options) : traverse<TouchStages>(context, options);
}

} // namespace chasles::search
