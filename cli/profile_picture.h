// The distance over time as a picture.
#pragma once

#include "chasles/query/profile.h"

#include <string>
#include <vector>

namespace chasles::cli {

/// SVG: the band between both bounds over the time, and a line for each margin.
std::string profile_picture(const DistanceProfile& profile, const std::vector<double>& margins);

} // namespace chasles::cli
