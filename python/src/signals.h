// Ctrl-C while the library works.
#pragma once

#include <chrono>
#include <nanobind/nanobind.h>

namespace chasles::python {

/// Asks Python now and then whether a signal has come.
class SignalCheck {
public:
    /// Twenty times a second at most, so that work loses nothing by it.
    static constexpr std::chrono::milliseconds interval{50};

    /// Without the GIL. Throws Python's exception (KeyboardInterrupt, unless a handler raises another one).
    void raise_now_and_then() {
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

} // namespace chasles::python
