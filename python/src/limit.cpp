// chasles.Limit and chasles.Cancelled.
#include "chasles/base/limit.h"

#include "chasles/base/invalid_input.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"

#include <optional>

namespace chasles::python {
namespace {

using namespace nanobind::literals;
namespace nb = nanobind;

/// A limit of the thread inside a `with` block.
class PythonLimit {
public:
    explicit PythonLimit(double seconds) : seconds_(seconds) {
        if (!(seconds > 0))
            throw InvalidInput("seconds: must be positive");
    }
    PythonLimit& enter() {
        if (limit_)
            throw InvalidInput("limit: is in use; each `with` needs one of its own");
        limit_.emplace(seconds_);
        return *this;
    }
    void exit() { limit_.reset(); }
    [[nodiscard]] bool is_over() const { return limit_ && limit_->is_over(); }

private:
    double seconds_;
    std::optional<Limit> limit_;
};

} // namespace

void bind_limit(nb::module_& module) {
    nb::exception<Cancelled>(module, "Cancelled", PyExc_RuntimeError).attr("__doc__") = doc("Cancelled");
    nb::class_<PythonLimit>(
        module, "Limit",
        "A limit of time for all questions inside a `with` block of this thread::\n\n"
        "    with chasles.Limit(2.0):\n        found = scene.first_contact()\n\n"
        "A question that reaches the limit ends within milliseconds. First contacts of pairs, paths, scenes and "
        "robots\n"
        "have the verdict 'unknown' then, and `clear_until` says what is proven. Rows of batches stay unanswered. "
        "Least\n"
        "distances of pairs have the bracket so far, proofs of pairs of links stay open, and all other functions "
        "raise\n"
        "`Cancelled`. A limit inside another one shortens it. Ctrl-C needs no limit: it ends every question.\n\n"
        "Parameters\n----------\nseconds : float\n    Counted from the begin of the block; positive.")
        .def(nb::init<double>(), "seconds"_a)
        .def("__enter__", &PythonLimit::enter, nb::rv_policy::reference)
        .def(
            "__exit__", [](PythonLimit& limit, nb::handle, nb::handle, nb::handle) { limit.exit(); },
            "exc_type"_a.none(), "exc_value"_a.none(), "traceback"_a.none(),
            nb::sig("def __exit__(self, exc_type: object, exc_value: object, traceback: object) -> None"))
        .def_prop_ro("is_over", &PythonLimit::is_over, "Whether the limit is reached; False outside of its block.");
}

} // namespace chasles::python
