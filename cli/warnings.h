// Warnings: what an input has and an answer does not use. They go to standard error, one line each, and into the JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace chasles::cli {

/// Prints "chasles: warning: WARNING" for each warning on standard error.
void print_warnings(const std::vector<std::string>& warnings);

/// Adds the list `warnings` to an answer, if there are any.
void add_warnings(nlohmann::ordered_json& answer, const std::vector<std::string>& warnings);

} // namespace chasles::cli
