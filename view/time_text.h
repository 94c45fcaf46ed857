// Times as people read them.
#pragma once

#include <string>

namespace chasles::view {

/// With twelve digits; with more where fewer than ten would be after the point, as of stamps that count seconds since
/// 1970, but with at most sixteen.
std::string time_text(double time);

} // namespace chasles::view
