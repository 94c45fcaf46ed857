// Progress on standard error: a bar if it is a terminal, or a line now and then if it is none.
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

/// Lines "chasles: progress: 23 of 100 pairs are done after 5 s; HINT": the first one after 5 seconds, then one
/// every 10. On a terminal there is none, as there is a bar.
class ProgressLines {
public:
    ProgressLines(std::string unit, std::string hint);

    void show(std::size_t done, std::size_t total);

private:
    std::string unit_;
    std::string hint_;
    bool is_terminal_;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point next_line_;
};

} // namespace chasles::cli
