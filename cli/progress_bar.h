// A bar on standard error, if that is a terminal; otherwise nothing.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace chasles::cli {

/// Redrawn ten times a second at most, and wiped away at the end.
class ProgressBar {
public:
    ProgressBar(std::string unit, std::size_t total);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(std::size_t done);

private:
    std::string unit_;
    std::size_t total_;
    bool is_terminal_;
    std::chrono::steady_clock::time_point next_drawing_;
};

} // namespace chasles::cli
