// Scenes and their answers as Python objects.
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

/// Of the moving and of the fixed body.
using Names = std::pair<std::string, std::string>;

struct NamedContact {
    Names pair;
    FirstContact found;
};

/// The first contact of a pair of a scene; of a clear scene without a pair.
struct SceneContactAnswer : Answer {
    std::optional<Names> pair;
    bool is_first = false; ///< of all pairs: the answer of first_contact
    std::vector<NamedContact> simultaneous = {};
};

SceneContactAnswer answer_of(const PythonScene& scene, const SceneContact& contact, double margin);

std::vector<std::string> names_of(const PythonScene& scene);

/// A motion by poses in the world. `motion` is None, a motion, or the name of a kind. Without a goal the body stands
/// still.
Motion motion_of_body(nb::handle pose, nb::handle goal, nb::handle motion, nb::handle centre);

} // namespace chasles::python
