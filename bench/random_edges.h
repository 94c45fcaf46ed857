// Random configurations of robots.
#pragma once

#include "bench/draw.h"
#include "chasles/robot/robot.h"

namespace chasles::bench {

inline Configuration random_within_limits(Draw& draw, const Robot& robot) {
    Configuration values(Eigen::Index(robot.variables().size()));
    for (std::size_t i = 0; i < robot.variables().size(); ++i)
        values[Eigen::Index(i)] = draw.between(robot.variables()[i].lower, robot.variables()[i].upper);
    return values;
}

} // namespace chasles::bench
