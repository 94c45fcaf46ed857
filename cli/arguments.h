// Prevents the parser from reading negative numbers as options, and numbers in a row as file names.
#pragma once

#include <string>
#include <vector>

namespace chasles::cli {

/// `--start -1 0 0` and `--start "-.5 0 0"` become `--start=-1 0 0` and `--start=-.5 0 0`. An option that takes one
/// number is joined with the next argument. An option that takes several numbers is also joined with all further
/// arguments that are numbers.
std::vector<std::string> join_numbers(const std::vector<std::string>& arguments);

} // namespace chasles::cli
