#include "chasles/culling/nearest_to_origin.h"

namespace chasles::culling {

Simplex::Nearest Simplex::of_segment(const Point& a, const Point& b) {
    const Point way = b - a;
    const double along = -dot(a, way), square = dot(way, way);
    if (!(along > 0))
        return {a, dot(a, a), {a}, 1};
    if (!(along < square))
        return {b, dot(b, b), {b}, 1};
    const Point point = a + scale(way, along / square);
    return {point, dot(point, point), {a, b}, 2};
}

/// The foot on the plane if it is inside of all sides; otherwise the nearest point of the sides.
Simplex::Nearest Simplex::of_triangle(const Point& a, const Point& b, const Point& c) {
    const Point normal = cross(b - a, c - a);
    const double square = dot(normal, normal);
    const auto is_inside = [&](const Point& from, const Point& to) { return dot(cross(from, to), normal) > 0; };
    if (square > 0 && is_inside(a, b) && is_inside(b, c) && is_inside(c, a)) {
        const Point foot = scale(normal, dot(a, normal) / square);
        return {foot, dot(foot, foot), {a, b, c}, 3};
    }
    Nearest nearest = of_segment(a, b);
    for (const Nearest& other : {of_segment(b, c), of_segment(c, a)})
        if (other.square < nearest.square)
            nearest = other;
    return nearest;
}

Simplex::Point Simplex::add(const Point& point) {
    Nearest nearest{point, dot(point, point), {point}, 1};
    if (count_ == 1) {
        nearest = of_segment(points_[0], point);
    } else if (count_ >= 2) {
        nearest = of_triangle(points_[0], points_[1], point);
        if (count_ == 3) // the side without the new point is farther than before
            for (const Nearest& other :
                 {of_triangle(points_[1], points_[2], point), of_triangle(points_[2], points_[0], point)})
                if (other.square < nearest.square)
                    nearest = other;
    }
    points_ = nearest.of;
    count_ = nearest.count;
    return nearest.point;
}

} // namespace chasles::culling
