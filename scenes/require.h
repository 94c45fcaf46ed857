// What the sizes of a generated shape must fulfil.
#pragma once

#include "chasles/base/invalid_input.h"

#include <fmt/format.h>

namespace chasles::scenes {

/// Throws InvalidInput "SHAPE: WHERE: WHY" unless it holds.
inline void require(const char* shape, bool holds, const char* where, const char* why) {
    if (!holds)
        throw InvalidInput(fmt::format("{}: {}: {}", shape, where, why));
}

} // namespace chasles::scenes
