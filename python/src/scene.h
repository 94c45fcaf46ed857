// Scenes and their answers as Python objects.
#pragma once

#include "chasles/scene/scene.h"
#include "python/src/answer.h"

#include <map>
#include <optional>

namespace chasles::python {

/// A scene with the Python objects of its bodies.
struct PythonScene {
    Scene scene;
    std::map<std::string, nanobind::object> shapes;
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

} // namespace chasles::python
