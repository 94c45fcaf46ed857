// The rows of the table that `batch` writes.
#pragma once

#include "view/motion_numbers.h"

#include <string>

namespace chasles::cli {

/// The header, including the line end.
std::string batch_header();

/// The row of an answered motion. It shows the first of several contacts. The cells of tau are empty if the motion has
/// none.
std::string batch_row(const std::string& id, const FirstContact& found, view::MotionKind kind);

/// The row of a motion that could not be read.
std::string batch_error_row(const std::string& id, const std::string& why);

} // namespace chasles::cli
