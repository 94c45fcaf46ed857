// Random numbers that are determined by a seed, a family and an index.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

namespace chasles::attack {

class AttackRandom {
public:
    AttackRandom(std::uint64_t seed, std::uint64_t family, std::uint64_t index) {
        std::seed_seq words{seed, seed >> 32, family, index, index >> 32};
        engine_.seed(words);
    }

    double uniform(double lower, double upper) {
        return lower + (upper - lower) * std::ldexp(double(engine_() >> 11), -53);
    }
    int integer(int lower, int upper) {
        return lower + static_cast<int>(engine_() % static_cast<std::uint64_t>(upper - lower + 1));
    }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    template <class List>
    auto pick(const List& list) {
        return *(std::begin(list) + integer(0, int(std::size(list)) - 1));
    }
    Eigen::Vector3d vector(double size) {
        const double x = uniform(-size, size);
        const double y = uniform(-size, size);
        return {x, y, uniform(-size, size)};
    }
    Eigen::Vector3i grid(int size) {
        const int x = integer(-size, size);
        const int y = integer(-size, size);
        return {x, y, integer(-size, size)};
    }
    Eigen::Vector3i grid_direction(int size) {
        for (;;)
            if (const Eigen::Vector3i v = grid(size); v != Eigen::Vector3i::Zero())
                return v;
    }

private:
    std::mt19937_64 engine_;
};

} // namespace chasles::attack
