#include "python/src/interruptible.h"

#include "chasles/base/limit_of_thread.h"
#include "python/src/signals.h"
#include "python/src/without_gil.h"

#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

namespace chasles::python {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

/// Work on another thread, which the destructor joins.
class Background {
public:
    Background(const std::function<void(Progress&)>& work, Progress& progress)
        : thread_([this, &work, &progress, limit_of_caller = LimitOfThread::get()] {
              const LimitOfThread same_limit(limit_of_caller);
              try {
                  const Limit limit(forever, [&progress] { return !progress.is_stopping; });
                  work(progress);
              } catch (...) {
                  error_ = std::current_exception();
              }
              const std::lock_guard lock(mutex_);
              is_over_ = true;
              over_.notify_one();
          }) {}
    ~Background() { join(); }
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /// Waits for one interval. Returns whether the work is over.
    bool wait() {
        std::unique_lock lock(mutex_);
        return over_.wait_for(lock, SignalCheck::interval, [this] { return is_over_; });
    }

    void join() {
        if (thread_.joinable())
            thread_.join();
    }

    void rethrow() const {
        if (error_)
            std::rethrow_exception(error_);
    }

private:
    std::mutex mutex_;
    std::condition_variable over_;
    bool is_over_ = false;
    std::exception_ptr error_;
    std::thread thread_; ///< last: the thread uses the other members
};

/// Checks for signals and reports, unless the process ends: then the work has to stop.
void look_after(Progress& progress, nanobind::handle report) {
    if (questions_have_to_end())
        progress.is_stopping = true;
    if (progress.is_stopping)
        return;
    const nanobind::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0)
        throw nanobind::python_error();
    if (!report.is_none())
        report(std::size_t(progress.done));
}

} // namespace

void run_interruptibly(const std::function<void(Progress&)>& work, nanobind::handle report) {
    const WithoutGil without_gil;
    Progress progress;
    Background background(work, progress);
    try {
        while (!background.wait())
            look_after(progress, report);
        background.join();
        look_after(progress, report);
    } catch (...) {
        progress.is_stopping = true;
        throw; // the destructor of `background` joins its thread first
    }
    background.rethrow();
}

} // namespace chasles::python
