// File names that no other process uses, because several checkouts may run tests at the same time.
#pragma once

#include <filesystem>
#include <string>
#include <unistd.h>

namespace chasles::test {

inline std::filesystem::path own_file(const std::string& name) {
    return std::filesystem::temp_directory_path() / ("chasles_" + std::to_string(getpid()) + "_" + name);
}

} // namespace chasles::test
