#include "python/src/without_gil.h"

#include "chasles/base/limit.h"
#include "python/src/bind.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace chasles::python {
namespace {

enum class Stage { running, ending, ended };

// Never destroyed: threads that are left behind may read them until the process is gone.
std::atomic<Stage> stage = Stage::running;
std::atomic<std::thread::id> ender;   ///< the thread that ends the process
std::atomic<std::size_t> uses{0};     ///< of the library that end in C++ and need the GIL once more
thread_local std::size_t own_uses{0}; ///< those of this thread

thread_local bool is_without_gil = false;
thread_local bool is_worker = false; ///< of a question: a thread that Python does not know

void begin_use() {
    ++uses;
    ++own_uses;
}

void end_use() {
    --uses;
    --own_uses;
}

/// Whether another thread ends the process. A worker goes on: its question ends, and the thread of the question stops.
bool is_left_behind() {
    return stage != Stage::running && std::this_thread::get_id() != ender && !is_worker;
}

/// Until the process is gone. Without the GIL.
[[noreturn]] void stop_for_good() {
    uses -= own_uses;
    while (true)
        std::this_thread::sleep_for(std::chrono::hours(1));
}

} // namespace

WithoutGil::WithoutGil() : was_without_(is_without_gil) {
    begin_use();
    state_ = PyEval_SaveThread();
    if (is_left_behind())
        stop_for_good();
    is_without_gil = true;
}

WithoutGil::~WithoutGil() {
    if (is_left_behind())
        stop_for_good();
    PyEval_RestoreThread(state_);
    is_without_gil = was_without_;
    end_use(); // only now: until then the end of the process waits for this thread
}

CallOfPython::CallOfPython() : was_without_(is_without_gil), was_worker_(is_worker) {
    const bool is_known = PyGILState_GetThisThreadState() != nullptr;
    const bool has_gil = is_known && !is_without_gil;
    if (has_gil && is_left_behind()) {
        PyEval_SaveThread();
        stop_for_good();
    }
    if (!has_gil && questions_have_to_end())
        throw Cancelled();
    begin_use();
    state_ = PyGILState_Ensure();
    is_without_gil = false;
    is_worker = is_worker || !is_known;
}

CallOfPython::~CallOfPython() {
    is_worker = was_worker_;
    is_without_gil = was_without_;
    PyGILState_Release(state_);
    end_use();
}

bool questions_have_to_end() {
    return stage == Stage::ending;
}

void end_questions() {
    using namespace std::chrono;
    constexpr milliseconds to_next_question(20); // for threads that are between two questions
    constexpr seconds patience(5);
    ender = std::this_thread::get_id();
    stage = Stage::ending;
    nanobind::set_leak_warnings(false); // the frames of threads that are left behind keep their objects
    PyThreadState* const state = PyEval_SaveThread();
    const auto begin = steady_clock::now();
    do
        std::this_thread::sleep_for(to_next_question);
    while (uses > own_uses && steady_clock::now() - begin < patience);
    PyEval_RestoreThread(state);
    stage = Stage::ended;
}

void forget_other_threads() {
    uses = own_uses;
}

void bind_end_of_process(nanobind::module_& module) {
    module.def("_end_questions", end_questions);
    module.def("_forget_other_threads", forget_other_threads);
}

} // namespace chasles::python
