// chasles.Stepper and chasles.StepEvent.
#include "chasles/scene/stepper.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "python/src/docstrings.h"
#include "python/src/interruptible.h"
#include "python/src/motions.h"
#include "python/src/poses.h"
#include "python/src/query_options.h"
#include "python/src/scene.h"

#include <algorithm>
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// An event with the names of its pairs.
struct PythonEvent {
    double time = 0;
    std::vector<SceneContactAnswer> contacts;
    std::vector<SceneContactAnswer> connected;
};

/// Steps through a copy of the scene, which shares shapes and motions: the scene may change afterwards.
class PythonStepper {
public:
    PythonStepper(const PythonScene& scene, const StepOptions& options)
        : scene_(copy_of(scene)), margin_(options.margin), stepper_(scene_->scene, options) {}

    std::optional<PythonEvent> advance() {
        const Changing change(use_, name);
        std::optional<StepEvent> found;
        run_interruptibly([&](Progress&) { found = stepper_.advance(); }, nb::none());
        if (!found)
            return std::nullopt;
        return PythonEvent{found->time, answers_of(found->contacts), answers_of(found->connected)};
    }
    [[nodiscard]] double time() const {
        const Asking question(use_, name);
        return stepper_.time();
    }
    [[nodiscard]] nb::object pose(const std::string& body) const {
        const Asking question(use_, name);
        return pose_now(body);
    }
    [[nodiscard]] nb::list poses() const {
        const Asking question(use_, name);
        nb::list poses;
        for (std::size_t i = 0; i < scene_->scene.bodies().size(); ++i)
            poses.append(matrix_of(stepper_.pose(i)));
        return poses;
    }
    void move(const std::string& body, nb::handle goal, nb::handle motion, nb::handle centre) {
        const Changing change(use_, name);
        std::string kind;
        const bool has_poses = motion.is_none() || nb::try_cast(motion, kind);
        const nb::object start = has_poses ? pose_now(body) : nb::object(nb::none());
        const PlainMotion way = motion_of_body(start, goal, motion, centre);
        stepper_.move(scene_->scene.index_of(body), way.motion);
        moved_ = joined(std::move(moved_), way.owners);
    }
    [[nodiscard]] std::string text() const {
        const std::string now = use_.is_changing() ? "advancing" : "at time " + time_text(stepper_.time());
        return fmt::format("<chasles.Stepper: {} bodies {}>", scene_->scene.bodies().size(), now);
    }

private:
    static constexpr const char* name = "stepper";

    static std::unique_ptr<PythonScene> copy_of(const PythonScene& scene) {
        const Asking question = scene.asking();
        return std::make_unique<PythonScene>(scene);
    }
    [[nodiscard]] nb::object pose_now(const std::string& body) const {
        return matrix_of(stepper_.pose(scene_->scene.index_of(body)));
    }
    [[nodiscard]] std::vector<SceneContactAnswer> answers_of(const std::vector<SceneContact>& pairs) const {
        std::vector<SceneContactAnswer> answers;
        for (const SceneContact& pair : pairs)
            answers.push_back(answer_of(*scene_, pair, margin_));
        return answers;
    }

    std::unique_ptr<PythonScene> scene_; ///< stays where it is: the stepper refers to it
    double margin_;
    Stepper stepper_;
    Owners moved_; ///< the functions of motions that bodies were given on the way
    mutable Use use_;

    template <typename Visit>
    friend void for_each_reference(PythonStepper& stepper, const Visit& visit) {
        for_each_reference(*stepper.scene_, visit);
        for (nb::object& motion : stepper.moved_)
            visit(motion);
    }
};

template <typename Visit>
void for_each_reference(PythonEvent& event, const Visit& visit) {
    for (std::vector<SceneContactAnswer>* list : {&event.contacts, &event.connected})
        for (SceneContactAnswer& answer : *list)
            for_each_reference(answer, visit);
}

void make(PythonStepper* stepper, const PythonScene& scene, double margin, std::optional<double> reach,
          double time_tolerance, unsigned threads) {
    if (reach && !(*reach > 0))
        throw InvalidInput("query: reach: must be at least 1.001 times the margin");
    new (stepper) PythonStepper(scene, {margin, reach.value_or(0), time_tolerance, threads});
}

nb::list list_of(const std::vector<SceneContactAnswer>& answers) {
    nb::list list;
    for (const SceneContactAnswer& answer : answers)
        list.append(nb::cast(answer));
    return list;
}

constexpr const char* stepper_doc =
    "One step of a scene, from time 0 to time 1, from contact to contact. The scene may change afterwards.\n\n"
    "    stepper = chasles.Stepper(scene, margin=1e-3)\n    while (event := stepper.advance()) is not None:\n"
    "        for contact in event.contacts:\n            stepper.move(contact.pair[0], ...)  # away from the "
    "contact\n\n"
    "Parameters\n----------\nscene : Scene\nmargin : float\n"
    "    Bodies that come as near as this touch; positive, mesh unit. Bodies that are nearer already may come half\n"
    "    as near as they are, so they can slide and roll on each other.\nreach : float, optional\n"
    "    The contact sets of an event list what is as near as this, mesh unit; twice the margin by default.\n"
    "time_tolerance : float\n    Width of the brackets to aim for.\nthreads : int\n"
    "    At most so many; 0 for all cores. The step does not depend on it.\n\n"
    "Raises\n------\nInvalidInput\n    For an option out of its range.";

constexpr const char* advance_doc =
    "Go on to the next event; None at the end of the step. Up to there all pairs that are not ignored are proven to\n"
    "stay apart: farther than the margin, or farther than half of what they had where that was less.\n\n"
    "Raises\n------\nInvalidInput\n    For bodies that are nearer than a millionth of the margin: they started there, "
    "or were not moved\n    away from each other at many events.";

constexpr const char* move_doc =
    "How a body goes on from its present pose until the end of the step: to a goal, by a motion whose time 0 is now\n"
    "and whose time 1 is the end of the step, or not at all. The arguments are those of `Scene.add`.\n\n"
    "Raises\n------\nInvalidInput\n    For a motion that starts elsewhere, and after the end of the step.";

void bind_event(nb::module_& module) {
    nb::class_<PythonEvent>(module, "StepEvent", doc("StepEvent"), collected<PythonEvent>())
        .def_ro("time", &PythonEvent::time, doc("StepEvent.time"))
        .def_prop_ro(
            "contacts", [](const PythonEvent& e) { return list_of(e.contacts); },
            nb::sig("def contacts(self) -> list[SceneContact]"), doc("StepEvent.contacts"))
        .def_prop_ro(
            "connected", [](const PythonEvent& e) { return list_of(e.connected); },
            nb::sig("def connected(self) -> list[SceneContact]"), doc("StepEvent.connected"))
        .def("__repr__", [](const PythonEvent& e) {
            std::string pairs;
            for (const SceneContactAnswer& contact : e.contacts)
                pairs +=
                    fmt::format("{}{} on {}", pairs.empty() ? "" : ", ", contact.pair->first, contact.pair->second);
            const bool is_certain = std::ranges::all_of(e.contacts, [](const auto& c) { return c.found.certain; });
            return fmt::format("<chasles.StepEvent: time {}{}, {}>", time_text(e.time),
                               is_certain ? "" : " (uncertain)", pairs);
        });
}

} // namespace

void bind_stepper(nb::module_& module) {
    bind_event(module);
    nb::class_<PythonStepper>(module, "Stepper", stepper_doc, collected<PythonStepper>())
        .def("__init__", make, "scene"_a, nb::kw_only(), "margin"_a, "reach"_a = nb::none(),
             "time_tolerance"_a = default_time_tolerance, "threads"_a = 0)
        .def("advance", &PythonStepper::advance, nb::sig("def advance(self) -> StepEvent | None"), advance_doc)
        .def_prop_ro("time", &PythonStepper::time, "Of the last event, or 1 at the end.")
        .def("pose", &PythonStepper::pose, "name"_a, nb::sig("def pose(self, name: str) -> numpy.typing.NDArray"),
             "The pose of a body now, as an array (4, 4).")
        .def("poses", &PythonStepper::poses, nb::sig("def poses(self) -> list[numpy.typing.NDArray]"),
             "The poses of all bodies now, in the order of `Scene.names`, each as an array (4, 4).")
        .def("move", &PythonStepper::move, "name"_a, "goal"_a = nb::none(), nb::kw_only(), "motion"_a = nb::none(),
             "centre"_a = nb::none(),
             nb::sig("def move(self, name: str, goal: numpy.typing.ArrayLike | None = None, *, "
                     "motion: str | ConstantVelocity | ConstantTwist | TimedPoses | Trajectory | Motion | None = None, "
                     "centre: numpy.typing.ArrayLike | None = None) -> None"),
             move_doc)
        .def("__repr__", &PythonStepper::text);
}

} // namespace chasles::python
