// chasles._core.view_page: the page of an answer. python/chasles/view.py writes it to a file.
#include "chasles/base/invalid_input.h"
#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/query_options.h"
#include "view/page.h"

#include <nanobind/stl/string.h>

namespace chasles::python {

namespace nb = nanobind;

namespace {

using namespace nb::literals;

std::string view_page(const Answer& answer, const std::string& title, const std::string& moving_name,
                      const std::string& fixed_name) {
    const Motion motion = plain(answer.motion);
    const view::MotionNumbers numbers = std::visit(
        [](const auto& typed) -> view::MotionNumbers {
            if constexpr (requires { view::numbers_of(typed); })
                return view::numbers_of(typed);
            else
                throw InvalidInput(
                    "view: shows screws, sweeps, constant velocity and constant twist; Scene.view shows scenes");
        },
        answer.motion);
    const view::Scene scene{.moving = nb::cast<const Body&>(answer.moving).polyhedron,
                            .fixed = nb::cast<const Body&>(answer.fixed).polyhedron,
                            .motion = motion,
                            .numbers = numbers,
                            .found = answer.found,
                            .margin = answer.margin,
                            .title = title,
                            .moving_name = moving_name,
                            .fixed_name = fixed_name};
    const nb::gil_scoped_release release;
    return view::page(scene);
}

} // namespace

void bind_view(nb::module_& module) {
    module.def("view_page", view_page, "found"_a, "title"_a, "moving_name"_a, "fixed_name"_a,
               "A page of HTML in UTF-8 that shows the answer. The page needs no network.");
}

} // namespace chasles::python
