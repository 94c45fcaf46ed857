// Seeded inputs for lanes_bench.cpp: a screw of ten degrees, and pairs that can and cannot be rejected.
#pragma once

#include "bench/lanes_kernels.h"

#include <random>
#include <vector>

namespace chasles::bench {

inline constexpr unsigned lanes_seed = 20000414; // ICRA 2000 opened in April
inline constexpr std::size_t lanes_pairs = 512;  // fits in the first-level cache

inline motion::ControlMaps<double> ten_degree_maps() {
    const double half = 3.14159265358979323846 / 36;
    const Vector3<double> axis{0.36, 0.48, 0.8};
    const motion::GeneralPose<double> start{{0.1, -0.2, 0.05}, {1, {}}};
    const motion::GeneralPose<double> goal{{0.15, -0.1, 0.02}, {std::cos(half), scale(axis, std::sin(half))}};
    return motion::control_maps(motion::screw_between(start, goal));
}

class LaneCases {
public:
    /// A vertex in a cube of side two, and a plane that cuts it.
    VertexAndPlane vertex_and_plane() {
        VertexAndPlane pair;
        for (int i = 0; i < 3; ++i) {
            pair.vertex[i] = uniform(-1, 1);
            pair.normal[i] = uniform(-1, 1);
            pair.anchor[i] = uniform(-1, 1);
        }
        pair.error = 1e-14;
        return pair;
    }

    /// Two boxes with sides up to `size`, whose centres are up to `distance` apart along each axis.
    BoxPair boxes(double size, double distance) {
        BoxPair pair;
        for (int i = 0; i < 3; ++i) {
            pair.moving_centre[i] = uniform(-1, 1);
            pair.fixed_centre[i] = pair.moving_centre[i] + uniform(-distance, distance);
            pair.moving_half[i] = 0.5 * uniform(0.2, 1) * size;
            pair.fixed_half[i] = 0.5 * uniform(0.2, 1) * size;
        }
        return pair;
    }

private:
    double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

    std::mt19937_64 random_{lanes_seed};
};

template <class Make>
auto many(Make make) {
    std::vector<decltype(make())> all;
    all.reserve(lanes_pairs);
    while (all.size() < lanes_pairs)
        all.push_back(make());
    return all;
}

/// Random pairs, some rejected and some not.
inline std::vector<VertexAndPlane> vertices_and_planes() {
    LaneCases cases;
    return many([&] { return cases.vertex_and_plane(); });
}
/// Pairs that one of the six axes separates, and pairs that no axis separates, as in a traversal.
inline std::vector<BoxPair> mixed_boxes() {
    LaneCases cases;
    return many([&] { return cases.boxes(0.4, 0.6); });
}
/// Pairs that no axis separates: every axis is tested, and no branch is mispredicted.
inline std::vector<BoxPair> overlapping_boxes() {
    LaneCases cases;
    return many([&] { return cases.boxes(3.0, 0.05); });
}

} // namespace chasles::bench
