// The nearest pair of a scene, and the compiled part of the distances of chasles.CollisionManager.
#include "chasles/scene/nearest_pair.h"

#include "chasles/base/limit_of_thread.h"
#include "python/src/interruptible.h"
#include "python/src/names.h"
#include "python/src/scene.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

std::vector<std::size_t> indices_of(const Scene& scene, const std::vector<std::string>& names) {
    std::vector<std::size_t> indices;
    for (const std::string& name : names)
        indices.push_back(scene.index_of(name));
    return indices;
}

/// A LeastDistance with the names of its pair, or None.
nb::object answer_of(const PythonScene& given, SceneDistance found) {
    if (!found.pair)
        return nb::none();
    const SceneBody& moving = given.scene.bodies()[found.pair->first];
    const SceneBody& fixed = given.scene.bodies()[found.pair->second];
    LeastAnswer answer{std::move(found.nearest), given.shapes.at(moving.name), given.shapes.at(fixed.name),
                       relative_motion(given, moving.name, fixed.name)};
    answer.pair = {moving.name, fixed.name};
    return nb::cast(std::move(answer));
}

nb::object nearest_pair(const PythonScene& given, const std::vector<std::string>& first,
                        const std::optional<std::vector<std::string>>& second, double tolerance) {
    const Asking question = given.asking();
    const Scene& scene = given.scene;
    scene::NearestPairQuery query{.pairs = {.first = indices_of(scene, first)}, .options = {.tolerance = tolerance}};
    if (second)
        query.pairs.second = indices_of(scene, *second);
    SceneDistance found;
    run_interruptibly(
        [&](Progress&) {
            found = scene::nearest_pair(scene, query);
            throw_if_cancelled(); // then another pair may be nearer
        },
        nb::none());
    return answer_of(given, std::move(found));
}

} // namespace

nb::object scene_distance(const PythonScene& given, double tolerance, nb::handle find) {
    const Asking question = given.asking();
    const LeastDistanceOptions options{.tolerance = tolerance, .find = find_from(find)};
    SceneDistance found;
    run_interruptibly(
        [&](Progress&) {
            found = given.scene.least_distance(options);
            if (!found.pair)
                throw_if_cancelled(); // then there may be pairs
        },
        nb::none());
    return answer_of(given, std::move(found));
}

void bind_nearest_pair(nb::module_& module) {
    module.def("_nearest_pair", nearest_pair, "scene"_a, "first"_a, "second"_a = nb::none(), nb::kw_only(),
               "tolerance"_a,
               nb::sig("def _nearest_pair(scene: Scene, first: list[str], second: list[str] | None = None, *, "
                       "tolerance: float) -> LeastDistance | None"));
}

} // namespace chasles::python
