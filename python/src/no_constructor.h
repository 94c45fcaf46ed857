// Types whose objects are made by functions with names: a call of the type says which.
#pragma once

#include <nanobind/nanobind.h>
#include <string>

namespace chasles::python {

/// `makers` is what makes an object, as in "ScrewMotion.between(start, goal) makes one".
template <typename T>
void refuse_constructor(nanobind::class_<T>& type, const char* makers) {
    type.def(
        "__init__",
        [makers](nanobind::pointer_and_handle<T> object, const nanobind::args&, const nanobind::kwargs&) {
            const auto name = nanobind::cast<std::string>(object.h.type().attr("__name__"));
            throw nanobind::type_error(("chasles." + name + " has no constructor: " + makers).c_str());
        },
        nanobind::sig("def __init__(self, *args: typing.Any, **options: typing.Any) -> None"),
        "Refused: the functions of the type make its objects.");
}

} // namespace chasles::python
