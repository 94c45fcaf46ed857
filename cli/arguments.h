// Prevents the parser from reading numbers in a row as file names, and empty values as options that are not given.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace chasles::cli {

/// Refuses an empty value of an option of the command that comes first.
void require_values(const CLI::App& app, const std::vector<std::string>& arguments);
/// `--start -1 0 0` and `--start "-.5 0 0"` become `--start=-1 0 0` and `--start=-.5 0 0`: an option that takes several
/// numbers is joined with the next argument, and with all further ones that are numbers.
std::vector<std::string> join_numbers(const std::vector<std::string>& arguments);

} // namespace chasles::cli
