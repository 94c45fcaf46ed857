// When do two small bodies first touch on any motion? Bisection over time, in multiprecision.
//
// Proven, up to the rounding of 256 bits: no touch before `lower`, and a touch at or before `upper`. A part of time is
// clear if for each pair of triangles some direction keeps both apart at both ends of the part by more than the
// distance function can bend in between (bounds of the second derivative, derived in touch_search.cpp). A touch is
// proven by an edge that passes through a triangle at one moment. Doubles only choose where multiprecision is needed.
// They count as a proof where their error bound allows it, and not at all with `wide_only`. Nothing is sampled.
#pragma once

#include "tests/attack/shapes.h"
#include "tests/attack/true_motion.h"

#include <optional>

namespace chasles::attack {

struct TouchOptions {
    double margin = 0;         ///< distances up to this one need not be clear
    bool wide_only = false;    ///< no proof by doubles
    int depth = 50;            ///< parts of time are at least 2^-depth long
    std::size_t budget = 6000; ///< parts of time; later parts get longer and longer
};

/// The first touch.
struct TrueTouch {
    double lower = 1;            ///< no touch before; 1 if there is none at all
    std::optional<double> upper; ///< a touch is proven at or before; empty if clear or too close to a graze
    bool is_clear = false;       ///< no touch in [0, 1]
    std::size_t parts = 0;       ///< of time
};

TrueTouch first_touch(const Shape& moving, const Shape& fixed, const TrueMotion& motion,
                      const TouchOptions& options = {});

/// A length that bounds all coordinates at all times, within a factor of a few.
double scene_size(const Shape& moving, const Shape& fixed, const TrueMotion& motion);

} // namespace chasles::attack
