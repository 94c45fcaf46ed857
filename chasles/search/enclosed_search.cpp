#include "chasles/search/enclosed_stages.h"
#include "chasles/search/traverse.h"

namespace chasles::search {

PieceResult search_enclosed_piece(PieceContext& context, const SearchOptions& options) {
    return options.margin > 0 ? traverse<EnclosedStages<true>>(context, options)
                              : traverse<EnclosedStages<false>>(context, options);
}

} // namespace chasles::search
