// What every search of one piece of a motion is made of in double precision.
#pragma once

#include "chasles/culling/time_tree.h"
#include "chasles/search/piece_search.h"

namespace chasles::search {

/// Maps over the whole piece, the bound of their errors, and the intervals to come. The search is not kept.
struct PieceContext {
    explicit PieceContext(const PieceSearch& search);
    PieceContext(const PieceContext&) = delete;
    PieceContext& operator=(const PieceContext&) = delete;

    const motion::ControlMaps<double> maps;
    const elementary::ErrorScale scale;
    const culling::TimeTree times;
};

} // namespace chasles::search
