// The steps that prove a piece of a motion free of contact. Source: docs/certificate.md, "Proof".
#pragma once

#include "chasles/certificate/separating_normal.h"

#include <cstddef>
#include <string>

namespace chasles::certificate {

struct Proof {
    std::string steps;
    std::size_t planes = 0;
    std::size_t open = 0; ///< steps that prove nothing
};

/// From tau = 0 to `end`. Throws Cancelled.
Proof prove(const PieceOfBodies& piece, double end);

} // namespace chasles::certificate
