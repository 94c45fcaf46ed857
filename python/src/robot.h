// Robots and their answers as Python objects.
#pragma once

#include "chasles/robot/pair_proof.h"
#include "chasles/robot/robot.h"
#include "python/src/arrays.h"
#include "python/src/bind.h"
#include "python/src/computed_once.h"
#include "python/src/interruptible.h"
#include "python/src/signals.h"
#include "python/src/use.h"

#include <optional>
#include <string>
#include <vector>

namespace chasles::python {

/// A robot that knows whether it is in use.
struct PythonRobot : Robot {
    PythonRobot(Robot robot) : Robot(std::move(robot)) {} // NOLINT(google-explicit-constructor): it is one

    mutable Use use;

    /// A question or a change of the robot begins. Throws InvalidInput.
    [[nodiscard]] Asking asking() const { return {use, "robot"}; }
    [[nodiscard]] Changing changing() { return {use, "robot"}; }
};

/// An answer whose times count within the segment, in [0, 1], or in stamps.
struct PythonRobotAnswer {
    RobotAnswer found;
    bool in_stamps = false;
    bool is_in_last_segment = true;

    [[nodiscard]] Bracket time() const { return in_stamps ? found.time : found.contact.time; }
    [[nodiscard]] double clear_until() const {
        if (in_stamps)
            return found.clear_until;
        return found.verdict == Verdict::clear ? 1 : found.contact.clear_until;
    }
};

/// How near a robot comes. Times count within the segment, in [0, 1], or in stamps.
struct PythonClearance {
    RobotClearance found;
    RobotChecker checker; ///< of the question, and its path: for the gradient
    JointPath path;
    bool in_stamps = false;
    bool has_handovers = false;
    ComputedOnce<RobotGradient> gradient = {};

    [[nodiscard]] Bracket time() const { return in_stamps ? found.time : found.nearest.time; }
};

/// The options of a question about a robot, from Python.
struct RobotArguments {
    nb::handle scene; ///< None or a chasles.Scene
    double margin = 0;
    std::optional<double> hold;
    double time_tolerance = 0;
    nb::handle find;
};

RobotChecker checker_of(const Robot& robot, const RobotArguments& arguments);

/// Numbers of shape (n,) or (n, variables). Throws InvalidInput "NAME: WHY".
Configuration configuration_from(nb::handle argument, const std::string& name);
/// The ends of a straight edge. A goal that is None is a TypeError.
std::pair<Configuration, Configuration> edge_from(nb::handle start, nb::handle goal);
Eigen::MatrixXd configurations_from(nb::handle argument, const std::string& name);
std::vector<Configuration> rows_of(nb::handle argument, const std::string& name);

nb::object array_of(const Configuration& configuration);
std::vector<std::string> names_of(const Robot& robot);

#define CHASLES_HANDOVERS                                                                                              \
    "handovers: collections.abc.Sequence[tuple[float, str, str] | tuple[float, str, str, list[str]]] = ()"

/// What `handovers` of a question mean.
inline constexpr const char* handovers_doc =
    "\n\nEach handover is a tuple of a time of the path, a part, and the link that carries it from then on; perhaps, "
    "too, links that it may\ntouch. A segment must end at that time. The part keeps its place there. It is not tested "
    "against the links that carry it at any time.";

/// Arrays; `times`, `velocities` and `accelerations` may be None.
struct PathArguments {
    nb::handle configurations, times, velocities, accelerations;
    nb::handle handovers = {}; ///< tuples; without any it may be null
};
/// `configurations` may be a JointPath.
JointPath path_from(const Robot& robot, const PathArguments& arguments);

/// Tuples (stamp, part, link) or (stamp, part, link, touch_links).
std::vector<Handover> handovers_from(const PathArguments& arguments);

/// Whether times of answers count in stamps.
inline bool has_stamps(const PathArguments& arguments) {
    return !arguments.times.is_none() || nb::isinstance<JointPath>(arguments.configurations);
}

/// For many questions or long ones: on another thread, while this one waits for Ctrl-C.
template <class Ask>
auto asked(const Ask& ask) {
    std::optional<decltype(ask())> answer;
    run_interruptibly([&](Progress&) { answer.emplace(ask()); }, nb::none());
    return std::move(*answer);
}

/// For questions of microseconds: on this thread.
template <class Ask>
auto asked_here(const Ask& ask) {
    const WithoutGil without_gil;
    const EndsBySignals ends_by_signals;
    return ask();
}

/// The two names, or None.
inline nb::object pair_of(const std::optional<RobotPair>& pair) {
    return pair ? nb::object(nb::make_tuple(pair->first, pair->second)) : nb::none();
}

PythonRobotAnswer answer_on_edge(const RobotChecker& checker, nb::handle start, nb::handle goal);
PythonRobotAnswer answer_on_path(const RobotChecker& checker, const PathArguments& path);
PythonClearance clearance_on_edge(const RobotChecker& checker, nb::handle start, nb::handle goal, double tolerance);
PythonClearance clearance_on_path(const RobotChecker& checker, const PathArguments& path, double tolerance);
/// The fields of many edges as lists and arrays: verdict, time, time_upper, clear_until, certain, first, second.
nb::tuple answers_on_edges(const RobotChecker& checker, nb::handle starts, nb::handle goals, unsigned threads);

/// Several robots as one, and a path of theirs.
void bind_together(nb::class_<PythonRobot>& type);
JointPath paths_together(const PythonRobot& cell, nb::handle paths);
/// A page that shows a robot.
void bind_robot_page(nb::module_& module);
/// Questions about boxes of configurations.
void bind_robot_ranges(nb::class_<PythonRobot>& type, nb::module_& module);
/// Pickle of a robot, and `free_body`.
void bind_robot_state(nb::class_<PythonRobot>& type, nb::module_& module);

} // namespace chasles::python
