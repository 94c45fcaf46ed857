// Runs the built command line as a process and returns its output.
#pragma once

#include <filesystem>
#include <string>

namespace chasles::tests {

struct Finished {
    int status = -1; ///< exit status; 128 + signal if it was killed
    std::string out; ///< standard output
    std::string err; ///< standard error
};

/// Runs `chasles ARGUMENTS` through the shell in `folder`; `arguments` may redirect standard output.
Finished run_chasles(const std::filesystem::path& folder, const std::string& arguments);

} // namespace chasles::tests
