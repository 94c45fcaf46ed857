// External real inputs, and the output of figures for the tests of this folder.
#pragma once

#include "chasles/query/path.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace chasles::test {

inline std::filesystem::path shared_data(const std::string& name) {
    return std::filesystem::path(CHASLES_DATA_DIR) / name;
}

/// Seconds since construction.
class Stopwatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Prints one line of figures.
template <class... Arguments>
void print_figures(const char* format, Arguments... arguments) {
    std::printf(format, arguments...);
    std::printf("\n");
}

} // namespace chasles::test

/// Skips the test if the data is missing.
#define CHASLES_REQUIRE_DATA(name)                                                                                     \
    if (std::string(CHASLES_DATA_DIR).empty() || !std::filesystem::exists(chasles::test::shared_data(name)))           \
    GTEST_SKIP() << "skipped: no folder " << name << " of real inputs"
