// Scenes for pickle: the arguments that made them. python/chasles/saved_scene.py makes the scene again.
#include "python/src/body.h"
#include "python/src/scene.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

namespace chasles::python {
namespace {

nb::object numbers_or_none(nb::handle pose, const char* name) {
    return pose.is_none() ? nb::object(nb::none()) : numbers_of(pose_from(pose, name));
}

nb::tuple state_of(const PythonScene& scene) {
    nb::list bodies;
    for (const SceneBody& body : scene.scene.bodies()) {
        const GivenMotion& given = scene.motions.at(body.name);
        bodies.append(nb::make_tuple(body.name, scene.shapes.at(body.name), given.pose, given.goal, given.motion,
                                     given.centre, body.group));
    }
    return nb::make_tuple(bodies, nb::cast(scene.rules));
}

} // namespace

GivenMotion given_copies(nb::handle pose, nb::handle goal, nb::handle motion, nb::handle centre) {
    return {numbers_or_none(pose, "pose"), numbers_or_none(goal, "goal"), nb::borrow(motion),
            centre.is_none() ? nb::object(nb::none()) : array_of(vector_from(centre, "centre"))};
}

void bind_scene_state(nb::class_<PythonScene>& type) {
    type.def("__getstate__", state_of, nb::sig("def __getstate__(self) -> tuple"));
}

} // namespace chasles::python
