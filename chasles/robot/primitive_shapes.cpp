#include "chasles/robot/primitive_shapes.h"

namespace chasles::robot {
namespace {

constexpr double least_size = 1e-6;

double with_extent(double size) {
    return size == 0 ? least_size : size;
}

} // namespace

EnclosingPolyhedron PrimitiveShapes::box(const Eigen::Vector3d& sides) {
    const Eigen::Vector3d thick = sides.unaryExpr(&with_extent);
    return {make_box(thick), 0.5 * (thick - sides).norm()};
}

EnclosingPolyhedron PrimitiveShapes::made(const RoundBody& given) const {
    const auto& [kind, given_radius, given_length] = given;
    const double radius = with_extent(given_radius), added = radius - given_radius;
    if (kind == "cylinder") {
        const double length = with_extent(given_length);
        const EnclosingPolyhedron body = enclosing_cylinder(radius, length, deviation_ * radius);
        return {body.shape, body.deviation + added + 0.5 * (length - given_length)};
    }
    const bool is_sphere = given_length == 0; // also a capsule without length
    return {is_sphere ? make_sphere(radius) : make_capsule(radius, given_length), added};
}

const EnclosingPolyhedron& PrimitiveShapes::round_body(const std::string& kind, double radius, double length) {
    const RoundBody body{kind, radius, length};
    if (const auto known = round_bodies_.find(body); known != round_bodies_.end())
        return known->second;
    return round_bodies_.emplace(body, made(body)).first->second;
}

} // namespace chasles::robot
