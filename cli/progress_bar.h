// Progress on standard error: a bar if it is a terminal, and lines now and then where no bar is seen.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace chasles::cli {

/// The bar is redrawn at most ten times per second and erased by the destructor. At most one may exist at a time.
class ProgressBar {
public:
    /// `hint` is what a line says beside the numbers.
    ProgressBar(std::string unit, std::size_t total, std::string hint = {});
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

/// While one exists, no command is silent for long: after 5 seconds, and then every 10, a line "chasles: progress: 23
/// of 100 pairs are done after 5 s" or, where nothing is counted, "chasles: progress: at work for 5 s". On a terminal
/// there is none while there is a bar.
class Heartbeat {
public:
    Heartbeat();
    ~Heartbeat();
    Heartbeat(const Heartbeat&) = delete;
    Heartbeat& operator=(const Heartbeat&) = delete;

private:
    void run();

    std::mutex mutex_;
    std::condition_variable ends_;
    bool is_over_ = false;
    std::thread thread_; ///< last: it uses the others
};

} // namespace chasles::cli
