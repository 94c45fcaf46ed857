// Scenes and their answers as Python objects.
#pragma once

#include "chasles/scene/scene.h"
#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/use.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace chasles::python {

/// A call of ignore, ignore_groups, set_margin or set_group_margin: the name of the function and its two names.
using SceneRule = std::tuple<std::string, std::string, std::string>;

/// A question that a scene has answered. A page shows the whole answer, with the scene as it was then.
struct SceneQuestion {
    std::uint64_t scene = 0; ///< the state that it was in (Use::state)
    double margin = 0;
    double until = 1;
    std::size_t contacts = 0; ///< in the answer of all_contacts
};

/// A scene with the Python objects of its bodies, and with what is needed to make it again.
struct PythonScene {
    Scene scene;
    std::map<std::string, nb::object> shapes;
    std::map<std::string, PlainMotion> motions; ///< of each body
    std::map<SceneRule, double> rules;          ///< with the margin, or 0
    mutable Use use = {};
    /// The last question for all contacts that found none: an empty list does not tell whose answer it is.
    mutable std::shared_ptr<const SceneQuestion> without_contacts = {};

    /// A question or a change of the scene begins. Throws InvalidInput.
    [[nodiscard]] Asking asking() const { return {use, "scene"}; }
    [[nodiscard]] Changing changing() { return {use, "scene"}; }
};

/// Of the moving and of the fixed body.
using Names = std::pair<std::string, std::string>;

struct NamedContact {
    Names pair;
    FirstContact found;
};

/// The shapes stay when the collector clears the motions.
template <typename Visit>
void for_each_reference(PythonScene& scene, const Visit& visit) {
    for (auto& [name, motion] : scene.motions)
        for_each_reference(motion, visit);
}

/// The first contact of a pair of a scene; of a clear scene without a pair.
struct SceneContactAnswer : Answer {
    std::optional<Names> pair;
    bool is_first = false; ///< of all pairs: the answer of first_contact
    std::vector<NamedContact> simultaneous = {};
    UntestedPairs untested = {};                        ///< of the answer of first_contact
    std::shared_ptr<const SceneQuestion> question = {}; ///< null: of a stepper, whose bodies may move otherwise
};

/// The least distances of all pairs of a scene, with the names of its bodies at that time.
struct PythonMatrix {
    std::vector<std::string> names;
    DistanceMatrix found;
    nb::object answers = nb::list(); ///< a LeastDistance for each pair
    std::uint64_t scene = 0;         ///< the state that it was in
};

template <typename Visit>
void for_each_reference(PythonMatrix& matrix, const Visit& visit) {
    visit(matrix.answers);
}

/// The motion of one body as seen from another one.
PlainMotion relative_motion(const PythonScene& scene, const std::string& moving, const std::string& fixed);

/// The LeastDistance of the nearest pair, or None.
nb::object scene_distance(const PythonScene& scene, double tolerance, nb::handle find);

SceneContactAnswer answer_of(const PythonScene& scene, const SceneContact& contact, double margin);

std::vector<std::string> names_of(const PythonScene& scene);

/// A motion by poses in the world. `motion` is None, a motion, or the name of a kind. Without a goal the body stands
/// still.
PlainMotion motion_of_body(nb::handle pose, nb::handle goal, nb::handle motion, nb::handle centre);

/// DistanceMatrix, and the question for it.
void bind_distance_matrix(nb::module_& module, nb::class_<PythonScene>& scene);

/// Pickle of scenes.
void bind_scene_state(nb::class_<PythonScene>& type);

} // namespace chasles::python
