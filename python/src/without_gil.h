// Work without the GIL (Python's global interpreter lock), and the end of the process during such work.
//
// When the interpreter finalizes, it ends or freezes each other thread that asks for the GIL, wherever the thread is.
// C++ between two calls of Python does not survive that. So a function at exit (python/chasles/end_of_process.py) ends
// the questions of all other threads before, and these threads never return to Python.
#pragma once

#include <nanobind/nanobind.h>

namespace chasles::python {

/// While it exists, its thread does not hold the GIL. The same as nanobind::gil_scoped_release, but in a thread that
/// the end of the process leaves behind, neither the constructor nor the destructor returns.
class WithoutGil {
public:
    WithoutGil();
    ~WithoutGil();
    WithoutGil(const WithoutGil&) = delete;
    WithoutGil& operator=(const WithoutGil&) = delete;

private:
    PyThreadState* state_ = nullptr;
    bool was_without_ = false;
};

/// While it exists, its thread holds the GIL for a call of Python from inside of the library. Throws Cancelled if the
/// process ends and the thread is without the GIL. Does not return in a thread that has it and is left behind.
class CallOfPython {
public:
    CallOfPython();
    ~CallOfPython();
    CallOfPython(const CallOfPython&) = delete;
    CallOfPython& operator=(const CallOfPython&) = delete;

private:
    PyGILState_STATE state_;
    bool was_without_;
    bool was_worker_;
};

/// Whether questions have to end, and must not call Python any more, because the process ends.
bool questions_have_to_end();

/// Ends the questions of all threads but this one, which ends the process. Called with the GIL. Returns when they have
/// ended, or after five seconds.
void end_questions();

/// After a fork: the new process has no other threads.
void forget_other_threads();

} // namespace chasles::python
