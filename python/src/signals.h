// Ctrl-C during a query, and the end of the process.
#pragma once

#include "chasles/base/limit.h"
#include "python/src/without_gil.h"

#include <chrono>
#include <limits>
#include <nanobind/nanobind.h>

namespace chasles::python {

/// Checks at regular intervals whether Python has received a signal.
class SignalCheck {
public:
    /// At most twenty checks per second, whose cost is negligible.
    static constexpr std::chrono::milliseconds interval{50};

    /// Checks for signals if the interval is over. Must be called without the GIL (Python's global interpreter lock).
    /// Throws the exception that Python's signal handler raises, by default KeyboardInterrupt.
    void raise_if_due() {
        const auto now = std::chrono::steady_clock::now();
        if (now < next_)
            return;
        next_ = now + interval;
        const nanobind::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0)
            throw nanobind::python_error();
    }

private:
    std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + interval;
};

/// While it exists, Ctrl-C and the end of the process end the questions of this thread. For work without the GIL.
class EndsBySignals {
    SignalCheck signals_;
    Limit limit_{std::numeric_limits<double>::infinity(), [this] {
                     if (questions_have_to_end())
                         return false;
                     signals_.raise_if_due();
                     return true;
                 }};
};

} // namespace chasles::python
