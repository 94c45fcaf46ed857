#include "chasles/robot/range_world.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"

#include <algorithm>
#include <cmath>

namespace chasles::robot {

namespace {

[[noreturn]] void refuse_range(const std::string& what, const std::string& why) {
    throw InvalidInput("range: " + what + ": " + why);
}

/// A limit of the file is no value that somebody chose.
[[noreturn]] void refuse_large(const char* name, const RobotVariable& variable, double value, const std::string& why) {
    if (value != variable.lower && value != variable.upper)
        refuse_range(name, variable.name + why);
    refuse_range(name, variable.name + ": its limit " + number_text(value) +
                           " is beyond 1000 in magnitude, the largest value: give the box smaller ends of this "
                           "variable");
}

void check_end(const Model& model, const Configuration& end, const char* name) {
    const auto count = Eigen::Index(model.variables.size());
    if (end.size() != count)
        refuse_range(name, "has " + std::to_string(end.size()) + " values, and the robot has " + std::to_string(count) +
                               " variables");
    for (std::size_t i = 0; i < model.variables.size(); ++i) {
        const double value = end[Eigen::Index(i)];
        if (!std::isfinite(value))
            refuse_range(name, model.variables[i].name + " is not a finite number");
        if (const std::string why = why_too_large(model, i, value); !why.empty())
            refuse_large(name, model.variables[i], value, why);
    }
    for (const std::size_t first : model.quaternions)
        if (!(end.segment<4>(Eigen::Index(first)).norm() > 1e-6))
            refuse_range(name, model.variables[first].name + ": the quaternion is zero");
}

} // namespace

std::vector<std::size_t> checked_axes(const Model& model, const ConfigurationBox& box) {
    check_end(model, box.lower, "lower");
    check_end(model, box.upper, "upper");
    std::vector<std::size_t> axes;
    for (std::size_t i = 0; i < model.variables.size(); ++i) {
        const double lower = box.lower[Eigen::Index(i)], upper = box.upper[Eigen::Index(i)];
        if (lower > upper)
            refuse_range(model.variables[i].name, "its lower end is above its upper end");
        if (lower == upper)
            continue;
        if (std::ranges::any_of(model.quaternions, [&](std::size_t first) { return i >= first && i < first + 4; }))
            refuse_range(model.variables[i].name, "is a part of a quaternion, which has to stand still: give it the "
                                                  "same value at both ends");
        axes.push_back(i);
    }
    if (axes.empty())
        refuse_range("box", "no variable has a lower end below its upper end; is_clear answers for one configuration");
    return axes;
}

RangeWorld::RangeWorld(const RobotChecker::Prepared& given) : prepared(given) {
    for (const std::size_t body : prepared.movers)
        refuse_range(prepared.bodies[body].name,
                     "moves, and a range is about a world that stands still: leave its motion out, or give it the pose "
                     "that it has at one time");
    for (const Element& element : prepared.model().elements)
        of_elements.emplace_back(element.shape);
    for (const RobotChecker::Prepared::Obstacle& obstacle : prepared.obstacles)
        of_obstacles.emplace_back(prepared.bodies[obstacle.body].shape);
}

} // namespace chasles::robot
