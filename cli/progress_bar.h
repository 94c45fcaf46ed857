// A progress bar on standard error. It is drawn only if standard error is a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace chasles::cli {

/// The bar is redrawn at most ten times per second and erased by the destructor.
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
