// A bar of 40 characters: "[#########                               ] 23 of 100 motions".
#include "cli/progress_bar.h"

#include <cstdio>
#include <fmt/format.h>
#include <optional>
#include <system_error>
#include <unistd.h>

namespace chasles::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t width = 40;
constexpr auto pause = std::chrono::milliseconds(100);
constexpr auto before_first_line = std::chrono::seconds(5);
constexpr auto between_lines = std::chrono::seconds(10);
constexpr const char* wipe_line = "\r\x1b[K";

bool is_seen_on_a_terminal() {
    return isatty(STDERR_FILENO) == 1;
}

/// What the present bar counts, for the lines.
struct Count {
    std::string unit;
    std::string hint;
    std::size_t total = 0;
    std::size_t done = 0;
};
std::mutex count_mutex;
std::optional<Count> present_count;

std::string line_after(std::chrono::seconds time) {
    const std::lock_guard lock(count_mutex);
    if (!present_count)
        return fmt::format("chasles: progress: at work for {} s\n", time.count());
    const auto& [unit, hint, total, done] = *present_count;
    return fmt::format("chasles: progress: {} of {} {} are done after {} s{}{}\n", done, total, unit, time.count(),
                       hint.empty() ? "" : "; ", hint);
}

bool is_a_bar_seen() {
    const std::lock_guard lock(count_mutex);
    return present_count && is_seen_on_a_terminal();
}

} // namespace

ProgressBar::ProgressBar(std::string unit, std::size_t total, std::string hint)
    : unit_(std::move(unit)), total_(total), is_terminal_(is_seen_on_a_terminal()),
      next_drawing_(Clock::now() + pause) {
    const std::lock_guard lock(count_mutex);
    present_count = Count{unit_, std::move(hint), total_};
}

ProgressBar::~ProgressBar() {
    if (is_terminal_)
        std::fputs(wipe_line, stderr);
    const std::lock_guard lock(count_mutex);
    present_count.reset();
}

void ProgressBar::show(std::size_t done) {
    {
        const std::lock_guard lock(count_mutex);
        present_count->done = done;
    }
    if (!is_terminal_ || Clock::now() < next_drawing_)
        return;
    next_drawing_ = Clock::now() + pause;
    const std::size_t filled = total_ == 0 ? width : width * done / total_;
    const std::string bar =
        fmt::format("{}[{:<{}}] {} of {} {}", wipe_line, std::string(filled, '#'), width, done, total_, unit_);
    std::fputs(bar.c_str(), stderr);
    std::fflush(stderr);
}

/// Without a thread, a command is silent.
Heartbeat::Heartbeat() {
    try {
        thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) { // NOLINT(bugprone-empty-catch)
    }
}

Heartbeat::~Heartbeat() {
    {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
    }
    ends_.notify_one();
    if (thread_.joinable())
        thread_.join();
}

void Heartbeat::run() {
    const Clock::time_point begin = Clock::now();
    std::unique_lock lock(mutex_);
    for (Clock::time_point next = begin + before_first_line;; next += between_lines) {
        if (ends_.wait_until(lock, next, [this] { return is_over_; }))
            return;
        if (!is_a_bar_seen())
            std::fputs(line_after(std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - begin)).c_str(),
                       stderr);
    }
}

} // namespace chasles::cli
