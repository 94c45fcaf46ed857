#include "scenes/nut_motions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chasles::scenes {

using std::numbers::pi;

Pose nut_pose(const NutTurn& motion, double turns_done) {
    const double half_angle = pi * turns_done;
    return {Eigen::Vector3d(0, 0, motion.height + motion.slide_per_turn * turns_done),
            Eigen::Quaterniond(std::cos(half_angle), 0, 0, std::sin(half_angle))};
}

std::vector<Pose> nut_path(const NutTurn& motion) {
    const int steps = std::max(1, static_cast<int>(std::ceil(steps_per_turn * std::abs(motion.turns) - 1e-9)));
    std::vector<Pose> poses;
    for (int step = 0; step <= steps; ++step)
        poses.push_back(nut_pose(motion, motion.turns * step / steps));
    return poses;
}

// Let h be half the turn. time - tan(h time) / tan(h) is largest where its derivative vanishes: cos(h time)^2 = h /
// tan(h).
double slide_deviation(double slide_per_turn, double max_turn) {
    const double half = max_turn / 2;
    const double time = std::acos(std::sqrt(half / std::tan(half))) / half;
    return slide_per_turn * max_turn / (2 * pi) * std::abs(time - std::tan(half * time) / std::tan(half));
}

} // namespace chasles::scenes
