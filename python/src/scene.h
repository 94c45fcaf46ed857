// A scene with its Python objects, shared by chasles.Scene and chasles.Stepper.
#pragma once

#include "chasles/scene/scene.h"
#include "python/src/answer.h"
#include "python/src/bind.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace chasles::python {

/// A scene with the Python objects of its bodies.
struct PythonScene {
    Scene scene;
    std::map<std::string, nb::object> shapes;
};

using Names = std::pair<std::string, std::string>;

/// The first contact of a pair of a scene; of a clear scene without a pair.
struct SceneContactAnswer : Answer {
    std::optional<Names> pair;
    std::vector<Names> simultaneous;
};

SceneContactAnswer answer_of(const PythonScene& scene, const SceneContact& contact, double margin);

std::vector<std::string> names_of(const PythonScene& scene);

/// A motion by poses in the world. `motion` is None, a motion, or the name of a kind. Without a goal the body stands
/// still.
Motion motion_of_body(nb::handle pose, nb::handle goal, nb::handle motion, nb::handle centre);

} // namespace chasles::python
