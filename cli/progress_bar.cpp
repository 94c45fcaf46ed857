// A bar of 40 characters: "[#########                               ] 23 of 100 motions".
#include "cli/progress_bar.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace chasles::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t width = 40;
constexpr auto pause = std::chrono::milliseconds(100);
constexpr auto before_first_line = std::chrono::seconds(5);
constexpr auto between_lines = std::chrono::seconds(10);
constexpr const char* wipe_line = "\r\x1b[K";

} // namespace

ProgressBar::ProgressBar(std::string unit, std::size_t total)
    : unit_(std::move(unit)), total_(total), is_terminal_(isatty(STDERR_FILENO) == 1),
      next_drawing_(Clock::now() + pause) {}

ProgressBar::~ProgressBar() {
    if (is_terminal_)
        std::fputs(wipe_line, stderr);
}

void ProgressBar::show(std::size_t done) {
    if (!is_terminal_ || Clock::now() < next_drawing_)
        return;
    next_drawing_ = Clock::now() + pause;
    const std::size_t filled = total_ == 0 ? width : width * done / total_;
    const std::string bar =
        fmt::format("{}[{:<{}}] {} of {} {}", wipe_line, std::string(filled, '#'), width, done, total_, unit_);
    std::fputs(bar.c_str(), stderr);
    std::fflush(stderr);
}

ProgressLines::ProgressLines(std::string unit, std::string hint)
    : unit_(std::move(unit)), hint_(std::move(hint)), is_terminal_(isatty(STDERR_FILENO) == 1), begin_(Clock::now()),
      next_line_(begin_ + before_first_line) {}

void ProgressLines::show(std::size_t done, std::size_t total) {
    const Clock::time_point now = Clock::now();
    if (is_terminal_ || now < next_line_)
        return;
    next_line_ = now + between_lines;
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now - begin_).count();
    const std::string line =
        fmt::format("chasles: progress: {} of {} {} are done after {} s; {}\n", done, total, unit_, seconds, hint_);
    std::fputs(line.c_str(), stderr);
}

} // namespace chasles::cli
