// Numbers as messages print them, in any locale.
#pragma once

#include <string>

namespace chasles {

/// The shortest text that reads back as the same number. Powers of two may have a digit more.
std::string number_text(double number);

/// At most `digits` significant digits (up to 17), as printf's %g.
std::string number_text(double number, int digits);

/// With twelve digits; with more where fewer than ten would be after the point, as of stamps that count seconds since
/// 1970, but with at most sixteen.
std::string time_text(double time);

} // namespace chasles
