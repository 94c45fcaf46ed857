#include "chasles/search/no_minimum.h"

#include "chasles/contact/relative_configuration.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace chasles::search {

namespace {

using contact::FeaturePair;
using contact::RelativeConfiguration;
using Eigen::Vector3d;

/// The shortest connection of two features at one moment, in the frame of the fixed body.
struct Connection {
    Vector3d vector;  ///< from the fixed feature to the moving one
    double turn_rate; ///< a bound of the rate at which it turns, radians per unit of tau
    double speed;     ///< with which the moving feature moves at the connection, length unit per unit of tau
};

/// Between the lines of two edges. The search asks only for times at which the ends of the shortest connection of the
/// lines are on the edges.
Connection between_edges(const RelativeConfiguration& bodies, const FeaturePair& features) {
    /// Lines that are nearly parallel have no reliable connection.
    constexpr double least_sine = 1e-6;
    const auto along = [](const Body& body, const Feature& edge) {
        return (body.vertices()[edge.second] - body.vertices()[edge.first]).stableNormalized();
    };
    const Vector3d crossing =
        bodies.turned(along(bodies.moving(), features.moving)).cross(along(bodies.fixed(), features.fixed));
    const double sine = crossing.norm();
    if (sine < least_sine)
        return {Vector3d::Zero(), 0, 0};
    const Vector3d normal = crossing / sine;
    const auto end = [&](std::uint32_t vertex) { return bodies.moved(bodies.moving().vertices()[vertex]); };
    const Vector3d between = end(features.moving.first) - bodies.fixed().vertices()[features.fixed.first];
    const double speed = std::max(bodies.velocity_at(end(features.moving.first)).norm(),
                                  bodies.velocity_at(end(features.moving.second)).norm());
    return {normal.dot(between) * normal, bodies.turn_rate() / sine, speed};
}

/// The bound of the turn holds where the features are at least half of the margin apart.
Connection connection_of(const RelativeConfiguration& bodies, const FeaturePair& features, double margin) {
    if (features.kind == ContactKind::edge_edge)
        return between_edges(bodies, features);
    const contact::NearestPoints nearest = bodies.nearest(features);
    const double speed = bodies.velocity_at(nearest.on_moving).norm();
    const bool is_along_normal = features.kind == ContactKind::vertex_face || features.kind == ContactKind::face_vertex;
    return {nearest.apart(), bodies.turn_rate() + (is_along_normal ? 0 : 2 * speed / margin), speed};
}

} // namespace

std::optional<double> no_minimum_until(const PieceContext& context, const contact::FeaturePair& features, double tau,
                                       double margin, double length) {
    const RelativeConfiguration bodies = context.configuration_at(tau);
    const Connection connection = connection_of(bodies, features, margin);
    if (!(connection.vector.norm() >= 0.75 * margin))
        return std::nullopt;
    const double error = elementary::error_unit<double> * length;
    const double excess = bodies.descent(features, {connection.vector, Vector3d::Zero()}) - 4 * error / margin;
    if (!(excess > 0))
        return std::nullopt;
    // Rates at most double within a steady while.
    const double steady = 0x1p-4 / std::sqrt(std::max(1.0, context.maps().weight[3]));
    const double still_apart = margin / (8 * (connection.speed + bodies.turn_rate() * margin));
    const double still_descending = excess / (4 * (connection.turn_rate + bodies.turn_rate()));
    return tau + std::min({steady, still_apart, still_descending});
}

} // namespace chasles::search
