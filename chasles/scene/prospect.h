// What a step expects of a pair of bodies. Source: docs/derivations/28-stepping.md.
#pragma once

#include "chasles/scene/box_pairs.h"

#include <queue>
#include <vector>

namespace chasles::scene {

/// A pair of bodies, as long as both keep their courses.
struct Prospect {
    Bracket time;      ///< of the first contact, or, if it was not asked for, a time before which there is none
    IndexPair pair;    ///< the moving and the fixed body
    double from = 0;   ///< the question is about the time from there on
    IndexPair changes; ///< of both courses
};

struct IsLater {
    bool operator()(const Prospect& a, const Prospect& b) const { return a.time.lower > b.time.lower; }
};
/// The earliest first.
using Prospects = std::priority_queue<Prospect, std::vector<Prospect>, IsLater>;

} // namespace chasles::scene
