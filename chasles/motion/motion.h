// Any motion of the family whose elementary equations are cubic.
#pragma once

#include "chasles/motion/screw_motion.h"
#include "chasles/motion/sweep_motion.h"

#include <variant>

namespace chasles {

/// What a query moves a body by.
using Motion = std::variant<ScrewMotion, SweepMotion>;

} // namespace chasles
