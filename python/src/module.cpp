// The extension module chasles._core. The package chasles is what users import.
#include "chasles/invalid_input.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"

NB_MODULE(_core, module) {
    namespace python = chasles::python;
    module.attr("__version__") = CHASLES_VERSION;
    module.doc() = "The compiled part of chasles: import chasles instead.";
    auto invalid_input = nanobind::exception<chasles::InvalidInput>(module, "InvalidInput", PyExc_ValueError);
    invalid_input.attr("__doc__") = python::doc("InvalidInput");
    python::bind_polyhedron(module);
    python::bind_motions(module);
    python::bind_contacts(module);
    python::bind_answers(module);
    python::bind_queries(module);
    python::bind_batches(module);
    python::bind_view(module);
    python::bind_timing(module);
}
