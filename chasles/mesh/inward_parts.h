// Which closed parts of a surface are turned inwards, so that nothing in them is solid.
#pragma once

#include "chasles/mesh/volume.h"

#include <cstddef>

namespace chasles {

/// The number of closed parts whose own volume is below 0 by more than its rounding: rooms, and the cavities of shells.
[[nodiscard]] std::size_t count_inward_parts(const Surface& surface, const Volume& volume);

} // namespace chasles
