// What every search of one piece of a motion is made of in double precision.
#pragma once

#include "chasles/query/time_tree.h"
#include "chasles/query/traversal.h"

namespace chasles::query {

/// Maps over the whole piece, the bound of their errors, and the intervals to come. The search is not kept.
struct PieceNumbers {
    explicit PieceNumbers(const PieceSearch& search);
    PieceNumbers(const PieceNumbers&) = delete;
    PieceNumbers& operator=(const PieceNumbers&) = delete;

    const motion::ControlMaps<double> maps;
    const elementary::ErrorScale scale;
    const TimeTree times;
};

} // namespace chasles::query
