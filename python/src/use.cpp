// chasles._core._Use: the same for objects that are written in Python (python/chasles/in_use.py).
#include "python/src/use.h"

#include "python/src/bind.h"

#include <nanobind/stl/string.h>

namespace chasles::python {

void bind_use(nanobind::module_& module) {
    using namespace nanobind::literals;
    nanobind::class_<Use>(module, "_Use")
        .def(nanobind::init<>())
        .def("begin_question", &Use::begin_question, "what"_a)
        .def("end_question", &Use::end_question)
        .def("begin_change", &Use::begin_change, "what"_a)
        .def("end_change", [](Use& use) { use.end_change(false); });
}

} // namespace chasles::python
