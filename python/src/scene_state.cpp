// Scenes for pickle: the arguments that made them. python/chasles/saved_scene.py makes the scene again.
#include "python/src/body.h"
#include "python/src/scene.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

namespace chasles::python {
namespace {

nb::tuple state_of(const PythonScene& scene) {
    const Asking question = scene.asking();
    nb::list bodies;
    for (const SceneBody& body : scene.scene.bodies())
        bodies.append(
            nb::make_tuple(body.name, scene.shapes.at(body.name), nb::cast(scene.motions.at(body.name)), body.group));
    return nb::make_tuple(bodies, nb::cast(scene.rules));
}

} // namespace

void bind_scene_state(nb::class_<PythonScene>& type) {
    type.def("__getstate__", state_of, nb::sig("def __getstate__(self) -> tuple"))
        .def(
            "__copy__",
            [](const PythonScene& scene) {
                const Asking question = scene.asking();
                return PythonScene(scene);
            },
            nb::sig("def __copy__(self) -> Scene"), "A scene that can be changed by itself. It shares the shapes.");
}

} // namespace chasles::python
