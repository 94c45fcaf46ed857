// Random numbers, directions and rotations for benchmark cases.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <random>

namespace chasles::bench {

class Draw {
public:
    explicit Draw(std::uint64_t seed) : generator_(seed) {}

    double between(double lower, double upper) {
        return lower + (upper - lower) * double(generator_() >> 11) * 0x1p-53; // the same on every platform
    }
    Eigen::Vector3d direction() {
        for (;;) {
            const Eigen::Vector3d point(between(-1, 1), between(-1, 1), between(-1, 1));
            if (point.norm() > 0.1 && point.norm() < 1)
                return point.normalized();
        }
    }
    Eigen::Quaterniond turn(double least, double most) {
        return Eigen::Quaterniond(Eigen::AngleAxisd(between(least, most), direction()));
    }

private:
    std::mt19937_64 generator_;
};

} // namespace chasles::bench
