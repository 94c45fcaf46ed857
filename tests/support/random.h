// Random input that prints its seed and prefers corner cases.
#pragma once

#include "chasles/algebra/vector.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

namespace chasles::test {

/// The same numbers for the same seed on every platform; prints the seed.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {
        std::cout << "seed " << seed << std::endl;
        testing::Test::RecordProperty("seed", std::to_string(seed));
    }

    /// A number in [lower, upper).
    double uniform(double lower, double upper) {
        return lower + (upper - lower) * std::ldexp(double(engine_() >> 11), -53);
    }
    /// A whole number in [lower, upper].
    int integer(int lower, int upper) {
        return lower + static_cast<int>(engine_() % static_cast<std::uint64_t>(upper - lower + 1));
    }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    /// A number of either sign with a magnitude between these powers of ten.
    double scaled(double lower_exponent, double upper_exponent) {
        const double size = std::pow(10.0, uniform(lower_exponent, upper_exponent));
        return chance(0.5) ? size : -size;
    }
    /// A point in the cube of half side `size`.
    algebra::Vector3<double> vector(double size) {
        const double x = uniform(-size, size);
        const double y = uniform(-size, size);
        return {x, y, uniform(-size, size)};
    }

private:
    std::mt19937_64 engine_;
};

} // namespace chasles::test
