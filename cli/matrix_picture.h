// The least distances of all pairs as a picture.
#pragma once

#include "chasles/scene/scene.h"

#include <string>

namespace chasles::cli {

/// SVG: bodies by bodies, in colours by distance, with numbers where there is room for them.
std::string matrix_picture(const Scene& scene, const DistanceMatrix& found);

} // namespace chasles::cli
