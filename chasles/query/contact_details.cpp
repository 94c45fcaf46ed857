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

Eigen::Vector3d any_perpendicular(const Eigen::Vector3d& direction) {
    return direction.stableNormalized().unitOrthogonal();
}

/// Newell's normal of the face at the size of one, where nothing underflows. Of a face so thin that it vanishes in
/// rounding, any normal of its longest diagonal.
Eigen::Vector3d face_normal(const Polyhedron& body, std::uint32_t face) {
    const auto corners = body.face(face);
    const auto arm = [&](std::size_t i) -> Eigen::Vector3d {
        return body.vertices()[corners[i]] - body.vertices()[corners[0]];
    };
    Eigen::Vector3d longest = arm(1);
    for (std::size_t i = 2; i < corners.size(); ++i)
        if (arm(i).stableNorm() > longest.stableNorm())
            longest = arm(i);
    const double size = longest.cwiseAbs().maxCoeff();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += (arm(i) / size).cross(arm(i + 1) / size);
    return sum.isZero(0) ? any_perpendicular(longest) : Eigen::Vector3d(sum.stableNormalized());
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
    return product(turn_, body_point) + shift_;
}

Eigen::Vector3d ContactDetails::velocity_at(const Eigen::Vector3d& point) const {
    return product(turn_rate_, product(turn_.transpose(), point - shift_)) + shift_rate_;
}

ContactDetails::Place ContactDetails::place_of(const Candidate& candidate) const {
    if (candidate.kind == ContactKind::vertex_face) {
        const Eigen::Vector3d normal = face_normal(fixed_, candidate.fixed.first);
        return {moved(moving_.vertices()[candidate.moving.first]), normal, normal};
    }
    if (candidate.kind == ContactKind::face_vertex) {
        const Eigen::Vector3d normal = product(turn_, face_normal(moving_, candidate.moving.first));
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
    const double length = fixed.direction.stableNorm();
    const Eigen::Vector3d along = fixed.direction.stableNormalized();
    const Eigen::Vector3d moving_along = moving.direction.stableNormalized();
    const Eigen::Vector3d crossing = moving_along.cross(along);
    const Eigen::Vector3d outward = moved(box_centre(moving_)) - box_centre(fixed_);
    if (crossing.norm() > no_direction) {
        const Eigen::Vector3d arm = (moving.point - fixed.point).cross(moving_along);
        const double way = -arm.dot(crossing) / crossing.squaredNorm();
        return {fixed.point + std::clamp(way, 0.0, length) * along, crossing.normalized(), outward};
    }
    const double from = (moving.point - fixed.point).dot(along);
    const double to = (moving.point + moving.direction - fixed.point).dot(along);
    const double way =
        0.5 * (std::clamp(std::min(from, to), 0.0, length) + std::clamp(std::max(from, to), 0.0, length));
    const Eigen::Vector3d point = fixed.point + way * along;
    const Eigen::Vector3d velocity = velocity_at(point);
    const Eigen::Vector3d across = velocity - along * velocity.dot(along);
    const bool slides = across.stableNorm() <= no_direction * velocity.stableNorm();
    return {point, slides ? any_perpendicular(along) : Eigen::Vector3d(across.stableNormalized()), outward};
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
