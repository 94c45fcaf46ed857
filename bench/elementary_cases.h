// Seeded elementary problems under a screw of ten degrees: feature pairs that are rejected by signs, and pairs that are
// built backwards from a contact at a chosen tau.
#pragma once

#include "chasles/elementary/edge_edge.h"

#include <array>
#include <vector>

namespace chasles::bench {

using Point = algebra::Vector3<double>;

inline constexpr unsigned elementary_seed = 20000424;
inline constexpr std::size_t elementary_problems = 256;
inline constexpr double elementary_extent = 4; ///< no coordinate of any problem is larger

/// Moving feature and fixed feature. `tau` is the tau of their contact; it has no meaning if there is no contact.
struct VertexFaceProblem {
    Point vertex;
    std::array<Point, 3> face;
    double tau = 0;
};
struct EdgeEdgeProblem {
    std::array<Point, 2> moving;
    std::array<Point, 2> fixed;
    double tau = 0;
};

/// One set of problems of each kind.
struct ElementaryCases {
    motion::ControlMaps<algebra::DoubleDouble> exact_maps;
    motion::ControlMaps<double> maps;
    std::vector<VertexFaceProblem> vertex_face_contacts;
    std::vector<VertexFaceProblem> vertex_face_rejections;
    std::vector<EdgeEdgeProblem> edge_edge_contacts;
    std::vector<EdgeEdgeProblem> edge_edge_rejections;
};

ElementaryCases elementary_cases();

} // namespace chasles::bench
