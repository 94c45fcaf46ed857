// chasles.Scene and chasles.SceneContact.
#include "python/src/scene.h"

#include "chasles/base/invalid_input.h"
#include "python/src/certificate.h"
#include "python/src/interruptible.h"
#include "python/src/names.h"
#include "python/src/profile.h"
#include "python/src/query_options.h"
#include "python/src/recipe.h"

#include <fmt/format.h>
#include <mutex>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// The motion of this kind between two poses.
PlainMotion motion_between(const std::string& kind, const Pose& start, const Pose& goal,
                           const Eigen::Vector3d& centre) {
    return kind == "twist" ? made("twist", {listed(start), listed(goal)})
                           : made("velocity", {listed(start), listed(goal), listed(centre)});
}

void require_kind(const std::string& kind) {
    if (kind != "velocity" && kind != "twist")
        throw InvalidInput(fmt::format("motion: {:?} is no kind of motion in a scene; velocity and twist are", kind));
}

Names names_of(const Scene& scene, const SceneContact& contact) {
    return {scene.bodies()[contact.moving].name, scene.bodies()[contact.fixed].name};
}

} // namespace

PlainMotion motion_of_body(nb::handle pose, nb::handle goal, nb::handle motion, nb::handle centre) {
    std::string kind = "velocity";
    const bool is_named = motion.is_none() || nb::try_cast(motion, kind);
    if (!is_named) {
        const TypedMotion given = given_motion(motion);
        if (!pose.is_none() || !goal.is_none() || !centre.is_none())
            throw InvalidInput("motion: stands instead of pose, goal and centre");
        return as_plain(given);
    }
    require_kind(kind);
    if (!centre.is_none() && kind == "twist")
        throw InvalidInput("centre: a twist has none");
    const Pose start = pose.is_none() ? Pose() : pose_from(pose, "pose");
    if (goal.is_none() && !(motion.is_none() && centre.is_none()))
        throw InvalidInput(std::string(motion.is_none() ? "centre" : "motion") +
                           ": is for a body that moves; without a goal it stands still");
    if (goal.is_none())
        return made("rest", {listed(start)});
    const Eigen::Vector3d middle = centre.is_none() ? Eigen::Vector3d::Zero() : vector_from(centre, "centre");
    return motion_between(kind, start, pose_from(goal, "goal"), middle);
}

std::vector<std::string> names_of(const PythonScene& scene) {
    std::vector<std::string> names;
    for (const SceneBody& body : scene.scene.bodies())
        names.push_back(body.name);
    return names;
}

PlainMotion relative_motion(const PythonScene& scene, const std::string& moving, const std::string& fixed) {
    return made("relative", {}, {scene.motions.at(moving), scene.motions.at(fixed)});
}

SceneContactAnswer answer_of(const PythonScene& scene, const SceneContact& contact, double margin) {
    const Names names = names_of(scene.scene, contact);
    return {{contact.contact, scene.shapes.at(names.first), scene.shapes.at(names.second),
             relative_motion(scene, names.first, names.second),
             scene.scene.margin_of(contact.moving, contact.fixed, margin)},
            names};
}

namespace {

std::string add(PythonScene& scene, const std::string& name, nb::handle shape, nb::handle pose, nb::handle goal,
                nb::handle motion, nb::handle centre, const std::string& group) {
    const Changing change = scene.changing();
    const PlainMotion way = motion_of_body(pose, goal, motion, centre);
    scene.scene.add({name, polyhedron_of(shape, "shape"), way.motion, group});
    scene.shapes.emplace(name, nb::borrow(shape));
    scene.motions.emplace(name, way);
    return name;
}

void remove(PythonScene& scene, const std::string& name) {
    const Changing change = scene.changing();
    scene.scene.remove(name);
    scene.shapes.erase(name);
    scene.motions.erase(name);
    std::erase_if(scene.rules, [&](const auto& entry) {
        const auto& [function, a, b] = entry.first;
        return !function.ends_with("_groups") && !function.starts_with("set_group_") && (a == name || b == name);
    });
}

void move(PythonScene& scene, const std::string& name, nb::handle pose, nb::handle goal, nb::handle motion,
          nb::handle centre) {
    const Changing change = scene.changing();
    const PlainMotion way = motion_of_body(pose, goal, motion, centre);
    scene.scene.move(scene.scene.index_of(name), way.motion);
    scene.motions.insert_or_assign(name, way);
}

/// All bodies at once, in the order of `names`. The scene changes only if all poses can be used.
void move_all(PythonScene& scene, nb::handle starts, nb::handle goals, const std::string& kind) {
    const Changing change = scene.changing();
    const PoseArray from(starts, "starts"), to(goals, "goals");
    const std::size_t count = scene.scene.bodies().size();
    if (from.size() != count || to.size() != count)
        throw InvalidInput(fmt::format("starts, goals: {} and {} poses for {} bodies", from.size(), to.size(), count));
    require_kind(kind);
    std::vector<PlainMotion> motions;
    for (std::size_t i = 0; i < count; ++i)
        try {
            motions.push_back(motion_between(kind, from[i], to[i], Eigen::Vector3d::Zero()));
        } catch (const InvalidInput& error) {
            throw InvalidInput(fmt::format("starts[{}], goals[{}]: {}", i, i, error.what()));
        }
    for (std::size_t i = 0; i < count; ++i) {
        scene.scene.move(i, motions[i].motion);
        scene.motions.insert_or_assign(scene.scene.bodies()[i].name, std::move(motions[i]));
    }
}

struct SceneArguments {
    double margin;
    std::optional<double> hold;
    double until;
    double time_tolerance;
    nb::handle find;
    unsigned threads;
};

/// `ask(query)` on another thread, which Ctrl-C ends.
template <class Ask>
void run(const SceneArguments& arguments, const Ask& ask) {
    SceneQuery query;
    query.options = {arguments.margin, arguments.hold, arguments.time_tolerance, find_from(arguments.find)};
    query.until = arguments.until;
    query.threads = arguments.threads;
    run_interruptibly(
        [&](Progress& progress) {
            query.progress = [&](std::size_t done, std::size_t) {
                progress.done = done;
                return true;
            };
            ask(query);
        },
        nb::none());
}

SceneContactAnswer first_contact(const PythonScene& scene, double margin, std::optional<double> hold, double until,
                                 double time_tolerance, nb::handle find, unsigned threads) {
    const Asking question = scene.asking();
    SceneAnswer found;
    run({margin, hold, until, time_tolerance, find, threads},
        [&](const SceneQuery& query) { found = scene.scene.first_contact(query); });
    if (found.untested.total() > 0)
        found.untested = scene.scene.untested({.until = until}); // with names
    const auto asked = std::make_shared<const SceneQuestion>(scene.use.state(), margin, until);
    if (found.contacts.empty()) {
        FirstContact clear;
        clear.verdict = found.verdict;
        clear.certain = found.verdict == Verdict::clear;
        clear.clear_until = found.clear_until;
        clear.work = found.work;
        return {{clear, nb::none(), nb::none(), made("rest", {listed(Pose())}), margin},
                std::nullopt,
                true,
                {},
                std::move(found.untested),
                asked};
    }
    SceneContactAnswer answer = answer_of(scene, found.contacts.front(), margin);
    answer.is_first = true;
    answer.question = asked;
    answer.found.clear_until = found.clear_until;
    answer.found.work = found.work;
    answer.untested = std::move(found.untested);
    for (std::size_t i = 1; i < found.contacts.size(); ++i)
        answer.simultaneous.push_back({names_of(scene.scene, found.contacts[i]), found.contacts[i].contact});
    return answer;
}

nb::list all_contacts(const PythonScene& scene, double margin, std::optional<double> hold, double until,
                      double time_tolerance, nb::handle find, unsigned threads) {
    const Asking question = scene.asking();
    SceneAnswer found;
    run({margin, hold, until, time_tolerance, find, threads},
        [&](const SceneQuery& query) { found = scene.scene.all_contacts(query); });
    throw_if_unknown(found.verdict, found.clear_until);
    const auto asked = std::make_shared<const SceneQuestion>(scene.use.state(), margin, until, found.contacts.size());
    if (found.contacts.empty())
        scene.without_contacts = asked;
    nb::list contacts;
    for (const SceneContact& contact : found.contacts) {
        SceneContactAnswer answer = answer_of(scene, contact, margin);
        answer.question = asked;
        contacts.append(nb::cast(std::move(answer)));
    }
    return contacts;
}

/// The pairs are remembered as ignored ones.
std::vector<Names> ignore_touching_at_start(PythonScene& scene, double margin) {
    const Changing change = scene.changing();
    std::vector<Names> pairs;
    scene.use.renew_state(); // an interruption may come after the change
    run_interruptibly([&](Progress&) { pairs = scene.scene.ignore_touching_at_start(margin); }, nb::none());
    for (const auto& [a, b] : pairs)
        scene.rules[{"ignore", a, b}] = 0;
    return pairs;
}

nb::dict clear_until(const PythonScene& scene, double margin, std::optional<double> hold, double until,
                     double time_tolerance, unsigned threads) {
    const Asking question = scene.asking();
    std::vector<double> clear;
    const nb::str find("first");
    run({margin, hold, until, time_tolerance, find, threads},
        [&](const SceneQuery& query) { clear = scene.scene.clear_until(query); });
    nb::dict times;
    for (std::size_t i = 0; i < clear.size(); ++i)
        times[scene.scene.bodies()[i].name.c_str()] = clear[i];
    return times;
}

constexpr const char* add_doc =
    "Add a body, and return its name.\n\nParameters\n----------\nname : str\n    Of no other body of the scene.\n"
    "shape : Polyhedron\n    Bodies may share it.\npose, goal : array (4, 4) or (7,), optional\n"
    "    Poses in the world at time 0 and 1. Without a goal the body stands still.\n"
    "motion : str or a motion, optional\n    'velocity' or 'twist' between both poses; or a motion instead of poses: "
    "any but ScrewMotion and\n    SweepMotion.\ncentre : array (3,), optional\n    The body point that 'velocity' "
    "carries "
    "along a line; the body's origin by default.\ngroup : str\n    For ignore_groups.\n\nRaises\n------\nInvalidInput\n"
    "    For a name that is empty or taken, and for poses or a motion that cannot be used.";

constexpr const char* question_doc =
    "\n\nParameters\n----------\nmargin : float\n    Distance that counts as contact, mesh unit.\n"
    "hold : float, optional\n    Bodies that start within their margin may move on, but come no nearer than "
    "this.\nuntil : float\n"
    "    Contacts that begin after this time, in [0, 1], are left out. Two bodies that both stand still are tested "
    "with "
    "0 only,\n    which makes it a question about the start.\ntime_tolerance : float\n"
    "    Width of the brackets to aim for.\nfind : Find or str\n"
    "    'first', 'first_with_all_contacts', or 'any' for a question of yes or no.\n"
    "threads : int\n    At most so many; 0 for all cores. The answer does not depend on it.\n\n";

/// A function of the scene with two names as one of its Python object, which remembers the call.
template <class Name>
auto rule(const char* name, void (Scene::*function)(Name, Name)) {
    return [name, function](PythonScene& scene, const std::string& a, const std::string& b) {
        const Changing change = scene.changing();
        (scene.scene.*function)(a, b);
        scene.rules[{name, a, b}] = 0;
    };
}

template <class Name>
auto rule(const char* name, void (Scene::*function)(Name, Name, double)) {
    return [name, function](PythonScene& scene, const std::string& a, const std::string& b, double distance) {
        const Changing change = scene.changing();
        (scene.scene.*function)(a, b, distance);
        scene.rules.erase({name, b, a}); // the same pair
        scene.rules[{name, a, b}] = distance;
    };
}

/// A clear answer is about tested pairs only, and says so.
std::string untested_note(const UntestedPairs& untested) {
    const std::size_t count = untested.total();
    return count == 0 ? "" : fmt::format(", {} {} not tested", count, count == 1 ? "pair" : "pairs");
}

void bind_contact(nb::module_& module) {
    nb::class_<SceneContactAnswer, Answer>(module, "SceneContact", doc("SceneContact"), collected<SceneContactAnswer>())
        .def_prop_ro(
            "pair",
            [](const SceneContactAnswer& a) -> nb::object {
                return a.pair ? nb::object(nb::make_tuple(a.pair->first, a.pair->second)) : nb::none();
            },
            nb::sig("def pair(self) -> tuple[str, str] | None"),
            "The names of the moving and the fixed body; None if the scene is clear.")
        .def_prop_ro(
            "simultaneous",
            [](const SceneContactAnswer& a) {
                std::vector<Names> pairs;
                for (const NamedContact& contact : a.simultaneous)
                    pairs.push_back(contact.pair);
                return pairs;
            },
            "Further pairs that may touch at the same time, as their brackets overlap.")
        .def_prop_ro(
            "untested", [](const SceneContactAnswer& a) { return a.untested; },
            "What the answer of first_contact does not look at; `Scene.untested` tells it for other questions.")
        .def_prop_ro(
            "held", [](const SceneContactAnswer& a) { return tuple_of(a.found.held); },
            nb::sig("def held(self) -> tuple[Contact, ...]"),
            "With hold: what of the pair is within the margin at time 0, in the world frame at time 0. A clear scene "
            "has no "
            "pair, and\nlists nothing here: ask first_contact of two bodies for what they hold.")
        .def("__repr__", [](const SceneContactAnswer& a) {
            const std::string pair = a.pair ? a.pair->first + " on " + a.pair->second : "";
            const bool is_clear = a.found.verdict == Verdict::clear;
            const std::string text = is_clear ? clear_until_text(a.found.clear_until) : summary(a.found, pair);
            return "<chasles.SceneContact: " + text + untested_note(a.untested) + ">";
        });
}

} // namespace

#define CHASLES_SCENE_OPTIONS                                                                                          \
    "*, margin: float = 0.0, hold: float | None = None, until: float = 1.0, time_tolerance: float = 1e-12, "

void bind_scene(nb::module_& module) {
    static const std::string first_text = std::string("The earliest contact of all pairs.") + question_doc +
                                          "Returns\n-------\nSceneContact\n    Its pair is None if the scene is clear.";
    static const std::string all_text = std::string("The first contact of each pair that touches, in order of time.") +
                                        question_doc + "Returns\n-------\nlist of SceneContact";
    bind_contact(module);
    nb::class_<PythonScene> type(module, "Scene", doc("Scene"), collected<PythonScene>());
    bind_scene_state(type);
    bind_profile(type);
    bind_certificates(type);
    bind_distance_matrix(module, type);
    type.def(nb::init<>())
        .def("add", add, "name"_a, "shape"_a.none(), "pose"_a = nb::none(), "goal"_a = nb::none(), nb::kw_only(),
             "motion"_a = nb::none(), "centre"_a = nb::none(), "group"_a = "",
             nb::sig("def add(self, name: str, shape: Polyhedron, pose: numpy.typing.ArrayLike | None = None, "
                     "goal: numpy.typing.ArrayLike | None = None, *, motion: str | ConstantVelocity | ConstantTwist | "
                     "TimedPoses | Trajectory | Motion | None = None, centre: numpy.typing.ArrayLike | None = None, "
                     "group: str = '') -> str"),
             add_doc)
        .def("remove", remove, "name"_a, "Remove a body. The last one takes its place in `names`.")
        .def("move", move, "name"_a, "pose"_a = nb::none(), "goal"_a = nb::none(), nb::kw_only(),
             "motion"_a = nb::none(), "centre"_a = nb::none(),
             nb::sig("def move(self, name: str, pose: numpy.typing.ArrayLike | None = None, "
                     "goal: numpy.typing.ArrayLike | None = None, *, motion: str | ConstantVelocity | ConstantTwist | "
                     "TimedPoses | Trajectory | Motion | None = None, "
                     "centre: numpy.typing.ArrayLike | None = None) -> None"),
             "Give a body another motion; the arguments are those of `add`.")
        .def("move_all", move_all, "starts"_a.none(), "goals"_a.none(), nb::kw_only(), "motion"_a = "velocity",
             nb::sig("def move_all(self, starts: numpy.typing.ArrayLike, goals: numpy.typing.ArrayLike, *, "
                     "motion: str = 'velocity') -> None"),
             "Give all bodies other motions: arrays (n, 4, 4) or (n, 7), in the order of `names`. Raises InvalidInput "
             "with the number of the body, and then changes nothing.")
        .def("ignore", rule("ignore", &Scene::ignore), "a"_a, "b"_a, doc("Scene.ignore"))
        .def("ignore_groups", rule("ignore_groups", &Scene::ignore_groups), "a"_a, "b"_a, doc("Scene.ignore_groups"))
        .def("ignore_touching_at_start", ignore_touching_at_start, nb::kw_only(), "margin"_a = 0.0,
             nb::sig("def ignore_touching_at_start(self, *, margin: float = 0.0) -> list[tuple[str, str]]"),
             doc("Scene.ignore_touching_at_start"))
        .def(
            "untested",
            [](const PythonScene& s, double until) {
                const Asking question = s.asking();
                return s.scene.untested({.until = until});
            },
            nb::kw_only(), "until"_a = 1.0, nb::sig("def untested(self, *, until: float = 1.0) -> UntestedPairs"),
            doc("Scene.untested"))
        .def("set_margin", rule("set_margin", &Scene::set_margin), "a"_a, "b"_a, "margin"_a, doc("Scene.set_margin"))
        .def("set_group_margin", rule("set_group_margin", &Scene::set_group_margin), "a"_a, "b"_a, "margin"_a,
             doc("Scene.set_group_margin"))
        .def("set_hold", rule("set_hold", &Scene::set_hold), "a"_a, "b"_a, "hold"_a, doc("Scene.set_hold"))
        .def("set_group_hold", rule("set_group_hold", &Scene::set_group_hold), "a"_a, "b"_a, "hold"_a,
             doc("Scene.set_group_hold"))
        .def_prop_ro( // names change with the GIL only
            "names", [](const PythonScene& s) { return names_of(s); }, "The names of the bodies.")
        .def("__len__", [](const PythonScene& s) { return s.scene.bodies().size(); })
        .def("__repr__",
             [](const PythonScene& s) { return fmt::format("<chasles.Scene: {} bodies>", s.scene.bodies().size()); })
        .def("first_contact", first_contact, nb::kw_only(), "margin"_a = 0.0, "hold"_a = nb::none(), "until"_a = 1.0,
             "time_tolerance"_a = default_time_tolerance, "find"_a.none() = "first", "threads"_a = 0,
             nb::sig("def first_contact(self, " CHASLES_SCENE_OPTIONS CHASLES_FIND_TYPE
                     ", threads: int = 0) -> SceneContact"),
             first_text.c_str())
        .def("all_contacts", all_contacts, nb::kw_only(), "margin"_a = 0.0, "hold"_a = nb::none(), "until"_a = 1.0,
             "time_tolerance"_a = default_time_tolerance, "find"_a.none() = "first", "threads"_a = 0,
             nb::sig("def all_contacts(self, " CHASLES_SCENE_OPTIONS CHASLES_FIND_TYPE
                     ", threads: int = 0) -> list[SceneContact]"),
             all_text.c_str())
        .def("least_distance", scene_distance, nb::kw_only(), "tolerance"_a = default_tolerance,
             "find"_a.none() = "first",
             nb::sig("def least_distance(self, *, tolerance: float = 1e-6, " CHASLES_FIND_TYPE
                     ") -> LeastDistance | None"),
             "The two bodies that come nearest to each other, over the whole time: their LeastDistance, with `pair`, "
             "their names. Its\nlower end holds for all pairs. Margins have no effect, and two bodies that both stand "
             "still are no pair. None if no\ntwo bodies are tested.\n\nParameters\n----------\ntolerance : float\n"
             "    Width of the bracket to aim for, as a part of the distance; in [1e-12, 1].\nfind : Find or str\n"
             "    'first': one pair of nearest features; 'first_with_all_contacts': every pair.\n\nReturns\n-------\n"
             "LeastDistance or None\n    With the bracket so far at a Limit.\n\nRaises\n------\nInvalidInput\n    For "
             "an option out "
             "of its range.\nCancelled\n    At a Limit before the first pair.")
        .def("clear_until", clear_until, nb::kw_only(), "margin"_a = 0.0, "hold"_a = nb::none(), "until"_a = 1.0,
             "time_tolerance"_a = default_time_tolerance, "threads"_a = 0,
             nb::sig("def clear_until(self, " CHASLES_SCENE_OPTIONS "threads: int = 0) -> dict[str, float]"),
             "For each body, by name, the time until which it is proven clear of all others.");
}

} // namespace chasles::python
