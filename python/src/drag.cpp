// chasles.DraggedBody and what its updates return.
#include "chasles/manipulation/dragged_body.h"

#include "chasles/base/invalid_input.h"
#include "python/src/docstrings.h"
#include "python/src/interruptible.h"
#include "python/src/poses.h"
#include "python/src/recipe.h"
#include "python/src/scene.h"
#include "python/src/signals.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// A step with the names of the other bodies, which the scene may lose later.
struct PythonStep {
    DragStep step;
    std::vector<std::string> names; ///< of the bodies of the scene, by their index

    [[nodiscard]] std::vector<std::string> named(const std::vector<std::size_t>& bodies) const {
        std::vector<std::string> found;
        for (const std::size_t body : bodies)
            found.push_back(names[body]);
        return found;
    }
};

struct PythonDragContact {
    std::string body;
    Contact contact;
    double force = 0;
    Eigen::Vector3d friction;
};

struct PythonDragEvent {
    bool begins = true;
    std::string body;
    Contact contact;
};

const char* name_of(DragState state) {
    switch (state) {
    case DragState::reached:
        return "reached";
    case DragState::resting:
        return "resting";
    case DragState::moving:
        return "moving";
    case DragState::touching:
        break;
    }
    return "touching";
}

nb::object wrench_of(const Eigen::Vector3d& force, const Eigen::Vector3d& torque) {
    const std::array<double, 6> numbers{force.x(), force.y(), force.z(), torque.x(), torque.y(), torque.z()};
    return array_of(numbers, {6});
}

class PythonDraggedBody {
public:
    PythonDraggedBody(nb::handle owner, PythonScene& scene, std::string name, const DragOptions& options)
        : owner_(nb::borrow(owner)), scene_(scene), name_(std::move(name)), body_(scene.scene, name_, options) {}

    PythonStep update(nb::handle goal, double seconds) {
        const Pose wanted = pose_from(goal, "goal");
        const Changing change(use_, what), of_scene(scene_.use, "scene");
        DragStep step = [&] {
            const WithoutGil without_gil; // other threads may ask for forces
            const EndsBySignals ends_by_signals;
            return body_.update(wanted, seconds);
        }();
        keep(step.pose);
        return {std::move(step), names_of(scene_)};
    }
    std::vector<PythonStep> follow(nb::handle goals, double seconds) {
        const PoseArray poses(goals, "goals");
        std::vector<PythonStep> steps;
        const Changing change(use_, what), of_scene(scene_.use, "scene");
        const std::vector<std::string> names = names_of(scene_);
        const auto keep_last = [&] {
            if (!steps.empty())
                keep(steps.back().step.pose);
        };
        try {
            run_interruptibly(
                [&](Progress& progress) {
                    for (std::size_t i = 0; i < poses.size() && !progress.is_stopping; ++i)
                        steps.push_back({body_.update(poses[i], seconds), names});
                },
                nb::none());
        } catch (...) {
            keep_last();
            throw;
        }
        keep_last();
        return steps;
    }
    [[nodiscard]] nb::object force(nb::handle wanted) const {
        const Pose goal = pose_from(wanted, "goal");
        const DragForce found = [&] {
            const WithoutGil without_gil;
            return body_.force(goal);
        }();
        return wrench_of(found.force, found.torque);
    }
    [[nodiscard]] nb::object pose() const {
        const Asking question(use_, what);
        return matrix_of(body_.pose());
    }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const DraggedBody& body() const { return body_; }

    template <typename Visit>
    friend void for_each_reference(PythonDraggedBody& body, const Visit& visit) {
        visit(body.owner_);
    }

private:
    static constexpr const char* what = "dragged body";

    /// The body rests in the scene where an update has left it.
    void keep(const Pose& pose) { scene_.motions.insert_or_assign(name_, made("rest", {listed(pose)})); }

    nb::object owner_; ///< of the scene
    PythonScene& scene_;
    std::string name_;
    DraggedBody body_;
    mutable Use use_;
};

/// The options that have a name of their own in Python.
struct Named {
    double margin = 0, reach = 0, stiffness = 1, friction = 0;
    int rounds = 8;
};

void make(PythonDraggedBody* body, nb::pointer_and_handle<PythonScene> scene, const std::string& name,
          const Named& named, const std::optional<DragLock>& lock, const std::optional<MassProperties>& mass) {
    DragOptions options;
    options.margin = named.margin;
    options.reach = named.reach;
    options.stiffness = named.stiffness;
    options.friction = named.friction;
    options.rounds = named.rounds;
    options.lock = lock.value_or(DragLock());
    options.mass = mass;
    const Asking question = scene.p->asking();
    new (body) PythonDraggedBody(scene.h, *scene.p, name, options);
}

nb::list contacts_of(const PythonStep& step) {
    nb::list list;
    for (const DragContact& contact : step.step.contacts)
        list.append(
            nb::cast(PythonDragContact{step.names[contact.body], contact.contact, contact.force, contact.friction}));
    return list;
}

nb::list events_of(const PythonStep& step) {
    nb::list list;
    for (const DragEvent& event : step.step.events)
        list.append(nb::cast(PythonDragEvent{event.begins, step.names[event.body], event.contact}));
    return list;
}

nb::list pieces_of(const PythonStep& step) {
    nb::list list;
    for (const DragPiece& piece : step.step.pieces)
        list.append(nb::make_tuple(matrix_of(piece.motion.pose_at(0)), matrix_of(piece.motion.pose_at(1)), piece.until,
                                   piece.clearance));
    return list;
}

nb::list intrusions_of(const PythonStep& step) {
    nb::list list;
    for (const DragIntrusion& intrusion : step.step.intrusions)
        list.append(nb::make_tuple(step.names[intrusion.body], intrusion.contact.time.lower));
    return list;
}

constexpr const char* body_doc =
    "A body of a scene in a hand: it stops at contacts, slides along them and lifts off, and never goes through.\n\n"
    "    hand = chasles.DraggedBody(scene, \"nut\")\n    step = hand.update(goal)\n    step.pose, step.contacts, "
    "step.wrench\n\n"
    "Each update goes along screws that are proven clear, and places the body in the scene. The other bodies stand\n"
    "where their motions end; they may be moved, added and removed between updates.\n\n"
    "Parameters\n----------\nscene : Scene\nname : str\n    Of the body in the hand.\nmargin : float\n"
    "    The gap that contacts keep, mesh unit. 0: a ten-thousandth of the diagonal of the body's box.\n"
    "reach : float\n    Contacts within it are foreseen, mesh unit; at least 1.25 times the margin, and 0: just that.\n"
    "stiffness : float\n    Force of the hand for a distance of 1 between the body and the goal.\nrounds : int\n"
    "    Certified steps of one update at most.\nfriction : float\n"
    "    Of Coulomb: the greatest friction force of a contact, as a share of its normal force. The body rests where\n"
    "    friction can hold it.\nlock : DragLock, optional\n    The body moves only as the lock lets it.\n"
    "mass : MassProperties, optional\n    How hard turning is against shifting; by default as for the solid box around "
    "the body.\n\n"
    "Raises\n------\nInvalidInput\n    For an unknown name, and for an option out of its range.";

constexpr const char* force_doc =
    "The force on the hand for another goal, from the contacts and the pose that the last update ended with.\n\n"
    "No geometry is computed. Another thread may call this while `update` or `follow` runs.\n\n"
    "Parameters\n----------\ngoal : array (4, 4) or (7,)\n\nReturns\n-------\narray (6,)\n"
    "    The sum of the forces of the contacts, and their torque about the body's origin, in the world.\n\n"
    "Raises\n------\nInvalidInput\n    For a goal that cannot be used.";

constexpr const char* update_doc =
    "Go towards the goal as far as contacts, rounds and time allow.\n\n"
    "Parameters\n----------\ngoal : array (4, 4) or (7,)\n    The pose that the hand wants.\nseconds : float\n"
    "    No round begins after so much time, and each goes less far where its search gets long; 0: no bound.\n\n"
    "Raises\n------\nInvalidInput\n    For a goal that cannot be used, and if the body is no longer in the scene.";

constexpr const char* follow_doc =
    "A whole recorded hand: an update for each goal. Ctrl-C stops it between two updates.\n\n"
    "Parameters\n----------\ngoals : array (n, 4, 4) or (n, 7)\nseconds : float\n    Of each update, as in "
    "`update`.\n\n"
    "Raises\n------\nInvalidInput\n    As `update`.";

void bind_parts(nb::module_& module) {
    nb::class_<PythonDragContact>(module, "DragContact", doc("DragContact"))
        .def_ro("body", &PythonDragContact::body, "Name of the other body.")
        .def_ro("contact", &PythonDragContact::contact, doc("DragContact.contact"))
        .def_ro("force", &PythonDragContact::force, doc("DragContact.force"))
        .def_prop_ro(
            "friction", [](const PythonDragContact& c) { return array_of(c.friction); },
            nb::sig("def friction(self) -> numpy.typing.NDArray[numpy.float64]"),
            "Force on the dragged body across the normal, in the world, as an array (3,).");
    nb::class_<PythonDragEvent>(module, "DragEvent", doc("DragEvent"))
        .def_ro("begins", &PythonDragEvent::begins, "False for a contact that has ended.")
        .def_ro("body", &PythonDragEvent::body, "Name of the other body.")
        .def_ro("contact", &PythonDragEvent::contact, doc("DragEvent.contact"));
}

void bind_step(nb::module_& module) {
    nb::class_<PythonStep>(module, "DragStep", doc("DragStep"))
        .def_prop_ro(
            "pose", [](const PythonStep& s) { return matrix_of(s.step.pose); },
            nb::sig("def pose(self) -> numpy.typing.NDArray[numpy.float64]"), "The pose reached, as an array (4, 4).")
        .def_prop_ro(
            "state", [](const PythonStep& s) { return name_of(s.step.state); },
            "\"reached\": the pose is the goal. \"resting\": the contacts hold the body. \"moving\": the rounds or the "
            "time\nare used up. \"touching\": another body is so near, or overlaps, from the\n"
            "start or since it came, that nothing can be kept apart; nothing moves.")
        .def_prop_ro("contacts", contacts_of, nb::sig("def contacts(self) -> list[DragContact]"),
                     doc("DragStep.contacts"))
        .def_prop_ro("events", events_of, nb::sig("def events(self) -> list[DragEvent]"),
                     "Contacts that were not there after the update before, or are no longer there.")
        .def_prop_ro(
            "wrench", [](const PythonStep& s) { return wrench_of(s.step.force, s.step.torque); },
            nb::sig("def wrench(self) -> numpy.typing.NDArray[numpy.float64]"),
            "What the contacts push the hand with, in the world, as an array (6,): the sum of their forces, "
            "friction\nincluded, and the torque about the body's origin. What a lock takes is not a part of "
            "it.")
        .def_prop_ro(
            "distance", [](const PythonStep& s) { return s.step.distance; }, doc("DragStep.distance"))
        .def_prop_ro(
            "blocking", [](const PythonStep& s) { return s.named(s.step.blocking); },
            "Names of the bodies that push, or at which the last step ended.")
        .def_prop_ro(
            "touching", [](const PythonStep& s) { return s.named(s.step.touching); },
            "Names of the bodies that cannot be kept apart from this one.")
        .def_prop_ro("intrusions", intrusions_of, nb::sig("def intrusions(self) -> list[tuple[str, float]]"),
                     "Other bodies that came into the way while they moved and this one stood still: name, and time of "
                     "their\nmotion.")
        .def_prop_ro("pieces", pieces_of,
                     nb::sig("def pieces(self) -> list[tuple[numpy.typing.NDArray, numpy.typing.NDArray, float, "
                             "float]]"),
                     "The way, in screws: start and goal as arrays (4, 4), the time until which the screw was followed "
                     "and is\nproven clear, and the distance that was kept.")
        .def_prop_ro(
            "work", [](const PythonStep& s) { return s.step.work; }, doc("Work"))
        .def("__repr__", [](const PythonStep& s) {
            return fmt::format("<chasles.DragStep: {}, {} contacts, {:.6g} from the goal>", name_of(s.step.state),
                               s.step.contacts.size(), s.step.distance);
        });
}

} // namespace

void bind_drag(nb::module_& module) {
    bind_parts(module);
    bind_drag_options(module);
    bind_step(module);
    nb::class_<PythonDraggedBody>(module, "DraggedBody", body_doc, collected<PythonDraggedBody>())
        .def(
            "__init__",
            [](PythonDraggedBody* body, nb::pointer_and_handle<PythonScene> scene, const std::string& name,
               double margin, double reach, double stiffness, int rounds, double friction,
               const std::optional<DragLock>& lock, const std::optional<MassProperties>& mass) {
                make(body, scene, name, {margin, reach, stiffness, friction, rounds}, lock, mass);
            },
            "scene"_a, "name"_a, nb::kw_only(), "margin"_a = 0.0, "reach"_a = 0.0, "stiffness"_a = 1.0, "rounds"_a = 8,
            "friction"_a = 0.0, "lock"_a = nb::none(), "mass"_a = nb::none())
        .def("update", &PythonDraggedBody::update, "goal"_a.none(), "seconds"_a = 0.0,
             nb::sig("def update(self, goal: numpy.typing.ArrayLike, seconds: float = 0.0) -> DragStep"), update_doc)
        .def("follow", &PythonDraggedBody::follow, "goals"_a.none(), "seconds"_a = 0.0,
             nb::sig("def follow(self, goals: numpy.typing.ArrayLike, seconds: float = 0.0) -> list[DragStep]"),
             follow_doc)
        .def("force", &PythonDraggedBody::force, "goal"_a.none(),
             nb::sig("def force(self, goal: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]"), force_doc)
        .def_prop_ro("pose", &PythonDraggedBody::pose, nb::sig("def pose(self) -> numpy.typing.NDArray[numpy.float64]"),
                     "The present pose, as an array (4, 4).")
        .def_prop_ro(
            "margin", [](const PythonDraggedBody& b) { return b.body().margin(); }, "The gap that contacts keep.")
        .def("__repr__", [](const PythonDraggedBody& b) { return fmt::format("<chasles.DraggedBody: {}>", b.name()); });
}

} // namespace chasles::python
