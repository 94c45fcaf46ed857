// Elementary problems under one translation whose answers are known without rounding: coordinates have so few bits
// that every sum of the construction is exact.
#pragma once

#include "bench/elementary_cases.h"

#include <Eigen/Core>
#include <string>

namespace chasles::bench {

/// What the moving features do in [0, 1].
inline const Eigen::Vector3d way(0.75, -0.5, 0.625);

/// Problems of one kind; `tau`, which is the time for translations, says when they touch.
template <class Problem>
struct TranslationCase {
    std::string name;
    bool touches;
    std::vector<Problem> problems;
};

/// Contacts well inside of the features; misses by 2^-26 to 1/8 of the feature, in the plane of the face or where both
/// lines meet; and features that start beyond where they would touch.
std::vector<TranslationCase<VertexFaceProblem>> vertex_face_translations();
std::vector<TranslationCase<EdgeEdgeProblem>> edge_edge_translations();

} // namespace chasles::bench
