#include "chasles/contact/normal_cone.h"

#include "chasles/mesh/adjacent_directions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

namespace chasles::contact {

namespace {

/// Directions into the surface around a feature, unit vectors in the fixed body's frame.
using Ways = std::vector<Eigen::Vector3d>;

Ways ways_from(const Body& body, FeatureKind kind, const Feature& feature) {
    Ways ways;
    const auto collect = [&](const Eigen::Vector3d& way) {
        const Eigen::Vector3d unit = way.stableNormalized();
        if (std::ranges::find(ways, unit) == ways.end()) // a side belongs to two faces
            ways.push_back(unit);
        return false;
    };
    if (kind == FeatureKind::vertex) {
        any_direction_from_vertex(body, feature.first, collect);
    } else {
        any_direction_from_edge(body, {feature.first, feature.second}, collect);
        const Eigen::Vector3d along = body.vertices()[feature.second] - body.vertices()[feature.first];
        collect(along);
        collect(-along);
    }
    return ways;
}

/// The candidates for the normal that is nearest to a direction in the cone n . way <= 0: the direction itself, the
/// direction without its component along one way, and the cross product of two ways.
Ways candidates(const Ways& ways, const Eigen::Vector3d& wanted) {
    Ways normals;
    const auto add = [&](const Eigen::Vector3d& normal) {
        if (normal.norm() > no_direction)
            normals.push_back(normal.normalized());
    };
    add(wanted);
    for (const Eigen::Vector3d& way : ways)
        add(wanted - way.dot(wanted) * way);
    for (std::size_t i = 0; i < ways.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            add(ways[i].cross(ways[j]));
            add(ways[j].cross(ways[i]));
        }
    return normals;
}

/// The directions w for which a normal n has to fulfil n . w <= 0: into the fixed surface, and against those into the
/// moving one.
Ways limits_of(const RelativeConfiguration& bodies, const FeaturePair& features) {
    Ways ways = ways_from(bodies.fixed(), fixed_feature_kind(features.kind), features.fixed);
    for (const Eigen::Vector3d& way : ways_from(bodies.moving(), moving_feature_kind(features.kind), features.moving))
        ways.emplace_back(-bodies.turned(way)); // -n . way <= 0
    return ways;
}

/// By how much a normal violates the conditions; 0 up to rounding.
double excess_of(const Eigen::Vector3d& normal, const Ways& limits) {
    constexpr double rounding = 1e-9;
    double excess = 0;
    for (const Eigen::Vector3d& way : limits)
        excess = std::max(excess, normal.dot(way));
    return excess <= rounding ? 0 : excess;
}

} // namespace

Eigen::Vector3d outward_direction(const RelativeConfiguration& bodies) {
    return bodies.moved(bodies.moving().bvh().centre()) - bodies.fixed().bvh().centre();
}

Eigen::Vector3d normal_between_cones(const RelativeConfiguration& bodies, const FeaturePair& features, bool at_start) {
    const NearestPoints nearest = bodies.nearest(features);
    const Ways ways = limits_of(bodies, features);
    Eigen::Vector3d wanted = at_start ? outward_direction(bodies) : -bodies.velocity_at(nearest.on_fixed);
    wanted.stableNormalize();
    // The cones of bodies that are not convex may have no normal in common. The fallback violates the cones least.
    Eigen::Vector3d best = wanted;
    double best_excess = 2;
    double best_share = -2;
    for (const Eigen::Vector3d& normal : candidates(ways, wanted)) {
        const double excess = excess_of(normal, ways);
        const double share = normal.dot(wanted);
        if (excess < best_excess || (excess == best_excess && share > best_share)) {
            best = normal;
            best_excess = excess;
            best_share = share;
        }
    }
    if (best.isZero(0)) // one point is both bodies' centre, and no normal is better than another
        return Eigen::Vector3d::UnitZ();
    return best + Eigen::Vector3d::Zero(); // not -0
}

bool separates(const Eigen::Vector3d& normal, const RelativeConfiguration& bodies, const FeaturePair& features) {
    return excess_of(normal, limits_of(bodies, features)) == 0;
}

} // namespace chasles::contact
