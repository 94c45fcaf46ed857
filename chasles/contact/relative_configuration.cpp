#include "chasles/contact/relative_configuration.h"

#include "chasles/mesh/adjacent_directions.h"
#include "chasles/mesh/face_normal.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace chasles::contact {

namespace {

using Polynomial = algebra::Bernstein<3, double>;

/// Value and derivative of p / w at tau.
struct Quotient {
    double value;
    double rate;
};

Quotient quotient_at(const Polynomial& p, const Polynomial& w, double tau) {
    algebra::Bernstein<2, double> p_rate, w_rate;
    for (int i = 0; i < 3; ++i) {
        p_rate.set(i, 3 * (p[i + 1] - p[i]));
        w_rate.set(i, 3 * (w[i + 1] - w[i]));
    }
    const double weight = value_at(w, tau);
    const double value = value_at(p, tau) / weight;
    return {value, (value_at(p_rate, tau) - value * value_at(w_rate, tau)) / weight};
}

/// A segment by its unit direction and length, where nothing underflows.
struct Segment {
    Eigen::Vector3d from;
    Eigen::Vector3d along; ///< unit
    double length;

    Segment(const Eigen::Vector3d& start, const Eigen::Vector3d& end)
        : from(start), along((end - start).stableNormalized()), length((end - start).stableNorm()) {}

    [[nodiscard]] Eigen::Vector3d at(double way) const { return from + std::clamp(way, 0.0, length) * along; }
    [[nodiscard]] double way_to(const Eigen::Vector3d& point) const { return (point - from).dot(along); }
    [[nodiscard]] Eigen::Vector3d foot(const Eigen::Vector3d& point) const { return at(way_to(point)); }
};

/// The middle of the common part of two parallel edges.
NearestPoints middle_of_overlap(const Segment& moving, const Segment& fixed) {
    const double from = std::clamp(fixed.way_to(moving.at(0)), 0.0, fixed.length);
    const double to = std::clamp(fixed.way_to(moving.at(moving.length)), 0.0, fixed.length);
    const Eigen::Vector3d point = fixed.at(0.5 * (from + to));
    return {moving.foot(point), point};
}

/// The points where the lines cross, seen along their common perpendicular, then projected from edge to edge until both
/// are on the edges.
NearestPoints nearest_points(const Segment& moving, const Segment& fixed) {
    const Eigen::Vector3d crossing = moving.along.cross(fixed.along);
    if (crossing.norm() <= no_direction)
        return middle_of_overlap(moving, fixed);
    const Eigen::Vector3d arm = (moving.from - fixed.from).cross(moving.along);
    Eigen::Vector3d on_fixed = fixed.at(-arm.dot(crossing) / crossing.squaredNorm());
    on_fixed = fixed.foot(moving.foot(on_fixed));
    return {moving.foot(on_fixed), on_fixed};
}

/// The largest cosine of the angle between a unit vector and a direction from a feature into its surface.
double steepest(const Body& body, FeatureKind kind, const Feature& feature, const Eigen::Vector3d& direction) {
    double most = -1;
    const auto see = [&](const Eigen::Vector3d& way) {
        most = std::max(most, direction.dot(way.stableNormalized()));
        return false;
    };
    if (kind == FeatureKind::vertex)
        any_direction_from_vertex(body, feature.first, see);
    if (kind == FeatureKind::edge)
        any_direction_from_edge(body, {feature.first, feature.second}, see);
    return most;
}

} // namespace

Eigen::Vector3d foot_on_segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& point) {
    const Eigen::Vector3d along = to - from;
    const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return from + share * along;
}

Eigen::Vector3d nearest_of_rim(const Body& body, std::uint32_t face, const Eigen::Vector3d& point) {
    const auto corners = body.face(face);
    const auto corner = [&](std::size_t i) -> const Eigen::Vector3d& { return body.vertices()[corners[i]]; };
    Eigen::Vector3d nearest = corner(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector3d foot = foot_on_segment(corner(i), corner(i + 1 == corners.size() ? 0 : i + 1), point);
        if ((foot - point).squaredNorm() < (nearest - point).squaredNorm())
            nearest = foot;
    }
    return nearest;
}

RelativeConfiguration::RelativeConfiguration(const Body& moving, const Body& fixed,
                                             const motion::ControlMaps<double>& maps, double tau)
    : moving_(moving), fixed_(fixed) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const Quotient entry = quotient_at(maps.rotation.row[i][j], maps.weight, tau);
            turn_(i, j) = entry.value;
            turn_rate_(i, j) = entry.rate;
        }
        const Quotient entry = quotient_at(maps.translation[i], maps.weight, tau);
        shift_[i] = entry.value;
        shift_rate_[i] = entry.rate;
    }
}

void RelativeConfiguration::take_rates(const RelativeConfiguration& other, double factor) {
    turn_rate_ = factor * other.turn_rate_;
    shift_rate_ = factor * other.shift_rate_;
}

Eigen::Vector3d RelativeConfiguration::moved(const Eigen::Vector3d& body_point) const {
    return product(turn_, body_point) + shift_;
}

motion::MatrixPose RelativeConfiguration::pose() const {
    motion::MatrixPose pose;
    for (int i = 0; i < 3; ++i) {
        pose.translation[i] = shift_[i];
        for (int j = 0; j < 3; ++j)
            pose.rotation.row[i][j] = turn_(i, j);
    }
    return pose;
}

Eigen::Vector3d RelativeConfiguration::velocity_at(const Eigen::Vector3d& point) const {
    return product(turn_rate_, product(turn_.transpose(), point - shift_)) + shift_rate_;
}

NearestPoints RelativeConfiguration::nearest(const FeaturePair& features) const {
    const auto moving_point = [&](std::uint32_t vertex) { return moved(moving_.vertices()[vertex]); };
    const auto fixed_point = [&](std::uint32_t vertex) -> Eigen::Vector3d { return fixed_.vertices()[vertex]; };
    const auto moving_edge = [&] {
        return Segment(moving_point(features.moving.first), moving_point(features.moving.second));
    };
    const auto fixed_edge = [&] {
        return Segment(fixed_point(features.fixed.first), fixed_point(features.fixed.second));
    };
    const auto foot = [](const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Eigen::Vector3d& corner) {
        return Eigen::Vector3d(point - normal.dot(point - corner) * normal);
    };
    switch (features.kind) {
    case ContactKind::vertex_face: {
        const std::uint32_t face = features.fixed.first;
        const Eigen::Vector3d vertex = moving_point(features.moving.first);
        const FaceNormal normal = face_normal(fixed_, face);
        return {vertex, normal.has_plane() ? foot(vertex, normal.unit, fixed_point(fixed_.face(face)[0]))
                                           : nearest_of_rim(fixed_, face, vertex)};
    }
    case ContactKind::face_vertex: {
        const std::uint32_t face = features.moving.first;
        const Eigen::Vector3d vertex = fixed_point(features.fixed.first);
        const FaceNormal normal = face_normal(moving_, face);
        return {normal.has_plane() ? foot(vertex, turned(normal.unit), moving_point(moving_.face(face)[0]))
                                   : moved(nearest_of_rim(moving_, face, moved_back(vertex))),
                vertex};
    }
    case ContactKind::edge_edge:
        return nearest_points(moving_edge(), fixed_edge());
    case ContactKind::vertex_edge: {
        const Eigen::Vector3d vertex = moving_point(features.moving.first);
        return {vertex, fixed_edge().foot(vertex)};
    }
    case ContactKind::edge_vertex: {
        const Eigen::Vector3d vertex = fixed_point(features.fixed.first);
        return {moving_edge().foot(vertex), vertex};
    }
    case ContactKind::vertex_vertex:
        break;
    }
    return {moving_point(features.moving.first), fixed_point(features.fixed.first)};
}

double RelativeConfiguration::descent(const FeaturePair& features, const NearestPoints& nearest) const {
    const Eigen::Vector3d towards_moving = nearest.apart().stableNormalized();
    const Eigen::Vector3d towards_fixed = turned_back(-towards_moving);
    return std::max(steepest(fixed_, fixed_feature_kind(features.kind), features.fixed, towards_moving),
                    steepest(moving_, moving_feature_kind(features.kind), features.moving, towards_fixed));
}

} // namespace chasles::contact
