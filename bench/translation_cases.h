// Elementary problems under one translation. Their answers are known exactly: coordinates have few bits, and every sum
// of the construction is exact.
#pragma once

#include "bench/elementary_cases.h"

#include <Eigen/Core>
#include <string>

namespace chasles::bench {

/// The translation of the moving features in [0, 1].
inline const Eigen::Vector3d way(0.75, -0.5, 0.625);

/// Problems of one kind. `tau` of a problem is the time of its contact (tau and time agree for translations).
template <class Problem>
struct TranslationCase {
    std::string name;
    bool touches;
    std::vector<Problem> problems;
};

/// Three kinds of cases: contacts well inside the features; misses by 2^-26 to 1/8 of the feature, in the plane of the
/// face or at the intersection of both lines; and features that start past their crossing.
std::vector<TranslationCase<VertexFaceProblem>> vertex_face_translations();
std::vector<TranslationCase<EdgeEdgeProblem>> edge_edge_translations();

} // namespace chasles::bench
