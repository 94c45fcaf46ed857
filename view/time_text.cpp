#include "view/time_text.h"

#include "chasles/base/number_text.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {

std::string time_text(double time) {
    // A double has not quite sixteen digits, and brackets are printed with as many.
    constexpr double fewest = 12, most = 16, after_point = 10;
    const double before_point = 1 + std::floor(std::log10(std::max(1.0, std::abs(time))));
    return number_text(time, int(std::clamp(before_point + after_point, fewest, most)));
}

} // namespace chasles::view
