// Several robots as one, their path, and parts that change hands.
#include "chasles/base/invalid_input.h"
#include "python/src/docstrings.h"
#include "python/src/robot.h"

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// Calls `use` with each name and value of a dict, or of another mapping.
template <class Use>
void for_each_named(nb::handle mapping, const char* argument, const Use& use) {
    nb::dict dict;
    if (!nb::isinstance<nb::dict>(mapping) && !nb::hasattr(mapping, "items"))
        throw nb::type_error((std::string(argument) + ": must be a dict by the names of robots").c_str());
    for (const nb::handle item : mapping.attr("items")()) {
        std::string name;
        if (!nb::try_cast(item[0], name))
            throw nb::type_error((std::string(argument) + ": the name of a robot must be a str").c_str());
        use(name, item[1]);
    }
}

PythonRobot together(nb::handle robots) {
    std::vector<std::pair<std::string, Robot>> named;
    for_each_named(robots, "robots", [&](const std::string& name, nb::handle value) {
        const PythonRobot* robot = nullptr;
        if (!nb::try_cast(value, robot) || !robot)
            throw nb::type_error(("robots: " + name + ": must be a chasles.Robot").c_str());
        const Asking question = robot->asking();
        named.emplace_back(name, *robot);
    });
    return Robot::together(named);
}

[[noreturn]] void refuse_handover(std::size_t index, const char* why) {
    throw nb::type_error(fmt::format("handovers: {}: {}", index, why).c_str());
}

} // namespace

JointPath paths_together(const PythonRobot& cell, nb::handle paths) {
    JointPath::OfRobots named;
    for_each_named(paths, "paths", [&](const std::string& name, nb::handle value) {
        if (const JointPath* path = nullptr; nb::try_cast(value, path) && path)
            named.emplace(name, *path);
        else
            named.emplace(name, configuration_from(value, "paths: " + name));
    });
    return JointPath::together(cell, named);
}

std::vector<Handover> handovers_from(const PathArguments& arguments) {
    std::vector<Handover> handovers;
    nb::sequence given;
    if (!arguments.handovers.is_valid())
        return handovers;
    if (!nb::try_cast(arguments.handovers, given) || nb::isinstance<nb::str>(arguments.handovers))
        throw nb::type_error("handovers: must be a sequence of tuples (time, part, link)");
    for (const nb::handle item : given) {
        Handover& handover = handovers.emplace_back();
        nb::sequence fields;
        if (!nb::try_cast(item, fields) || nb::isinstance<nb::str>(item) ||
            (nb::len(fields) != 3 && nb::len(fields) != 4))
            refuse_handover(handovers.size() - 1,
                            "must be a tuple (time, part, link) or (time, part, link, touch_links)");
        if (!nb::try_cast(fields[0], handover.stamp) || !nb::try_cast(fields[1], handover.part) ||
            !nb::try_cast(fields[2], handover.link))
            refuse_handover(handovers.size() - 1, "the time must be a number, and part and link each a str");
        if (nb::len(fields) == 4 &&
            (nb::isinstance<nb::str>(fields[3]) || !nb::try_cast(fields[3], handover.touch_links)))
            refuse_handover(handovers.size() - 1, "touch_links must be a list of str");
    }
    return handovers;
}

void bind_together(nb::class_<PythonRobot>& type) {
    type.def_static("together", together, "robots"_a.none(),
                    nb::sig("def together(robots: collections.abc.Mapping[str, Robot]) -> Robot"),
                    doc("Robot.together"));
}

} // namespace chasles::python
