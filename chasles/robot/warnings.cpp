// What looks wrong in configurations of a robot. It changes no answer.
#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/robot/model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chasles {

namespace {

/// Values are often written with six digits, and so are limits.
constexpr double least_excess = 1e-6;

/// Of a joint that turns: no limits of a real robot reach farther than this, and few paths turn farther.
double largest_angle_of(const RobotVariable& variable) {
    constexpr double turn = 2 * std::numbers::pi * (1 + 1e-6);
    return variable.is_continuous ? 2 * turn : turn;
}

bool turns(const robot::Model& model, const RobotVariable& variable) {
    const auto& joints = model.description.joints;
    const auto joint = std::ranges::find(joints, variable.name, &JointDescription::name);
    return variable.is_continuous || (joint != joints.end() && joint->type == JointType::revolute);
}

/// A quaternion may have any length.
bool is_of_quaternion(const robot::Model& model, const RobotVariable& variable) {
    const std::size_t slash = variable.name.rfind("/rot_");
    const auto& joints = model.description.joints;
    const auto joint = std::ranges::find(joints, variable.name.substr(0, slash), &JointDescription::name);
    return slash != std::string::npos && joint != joints.end() && joint->type == JointType::floating;
}

double distance_beyond(const RobotVariable& variable, double value) {
    return std::max({0.0, variable.lower - value, value - variable.upper});
}

std::string limits_text(const RobotVariable& variable) {
    return '[' + number_text(variable.lower) + ", " + number_text(variable.upper) + ']';
}

/// The line about one variable, whose value is given for each configuration; empty if nothing looks wrong.
std::string warning_about(const robot::Model& model, const RobotVariable& variable, const Eigen::VectorXd& values) {
    if (is_of_quaternion(model, variable))
        return {};
    const double allowed = largest_angle_of(variable);
    const bool has_far_limits =
        std::isfinite(variable.lower + variable.upper) && std::max(-variable.lower, variable.upper) > allowed;
    const bool may_be_degrees = turns(model, variable) && !has_far_limits;
    Eigen::Index worst = -1, beyond = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        const bool is_far = may_be_degrees && std::abs(values[i]) > allowed;
        if (!is_far && !(distance_beyond(variable, values[i]) > least_excess))
            continue;
        ++beyond;
        if (worst < 0 || std::abs(values[i]) > std::abs(values[worst]))
            worst = i;
    }
    if (beyond == 0)
        return {};
    const bool is_far = may_be_degrees && std::abs(values[worst]) > allowed;
    return variable.name + ": " + number_text(values[worst]) + " in configuration " + std::to_string(worst) +
           (is_far ? " looks like degrees; angles are in radians" : " is beyond the limits " + limits_text(variable)) +
           (beyond > 1 ? ", as " + std::to_string(beyond - 1) + " more" : std::string());
}

} // namespace

std::vector<std::string> Robot::warnings_about(std::span<const Configuration> configurations) const {
    std::vector<std::string> warnings;
    const auto count = Eigen::Index(variables().size());
    for (const Configuration& configuration : configurations)
        if (configuration.size() != count)
            robot::refuse("configuration", "has " + std::to_string(configuration.size()) +
                                               " values, and the robot has " + std::to_string(count) + " variables");
    for (Eigen::Index i = 0; i < count; ++i) {
        Eigen::VectorXd values(Eigen::Index(configurations.size()));
        for (std::size_t k = 0; k < configurations.size(); ++k)
            values[Eigen::Index(k)] = configurations[k][i];
        if (std::string warning = warning_about(*model_, variables()[std::size_t(i)], values); !warning.empty())
            warnings.push_back(std::move(warning));
    }
    return warnings;
}

} // namespace chasles
