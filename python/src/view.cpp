// chasles._core.view_page: the page of an answer; chasles/view.py writes it.
#include "view/page.h"
#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/query_options.h"

#include <nanobind/stl/string.h>

namespace chasles::python {

namespace nb = nanobind;

namespace {

using namespace nb::literals;

std::string view_page(const Answer& answer, const std::string& title, const std::string& moving_name,
                      const std::string& fixed_name, double max_turn, double margin) {
    const view::Scene scene{.moving = nb::cast<const Body&>(answer.moving).polyhedron,
                            .fixed = nb::cast<const Body&>(answer.fixed).polyhedron,
                            .motion = answer.motion,
                            .found = answer.found,
                            .max_turn = max_turn,
                            .margin = margin,
                            .title = title,
                            .moving_name = moving_name,
                            .fixed_name = fixed_name};
    const nb::gil_scoped_release release;
    return view::page(scene);
}

} // namespace

void bind_view(nb::module_& module) {
    module.def("view_page", view_page, "found"_a, "title"_a, "moving_name"_a, "fixed_name"_a, nb::kw_only(),
               "max_turn"_a = default_max_turn, "margin"_a = 0.0,
               "A page of HTML, in UTF-8, that shows the answer; needs no network.");
}

} // namespace chasles::python
