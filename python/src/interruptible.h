// Many independent pieces of work that Ctrl-C ends: those begun are finished, the others are left.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <nanobind/nanobind.h>

namespace chasles::python {

/// What all pieces share.
struct Progress {
    std::atomic<std::size_t> done = 0;
    std::atomic<bool> is_stopping = false;
};

/// Calls `work(progress)`, which spreads over threads as it likes, on a thread of its own, and waits for it without the
/// GIL. Twenty times a second signals are looked at, and `report(done)` is called unless it is None; if either raises,
/// `is_stopping` is set and what was raised is raised here once the work is back. So is what the work throws.
void run_interruptibly(const std::function<void(Progress&)>& work, nanobind::handle report);

} // namespace chasles::python
