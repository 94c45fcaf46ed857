// chasles.Robot and chasles.PairProof.
#include "python/src/robot.h"

#include "chasles/base/invalid_input.h"
#include "python/src/body.h"
#include "python/src/docstrings.h"
#include "python/src/interruptible.h"
#include "python/src/names.h"
#include "python/src/poses.h"
#include "python/src/profile.h"
#include "python/src/query_options.h"
#include "python/src/scene.h"
#include "view/names.h"

#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

PythonRobot load(const std::filesystem::path& urdf, const std::optional<std::filesystem::path>& srdf,
                 const std::map<std::string, std::filesystem::path>& packages, double primitive_deviation,
                 nb::handle solid, double radius) {
    return {Robot::load(
        urdf, {srdf.value_or(std::filesystem::path()), packages, primitive_deviation, solid_from(solid), radius})};
}

nb::object limits_of(const PythonRobot& robot) {
    std::vector<double> limits;
    for (const RobotVariable& variable : robot.variables()) {
        limits.push_back(variable.lower);
        limits.push_back(variable.upper);
    }
    return array_of(std::span(limits), {limits.size() / 2, 2});
}

std::vector<std::string> links_of(const PythonRobot& robot) {
    std::vector<std::string> names;
    for (const LinkDescription& link : robot.description().links)
        names.push_back(link.name);
    return names;
}

nb::list collisions_of(const PythonRobot& robot, const std::string& link) {
    const std::vector<LinkDescription>& links = robot.description().links;
    const auto found = std::ranges::find(links, link, &LinkDescription::name);
    if (found == links.end())
        throw InvalidInput("robot: " + link + ": there is no such link");
    nb::list shapes;
    for (const CollisionDescription& shape : found->collisions)
        shapes.append(nb::make_tuple(nb::cast(Body{shape.shape}), matrix_of(shape.origin), shape.deviation));
    return shapes;
}

nb::dict link_poses(const PythonRobot& robot, nb::handle configuration) {
    const std::vector<Pose> poses = robot.link_poses(configuration_from(configuration, "configuration"));
    nb::dict by_name;
    for (std::size_t i = 0; i < poses.size(); ++i)
        by_name[robot.description().links[i].name.c_str()] = matrix_of(poses[i]);
    return by_name;
}

void attach(PythonRobot& robot, const std::string& name, const std::string& link, nb::handle shape, nb::handle pose,
            const std::vector<std::string>& touch_links) {
    const Changing change = robot.changing();
    robot.attach(
        {name, link, polyhedron_of(shape, "shape"), pose.is_none() ? Pose() : pose_from(pose, "pose"), touch_links});
}

struct PythonProof {
    PairProof proof;
    [[nodiscard]] std::pair<std::string, std::string> links() const { return {proof.first, proof.second}; }
};

nb::list proofs_of(const PythonRobot& robot, double seconds, unsigned threads, nb::handle report) {
    const Asking question = robot.asking();
    std::vector<PairProof> proofs;
    run_interruptibly(
        [&](Progress& progress) {
            PairProofOptions options{seconds, threads};
            options.progress = [&](std::size_t done, std::size_t) {
                progress.done = done;
                return true;
            };
            proofs = prove_pairs(robot, options);
        },
        report);
    nb::list list;
    for (PairProof& proof : proofs)
        list.append(nb::cast(PythonProof{std::move(proof)}));
    return list;
}

/// A function of the robot with two names.
auto of_pair(void (Robot::*function)(std::string_view, std::string_view)) {
    return [function](PythonRobot& robot, const std::string& a, const std::string& b) {
        const Changing change = robot.changing();
        (robot.*function)(a, b);
    };
}

void bind_proof(nb::module_& module) {
    nb::class_<PythonProof>(module, "PairProof", doc("PairProof"))
        .def_prop_ro("links", &PythonProof::links, "The names of the two links.")
        .def_prop_ro(
            "reason", [](const PythonProof& p) { return std::string(view::name_of(p.proof.reason)); },
            "'never', 'always', 'adjacent', 'sometimes' or 'open'.")
        .def_prop_ro(
            "witness", [](const PythonProof& p) { return p.proof.witness ? array_of(*p.proof.witness) : nb::none(); },
            nb::sig("def witness(self) -> " CHASLES_ARRAY " | None"), doc("PairProof.witness"))
        .def_prop_ro(
            "cells", [](const PythonProof& p) { return p.proof.cells; }, doc("PairProof.cells"))
        .def_prop_ro(
            "tried", [](const PythonProof& p) { return p.proof.tried; }, doc("PairProof.tried"))
        .def_prop_ro(
            "touching", [](const PythonProof& p) { return p.proof.touching; }, doc("PairProof.touching"))
        .def_prop_ro(
            "seconds", [](const PythonProof& p) { return p.proof.seconds; }, "Spent on this pair.")
        .def("__repr__", [](const PythonProof& p) {
            return fmt::format("<chasles.PairProof: {} and {}: {}>", p.proof.first, p.proof.second,
                               view::name_of(p.proof.reason));
        });
}

constexpr const char* clearance_doc =
    "How near the robot comes to its world and to itself along the straight edge.\n\nParameters\n----------\n"
    "start, goal : array (variables,)\n    Configurations, in the order of `variables`: radians, or the mesh unit.\n"
    "scene : Scene, optional\n    The world; without it the robot itself only.\ntolerance : float\n    Width of the "
    "bracket to aim for, as a part of the distance; in [1e-12, 1].\n\nReturns\n-------\nRobotClearance\n\nRaises\n"
    "------\nInvalidInput\n    As first_contact.";

constexpr const char* question_doc =
    "\n\nParameters\n----------\nstart, goal : array (variables,)\n    Configurations, in the order of "
    "`variables`: radians, or the mesh unit.\nscene : Scene, optional\n    The world; without it the robot is tested "
    "against itself only.\nmargin : float\n    Distance that counts as contact, mesh unit.\nhold : float, optional\n"
    "    What is within its margin where a segment begins may move on, but comes no nearer than this.\n"
    "time_tolerance : float\n"
    "    Width of the bracket to aim for.\nfind : Find or str\n    'first', 'first_with_all_contacts' or 'any'.\n\n"
    "Returns\n-------\nRobotContact\n\nRaises\n------\nInvalidInput\n    For a wrong number of values, NaN, or a value "
    "beyond 1000 (take whole turns off an angle, or choose a larger unit). Limits of joints are not checked.";

} // namespace

#define CHASLES_ROBOT_QUESTION                                                                                         \
    "*, scene: Scene | None = None, margin: float = 0.0, hold: float | None = None, time_tolerance: float = "          \
    "1e-12, " CHASLES_FIND_TYPE

void bind_robot(nb::module_& module) {
    static const std::string edge_doc =
        std::string("The first contact along the straight edge between two configurations. Many questions are faster "
                    "with a RobotChecker.") +
        question_doc;
    static const std::string path_doc =
        std::string("The first contact along a JointPath, or along configurations (n, variables): straight from each "
                    "configuration to the next, with time stamps\nor without; with velocities by cubic splines, with "
                    "accelerations, too, by quintic ones. With stamps, times\nof the answer count in stamps, otherwise "
                    "within the segment, in [0, 1].") +
        handovers_doc;
    bind_proof(module);
    nb::class_<PythonRobot> type(module, "Robot", doc("Robot"));
    bind_robot_state(type, module);
    bind_profile(type);
    bind_robot_ranges(type, module);
    bind_together(type);
    bind_robot_page(module);
    type.def_static("load", load, "urdf"_a, "srdf"_a = nb::none(), "packages"_a = nb::dict(),
                    "primitive_deviation"_a = 0.01, "solid"_a.none() = "automatic", "radius"_a = 0.0,
                    nb::sig("def load(urdf: str | os.PathLike, srdf: str | os.PathLike | None = None, "
                            "packages: dict[str, str | os.PathLike] = {}, primitive_deviation: float = 0.01, "
                            "solid: str = 'automatic', radius: float = 0.0) -> Robot"),
                    doc("Robot.load"))
        .def_prop_ro(
            "name", [](const PythonRobot& r) { return r.description().name; }, "Of the URDF file.")
        .def_prop_ro(
            "variables", [](const PythonRobot& r) { return names_of(r); },
            "The names of the numbers of a configuration, in order.")
        .def_prop_ro("limits", limits_of, nb::sig("def limits(self) -> " CHASLES_ARRAY),
                     "Lower and upper limit of each variable, (variables, 2); infinite without a limit.")
        .def_prop_ro(
            "continuous",
            [](const PythonRobot& r) {
                nb::list found;
                for (const RobotVariable& variable : r.variables())
                    found.append(variable.is_continuous);
                return found;
            },
            nb::sig("def continuous(self) -> list[bool]"),
            "Of each variable, whether values that differ by 2 pi are the same configuration: an angle without limits, "
            "if each joint that follows it\nis where it was after a turn.")
        .def_prop_ro("links", links_of, "The names of the links.")
        .def_prop_ro(
            "warnings", [](const PythonRobot& r) { return r.warnings(); }, doc("Robot.warnings"))
        .def(
            "warnings_about",
            [](const PythonRobot& r, nb::handle configurations) {
                return r.warnings_about(rows_of(configurations, "configurations"));
            },
            "configurations"_a.none(),
            nb::sig("def warnings_about(self, configurations: numpy.typing.ArrayLike) -> list[str]"),
            doc("Robot.warnings_about"))
        .def(
            "shape",
            [](const PythonRobot& r, nb::handle configuration, nb::handle solid, double radius) {
                return Body{
                    r.shape(configuration.is_none() ? r.neutral() : configuration_from(configuration, "configuration"),
                            {.solid = solid_from(solid), .radius = radius})};
            },
            "configuration"_a = nb::none(), "solid"_a.none() = "automatic", "radius"_a = 0.0,
            nb::sig("def shape(self, configuration: numpy.typing.ArrayLike | None = None, solid: str = 'automatic', "
                    "radius: float = 0.0) -> Polyhedron"),
            doc("Robot.shape"))
        .def("collisions", collisions_of, "link"_a,
             nb::sig("def collisions(self, link: str) -> list[tuple[Polyhedron, " CHASLES_ARRAY ", float]]"),
             "The shapes of a link: each with its pose in the frame of the link, (4, 4), and with the deviation by "
             "which "
             "it\nencloses a round body, mesh unit.\n\nRaises\n------\nInvalidInput\n    For an unknown link.")
        .def(
            "neutral", [](const PythonRobot& r) { return array_of(r.neutral()); },
            nb::sig("def neutral(self) -> " CHASLES_ARRAY), doc("Robot.neutral"))
        .def(
            "state",
            [](const PythonRobot& r, const std::string& name, const std::string& group) {
                return array_of(r.state(name, group));
            },
            "name"_a, "group"_a = "", nb::sig("def state(self, name: str, group: str = '') -> " CHASLES_ARRAY),
            doc("Robot.state"))
        .def(
            "link_pose",
            [](const PythonRobot& r, const std::string& link, nb::handle configuration) {
                return matrix_of(r.link_pose(link, configuration_from(configuration, "configuration")));
            },
            "link"_a, "configuration"_a.none(),
            nb::sig("def link_pose(self, link: str, configuration: numpy.typing.ArrayLike) -> " CHASLES_ARRAY),
            "The pose of a link in the world, (4, 4).")
        .def("link_poses", link_poses, "configuration"_a.none(),
             nb::sig("def link_poses(self, configuration: numpy.typing.ArrayLike) -> dict[str, " CHASLES_ARRAY "]"),
             "The poses of all links by name.")
        .def(
            "set_base",
            [](PythonRobot& r, nb::handle pose) {
                const Changing change = r.changing();
                r.set_base(pose_from(pose, "pose"));
            },
            "pose"_a.none(), nb::sig("def set_base(self, pose: numpy.typing.ArrayLike) -> None"), doc("Robot.set_base"))
        .def("attach", attach, "name"_a, "link"_a, "shape"_a.none(), "pose"_a = nb::none(),
             "touch_links"_a = nb::list(),
             nb::sig("def attach(self, name: str, link: str, shape: Polyhedron, "
                     "pose: numpy.typing.ArrayLike | None = None, touch_links: list[str] = []) -> None"),
             doc("Robot.attach"))
        .def(
            "detach",
            [](PythonRobot& r, const std::string& name) {
                const Changing change = r.changing();
                r.detach(name);
            },
            "name"_a, doc("Robot.detach"))
        .def("ignore", of_pair(&Robot::ignore), "first"_a, "second"_a, doc("Robot.ignore"))
        .def("test", of_pair(&Robot::test), "first"_a, "second"_a, doc("Robot.test"))
        .def(
            "is_tested",
            [](const PythonRobot& r, const std::string& a, const std::string& b) { return r.is_tested(a, b); },
            "first"_a, "second"_a, "Whether two links or parts are tested against each other.")
        .def(
            "tested_pairs", [](const PythonRobot& r) { return r.tested_pairs(); }, doc("Robot.tested_pairs"))
        .def("ignore_in_scene", of_pair(&Robot::ignore_in_scene), "link"_a, "body"_a, doc("Robot.ignore_in_scene"))
        .def(
            "set_margin",
            [](PythonRobot& r, const std::string& a, const std::string& b, double margin) {
                const Changing change = r.changing();
                r.set_margin(a, b, margin);
            },
            "first"_a, "second"_a, "margin"_a, doc("Robot.set_margin"))
        .def(
            "first_contact",
            [](const PythonRobot& r, nb::handle start, nb::handle goal, nb::handle scene, double margin,
               std::optional<double> hold, double tolerance, nb::handle find) {
                const Asking question = r.asking();
                return answer_on_edge(checker_of(r, {scene, margin, hold, tolerance, find}), start, goal);
            },
            "start"_a.none(), "goal"_a = nb::none(), nb::kw_only(), "scene"_a = nb::none(), "margin"_a = 0.0,
            "hold"_a = nb::none(), "time_tolerance"_a = default_time_tolerance, "find"_a.none() = "first",
            nb::sig("def first_contact(self, start: numpy.typing.ArrayLike, goal: "
                    "numpy.typing.ArrayLike, " CHASLES_ROBOT_QUESTION ") -> RobotContact"),
            edge_doc.c_str())
        .def(
            "first_contact_on_path",
            [](const PythonRobot& r, nb::handle configurations, nb::handle times, nb::handle velocities,
               nb::handle accelerations, nb::handle scene, double margin, std::optional<double> hold, double tolerance,
               nb::handle find, nb::handle handovers) {
                const Asking question = r.asking();
                return answer_on_path(checker_of(r, {scene, margin, hold, tolerance, find}),
                                      {configurations, times, velocities, accelerations, handovers});
            },
            "configurations"_a.none(), "times"_a = nb::none(), "velocities"_a = nb::none(),
            "accelerations"_a = nb::none(), nb::kw_only(), "scene"_a = nb::none(), "margin"_a = 0.0,
            "hold"_a = nb::none(), "time_tolerance"_a = default_time_tolerance, "find"_a.none() = "first",
            "handovers"_a.none() = nb::make_tuple(),
            nb::sig("def first_contact_on_path(self, configurations: numpy.typing.ArrayLike | JointPath, "
                    "times: numpy.typing.ArrayLike | None = None, velocities: numpy.typing.ArrayLike | None = None, "
                    "accelerations: numpy.typing.ArrayLike | None = None, " CHASLES_ROBOT_QUESTION
                    ", " CHASLES_HANDOVERS ") -> RobotContact"),
            path_doc.c_str())
        .def(
            "least_distance",
            [](const PythonRobot& r, nb::handle start, nb::handle goal, nb::handle scene, double tolerance) {
                const Asking question = r.asking();
                const nb::str find("first");
                return clearance_on_edge(checker_of(r, {scene, 0, std::nullopt, default_time_tolerance, find}), start,
                                         goal, tolerance);
            },
            "start"_a.none(), "goal"_a = nb::none(), nb::kw_only(), "scene"_a = nb::none(),
            "tolerance"_a = default_tolerance,
            nb::sig("def least_distance(self, start: numpy.typing.ArrayLike, goal: numpy.typing.ArrayLike, *, "
                    "scene: Scene | None = None, tolerance: float = 1e-6) -> RobotClearance"),
            clearance_doc)
        .def("prove_pairs", proofs_of, "seconds"_a = 600.0, "threads"_a = 0, "progress"_a = nb::none(),
             nb::sig("def prove_pairs(self, seconds: float = 600.0, threads: int = 0, progress: "
                     "collections.abc.Callable[[int], object] | None = None) -> list[PairProof]"),
             doc("prove_pairs"))
        .def("__repr__", [](const PythonRobot& r) {
            return fmt::format("<chasles.Robot: {}, {} links, {} variables>", r.description().name,
                               r.description().links.size(), r.variables().size());
        });
}

} // namespace chasles::python
