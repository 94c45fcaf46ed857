#include "chasles/query/contact_details.h"

#include <Eigen/Geometry>
#include <cmath>

namespace chasles::query {

namespace {

using Polynomial = algebra::Bernstein<3, double>;

/// Directions shorter than this part of what they are made of have no reliable digit left.
constexpr double no_direction = 1e-12;

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

/// Newell's normal; zero only for a face without area, which no polyhedron has.
Eigen::Vector3d face_normal(const Polyhedron& body, std::uint32_t face) {
    const auto corners = body.face(face);
    const auto vertices = body.vertices();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += (vertices[corners[i]] - vertices[corners[0]]).cross(vertices[corners[i + 1]] - vertices[corners[0]]);
    return sum.stableNormalized();
}

Eigen::Vector3d any_perpendicular(const Eigen::Vector3d& direction) {
    return direction.unitOrthogonal();
}

Eigen::Vector3d box_centre(const Polyhedron& body) {
    return body.hierarchy().centre();
}

} // namespace

ContactDetails::ContactDetails(const Polyhedron& moving, const Polyhedron& fixed,
                               const motion::ControlMaps<double>& maps, double tau, bool at_start)
    : moving_(moving), fixed_(fixed), at_start_(at_start) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const Quotient entry = quotient_at(maps.turn.row[i][j], maps.weight, tau);
            turn_(i, j) = entry.value;
            turn_rate_(i, j) = entry.rate;
        }
        const Quotient entry = quotient_at(maps.shift[i], maps.weight, tau);
        shift_[i] = entry.value;
        shift_rate_[i] = entry.rate;
    }
}

Eigen::Vector3d ContactDetails::moved(const Eigen::Vector3d& body_point) const {
    return turn_ * body_point + shift_;
}

Eigen::Vector3d ContactDetails::velocity_at(const Eigen::Vector3d& point) const {
    return turn_rate_ * (turn_.transpose() * (point - shift_)) + shift_rate_;
}

ContactDetails::Place ContactDetails::place_of(const Candidate& candidate) const {
    if (candidate.kind == ContactKind::vertex_face) {
        const Eigen::Vector3d normal = face_normal(fixed_, candidate.fixed.first);
        return {moved(moving_.vertices()[candidate.moving.first]), normal, normal};
    }
    if (candidate.kind == ContactKind::face_vertex) {
        const Eigen::Vector3d normal = turn_ * face_normal(moving_, candidate.moving.first);
        return {fixed_.vertices()[candidate.fixed.first], normal.normalized(), -normal};
    }
    const auto line = [](const Eigen::Vector3d& from, const Eigen::Vector3d& to) { return Line{from, to - from}; };
    return edge_place(
        line(moved(moving_.vertices()[candidate.moving.first]), moved(moving_.vertices()[candidate.moving.second])),
        line(fixed_.vertices()[candidate.fixed.first], fixed_.vertices()[candidate.fixed.second]));
}

/// The point is on the fixed edge. Parallel edges share a stretch: its middle is taken, and the normal is across the
/// edges along the relative velocity.
ContactDetails::Place ContactDetails::edge_place(const Line& moving, const Line& fixed) const {
    const Eigen::Vector3d crossing = moving.direction.cross(fixed.direction);
    const double size = moving.direction.norm() * fixed.direction.norm();
    const Eigen::Vector3d outward = moved(box_centre(moving_)) - box_centre(fixed_);
    const double square = fixed.direction.squaredNorm();
    if (crossing.norm() > no_direction * size) {
        const Eigen::Vector3d arm = (moving.point - fixed.point).cross(moving.direction);
        const double share = -arm.dot(crossing) / crossing.squaredNorm();
        return {fixed.point + std::clamp(share, 0.0, 1.0) * fixed.direction, crossing.normalized(), outward};
    }
    const double from = (moving.point - fixed.point).dot(fixed.direction) / square;
    const double to = (moving.point + moving.direction - fixed.point).dot(fixed.direction) / square;
    const double share = 0.5 * (std::clamp(std::min(from, to), 0.0, 1.0) + std::clamp(std::max(from, to), 0.0, 1.0));
    const Eigen::Vector3d point = fixed.point + share * fixed.direction;
    const Eigen::Vector3d velocity = velocity_at(point);
    const Eigen::Vector3d across = velocity - fixed.direction * (velocity.dot(fixed.direction) / square);
    const bool slides = across.norm() <= no_direction * velocity.norm();
    return {point, slides ? any_perpendicular(fixed.direction) : across.normalized(), outward};
}

Contact ContactDetails::describe(const Candidate& candidate) const {
    const Place place = place_of(candidate);
    const Eigen::Vector3d velocity = velocity_at(place.point);
    const double closing = place.normal.dot(velocity);
    // Before a first contact the gap was closing; at the very start there was no before.
    const bool approaches = !at_start_ && std::abs(closing) > no_direction * velocity.norm();
    const double towards_moving = approaches ? -closing : place.normal.dot(place.fallback);
    Contact contact;
    contact.kind = candidate.kind;
    contact.moving = candidate.moving;
    contact.fixed = candidate.fixed;
    contact.point = place.point;
    contact.normal = towards_moving < 0 ? Eigen::Vector3d(-place.normal) : place.normal;
    contact.approach_speed = towards_moving < 0 ? closing : -closing;
    return contact;
}

} // namespace chasles::query
