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
    const double deviation = deviation_ * radius;
    if (kind == "cylinder") {
        const double length = with_extent(given_length);
        const EnclosingPolyhedron body = enclosing_cylinder(radius, length, deviation);
        return {body.shape, body.deviation + added + 0.5 * (length - given_length)};
    }
    const EnclosingPolyhedron body = given_length == 0 // a capsule without length is a sphere
                                         ? enclosing_sphere(radius, deviation)
                                         : enclosing_capsule(radius, given_length, deviation);
    return {body.shape, body.deviation + added};
}

const EnclosingPolyhedron& PrimitiveShapes::round_body(const std::string& kind, double radius, double length) {
    const RoundBody body{kind, radius, length};
    if (const auto known = round_bodies_.find(body); known != round_bodies_.end())
        return known->second;
    return round_bodies_.emplace(body, made(body)).first->second;
}

} // namespace chasles::robot
