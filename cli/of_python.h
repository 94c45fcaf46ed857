// Commands that come with the Python package. Each is a program of its own, chasles-NAME, as extras of pip install it.
#pragma once

#include <string>
#include <vector>

namespace chasles::cli {

[[nodiscard]] bool is_of_python(const std::string& command);

/// Becomes the program chasles-COMMAND of the PATH. Throws InvalidInput where there is none.
int run_of_python(const std::string& command, const std::vector<std::string>& arguments);

/// One line for the help of `chasles`.
[[nodiscard]] std::string help_of_python();

} // namespace chasles::cli
