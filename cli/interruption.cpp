#include "cli/interruption.h"

#include <csignal>

namespace chasles::cli {
namespace {

volatile std::sig_atomic_t requested = 0; // the only kind of object that a signal handler may write

void restore() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

extern "C" void request(int /*signal*/) {
    requested = 1;
    restore();
}

} // namespace

Interruption::Interruption() {
    requested = 0;
    std::signal(SIGINT, request);
    std::signal(SIGTERM, request);
}

Interruption::~Interruption() {
    restore();
}

bool Interruption::is_requested() {
    return requested != 0;
}

} // namespace chasles::cli
