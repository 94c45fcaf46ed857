#include "cli/interruption.h"

#include "cli/commands.h"
#include "cli/output.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <string_view>
#include <unistd.h>

namespace chasles::cli {
namespace {

std::atomic<bool> requested = false; // any thread may receive the signal
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr std::string_view interrupted = "chasles: interrupted\n";

/// Calls only what a handler may call.
extern "C" void end_at_once(int /*signal*/) {
    remove_unfinished();
    static_cast<void>(!write(STDERR_FILENO, interrupted.data(), interrupted.size()));
    _exit(is_interrupted);
}

void restore() {
    std::signal(SIGINT, end_at_once);
    std::signal(SIGTERM, end_at_once);
}

extern "C" void request(int /*signal*/) {
    requested = true;
    restore();
}

} // namespace

void end_when_interrupted() {
    for (const int number : {SIGINT, SIGTERM})
        if (std::signal(number, end_at_once) == SIG_IGN)
            std::signal(number, SIG_IGN);
}

Interruption::Interruption() {
    requested = false;
    std::signal(SIGINT, request);
    std::signal(SIGTERM, request);
}

Interruption::~Interruption() {
    restore();
}

bool Interruption::is_requested() {
    return requested;
}

int report_interruption(const std::string& what) {
    std::fputs(("chasles: interrupted: " + what + "\n").c_str(), stderr);
    return is_interrupted;
}

} // namespace chasles::cli
