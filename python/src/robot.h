// Robots and their answers as Python objects.
#pragma once

#include "chasles/robot/pair_proof.h"
#include "chasles/robot/robot.h"
#include "python/src/arrays.h"
#include "python/src/bind.h"

#include <string>
#include <vector>

namespace chasles::python {

/// An answer whose times count within the segment, in [0, 1], or in stamps.
struct PythonRobotAnswer {
    RobotAnswer found;
    bool in_stamps = false;

    [[nodiscard]] Bracket time() const { return in_stamps ? found.time : found.contact.time; }
    [[nodiscard]] double clear_until() const {
        if (in_stamps)
            return found.clear_until;
        return found.verdict == Verdict::clear ? 1 : found.contact.clear_until;
    }
};

/// The options of a question about a robot, from Python.
struct RobotArguments {
    nb::handle scene; ///< None or a chasles.Scene
    double margin = 0;
    double time_tolerance = 0;
    nb::handle find;
};

RobotChecker checker_of(const Robot& robot, const RobotArguments& arguments);

/// Numbers of shape (n,) or (n, variables). Throws InvalidInput "NAME: WHY".
Configuration configuration_from(nb::handle argument, const std::string& name);
Eigen::MatrixXd configurations_from(nb::handle argument, const std::string& name);

nb::object array_of(const Configuration& configuration);
std::vector<std::string> names_of(const Robot& robot);

PythonRobotAnswer answer_on_edge(const RobotChecker& checker, nb::handle start, nb::handle goal);
/// `times`, `velocities` and `accelerations` are None or arrays.
PythonRobotAnswer answer_on_path(const RobotChecker& checker, nb::handle configurations, nb::handle times,
                                 nb::handle velocities, nb::handle accelerations);
/// The fields of many edges as lists and arrays: verdict, time, time_upper, clear_until, certain, first, second.
nb::tuple answers_on_edges(const RobotChecker& checker, nb::handle starts, nb::handle goals, unsigned threads);

} // namespace chasles::python
