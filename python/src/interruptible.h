// Work that Ctrl-C can stop.
#pragma once

#include "chasles/base/limit.h"
#include "chasles/query/first_contact.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <nanobind/nanobind.h>

namespace chasles::python {

/// The state that all parts share.
struct Progress {
    std::atomic<std::size_t> done = 0;
    std::atomic<bool> is_stopping = false;
};

/// Calls `work(progress)` on a new thread and waits for it without the GIL (Python's global interpreter lock). The work
/// may use further threads. Twenty times per second this function checks for signals and calls `report(done)` unless
/// `report` is None. If either raises an exception, the function sets `is_stopping`, which also is a limit for the
/// questions of the work, waits for the work, and rethrows the exception. Exceptions of the work are rethrown too. The
/// end of the process sets `is_stopping`, too.
void run_interruptibly(const std::function<void(Progress&)>& work, nanobind::handle report);

/// For functions without an answer "unknown".
inline void throw_if_unknown(Verdict verdict, double clear_until) {
    if (verdict == Verdict::unknown)
        throw Cancelled(clear_until);
}

} // namespace chasles::python
