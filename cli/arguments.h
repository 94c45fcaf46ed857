// Makes negative numbers and several numbers in a row safe from being taken for options and files.
#pragma once

#include <string>
#include <vector>

namespace chasles::cli {

/// `--start -1 0 0` and `--start "-.5 0 0"` become `--start=-1 0 0` and `--start=-.5 0 0`: an option that takes numbers
/// gets the word behind it, and an option that takes several gets the numbers that follow as well.
std::vector<std::string> join_numbers(const std::vector<std::string>& arguments);

} // namespace chasles::cli
