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

} // namespace chasles::cli
