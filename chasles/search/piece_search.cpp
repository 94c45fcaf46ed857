#include "chasles/search/piece_search.h"

#include "chasles/search/distance_stages.h"
#include "chasles/search/enclosed_stages.h"
#include "chasles/search/touch_stages.h"
#include "chasles/search/traverse.h"

namespace chasles::search {

PieceResult search_piece(PieceContext& context, const SearchOptions& options) {
    if (context.is_enclosed())
        return search_enclosed_piece(context, options);
    return options.margin > 0 ? traverse<DistanceStages>(context, options) : traverse<TouchStages>(context, options);
}

} // namespace chasles::search
