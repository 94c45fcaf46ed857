// chasles.Limit and chasles.Cancelled.
#include "chasles/base/limit.h"

#include "chasles/base/invalid_input.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace chasles::python {
namespace {

using namespace nanobind::literals;
namespace nb = nanobind;

/// A limit and the block that it limits. Only its thread makes and destroys it.
struct Block {
    Limit limit;
    std::shared_ptr<const std::atomic<bool>> has_ended;

    Block(double seconds, std::shared_ptr<const std::atomic<bool>> has_ended_)
        : limit(seconds), has_ended(std::move(has_ended_)) {}
};

/// The blocks of this thread, the innermost one last.
std::vector<std::unique_ptr<Block>>& blocks_of_thread() {
    thread_local std::vector<std::unique_ptr<Block>> blocks;
    return blocks;
}

/// Each limit restores the one around it, so blocks go from the innermost one outwards.
void remove_ended_blocks() {
    std::vector<std::unique_ptr<Block>>& blocks = blocks_of_thread();
    while (!blocks.empty() && *blocks.back()->has_ended)
        blocks.pop_back();
}

/// A limit of the thread inside a `with` block.
class PythonLimit {
public:
    explicit PythonLimit(double seconds) : seconds_(seconds) {
        if (!(seconds > 0))
            throw InvalidInput("seconds: must be positive");
    }
    ~PythonLimit() { leave(); }
    PythonLimit(const PythonLimit&) = delete;
    PythonLimit& operator=(const PythonLimit&) = delete;

    PythonLimit& enter() {
        if (has_ended_)
            throw InvalidInput("limit: is in use; each `with` needs one of its own");
        remove_ended_blocks();
        has_ended_ = std::make_shared<std::atomic<bool>>(false);
        thread_ = std::this_thread::get_id();
        block_ = blocks_of_thread().emplace_back(std::make_unique<Block>(seconds_, has_ended_)).get();
        return *this;
    }
    void exit() {
        if (!has_ended_)
            return;
        const bool is_of_this_thread = thread_ == std::this_thread::get_id();
        const bool is_innermost = is_of_this_thread && blocks_of_thread().back().get() == block_;
        leave();
        if (!is_of_this_thread)
            throw InvalidInput("limit: ends in another thread than it began in; it limits the questions of that thread "
                               "until that thread begins or ends another limit");
        if (!is_innermost)
            throw InvalidInput("limit: ends before a limit that began inside of it, and holds as long as that one; end "
                               "limits in the opposite order, as `with` does");
    }
    [[nodiscard]] bool is_over() const {
        return has_ended_ && thread_ == std::this_thread::get_id() && block_->limit.is_over();
    }

private:
    void leave() {
        if (!has_ended_)
            return;
        *has_ended_ = true;
        has_ended_ = nullptr;
        remove_ended_blocks();
    }

    double seconds_;
    std::shared_ptr<std::atomic<bool>> has_ended_; ///< of the block; null outside of it
    std::thread::id thread_;
    const Block* block_ = nullptr;
};

} // namespace

void bind_limit(nb::module_& module) {
    nb::exception<Cancelled>(module, "Cancelled", PyExc_RuntimeError).attr("__doc__") = doc("Cancelled");
    module.attr("_why_cancelled") = Cancelled().what();
    nb::class_<PythonLimit>(
        module, "Limit",
        "A limit of time for all questions inside a `with` block of this thread::\n\n"
        "    with chasles.Limit(2.0):\n        found = scene.first_contact()\n\n"
        "A question that reaches the limit ends within milliseconds. First contacts of pairs, paths, scenes and "
        "robots\n"
        "have the verdict 'unknown' then, and `clear_until` says what is proven. Rows of batches stay unanswered. "
        "Least\n"
        "distances of pairs and robots have the bracket so far, and profiles the bounds so far, with `certain` False.\n"
        "Proofs of pairs of links stay open, and all other functions raise `Cancelled`. A limit inside another one "
        "shortens it. Ctrl-C needs no limit: it ends every question.\n\n"
        "Parameters\n----------\nseconds : float\n    Counted from the begin of the block; positive.")
        .def(nb::init<double>(), "seconds"_a)
        .def("__enter__", &PythonLimit::enter, nb::rv_policy::reference)
        .def(
            "__exit__", [](PythonLimit& limit, nb::handle, nb::handle, nb::handle) { limit.exit(); },
            "exc_type"_a.none(), "exc_value"_a.none(), "traceback"_a.none(),
            nb::sig("def __exit__(self, exc_type: object, exc_value: object, traceback: object) -> None"))
        .def_prop_ro("is_over", &PythonLimit::is_over,
                     "Whether the limit is reached; False outside of its block and in other threads.");
}

} // namespace chasles::python
