// Names of files that no other process uses: several checkouts may be tested at once.
#pragma once

#include <filesystem>
#include <string>
#include <unistd.h>

namespace chasles::test {

inline std::filesystem::path own_file(const std::string& name) {
    return std::filesystem::temp_directory_path() / ("chasles_" + std::to_string(getpid()) + "_" + name);
}

} // namespace chasles::test
