// Real inputs from outside the project, and how the tests of this folder print the figures that they check.
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

/// One line of figures for the person who runs the tests.
template <class... Arguments>
void print_figures(const char* format, Arguments... arguments) {
    std::printf(format, arguments...);
    std::printf("\n");
}

} // namespace chasles::test

/// Leaves the test where the data is not there.
#define CHASLES_REQUIRE_DATA(name)                                                                                     \
    if (std::string(CHASLES_DATA_DIR).empty() || !std::filesystem::exists(chasles::test::shared_data(name)))           \
    GTEST_SKIP() << "skipped: no folder " << name << " of real inputs"
