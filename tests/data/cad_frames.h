// Frames of simulated motions of CAD parts.
#pragma once

#include "tests/data/shared_data.h"

#include <fstream>
#include <sstream>
#include <vector>

namespace chasles::test {

/// The poses of both bodies in the world at one frame.
struct Frame {
    double stamp = 0;
    Pose moving;
    Pose fixed;
};

inline Pose read_pose(std::istream& numbers) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 3; ++i)
        numbers >> matrix(i, 3);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            numbers >> matrix(i, j);
    return Pose::from_matrix(matrix); // six decimals: projected to the nearest rotation
}

inline std::vector<Frame> read_frames(const std::filesystem::path& file) {
    std::vector<Frame> frames;
    std::ifstream lines(file);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream numbers(line);
        Frame frame;
        numbers >> frame.stamp;
        frame.moving = read_pose(numbers);
        frame.fixed = read_pose(numbers);
        frames.push_back(frame);
    }
    return frames;
}

} // namespace chasles::test
