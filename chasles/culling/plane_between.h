// A plane that keeps the convex hulls of two bodies apart during a whole coarse motion.
// Source: docs/derivations/23-coarse-motion.md, "One plane".
#pragma once

#include "chasles/culling/coarse_scene.h"

namespace chasles::culling {

/// True if one plane, which stands still in the frame of the fixed body, is proven to keep both bodies farther apart
/// than the margin during the whole motion. False proves nothing. `start` and `end` are the placements at both ends.
bool have_plane_between(const CoarseScene& scene, const Placement& start, const Placement& end);

} // namespace chasles::culling
