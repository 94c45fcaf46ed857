// The rows of the table that `batch` writes.
#pragma once

#include "chasles/chasles.h"

#include <string>

namespace chasles::cli {

/// The header, with its line end.
std::string batch_header();

/// The row of a motion that was answered. With several contacts the row shows the first one.
std::string batch_row(const std::string& id, const FirstContact& found);

/// The row of a motion that could not be read.
std::string batch_error_row(const std::string& id, const std::string& why);

} // namespace chasles::cli
