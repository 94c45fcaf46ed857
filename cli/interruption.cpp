#include "cli/interruption.h"

#include "cli/commands.h"

#include <atomic>
#include <csignal>
#include <cstdio>

namespace chasles::cli {
namespace {

std::atomic<bool> requested = false; // any thread may receive the signal
static_assert(std::atomic<bool>::is_always_lock_free);

void restore() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

extern "C" void request(int /*signal*/) {
    requested = true;
    restore();
}

} // namespace

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
