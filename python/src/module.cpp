// The extension module chasles._core. Users import the package chasles.
#include "chasles/base/invalid_input.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"

#include <exception>
#include <string_view>

namespace {

/// Messages contain file names, whose bytes need not be UTF-8.
void raise_invalid_input(const std::exception_ptr& error, void* type) {
    try {
        std::rethrow_exception(error);
    } catch (const chasles::InvalidInput& invalid) {
        const std::string_view what = invalid.what();
        const auto text =
            nanobind::steal(PyUnicode_DecodeUTF8(what.data(), Py_ssize_t(what.size()), "backslashreplace"));
        PyErr_SetObject(static_cast<PyObject*>(type), text.ptr());
    }
}

} // namespace

NB_MODULE(_core, module) {
    namespace python = chasles::python;
    module.attr("__version__") = CHASLES_VERSION;
    module.doc() = "The compiled part of chasles. Import chasles instead.";
    auto invalid_input = nanobind::exception<chasles::InvalidInput>(module, "InvalidInput", PyExc_ValueError);
    invalid_input.attr("__doc__") = python::doc("InvalidInput");
    nanobind::register_exception_translator(raise_invalid_input, invalid_input.ptr());
    python::bind_limit(module);
    python::bind_polyhedron(module);
    python::bind_motions(module);
    python::bind_trajectories(module);
    python::bind_own_trajectories(module);
    python::bind_contacts(module);
    python::bind_answers(module);
    python::bind_queries(module);
    python::bind_batches(module);
    python::bind_least_distance(module);
    python::bind_profile(module);
    python::bind_untested(module);
    python::bind_scene(module);
    python::bind_nearest_pair(module);
    python::bind_stepper(module);
    python::bind_joint_path(module);
    python::bind_drag(module);
    python::bind_robot(module);
    python::bind_robot_clearance(module);
    python::bind_robot_answers(module);
    python::bind_certificate(module);
    python::bind_view(module);
    python::bind_record(module);
    python::bind_timing(module);
    python::bind_end_of_process(module);
    python::bind_use(module);
}
