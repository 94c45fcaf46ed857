// The point of a segment or a triangle that is nearest to the origin. Source: docs/derivations/39-profile.md.
#pragma once

#include "chasles/algebra/vector.h"

#include <array>
#include <cstddef>
#include <span>

namespace chasles::culling {

/// Up to four points, of which a convex hull has a point nearest to the origin.
class Simplex {
public:
    using Point = algebra::Vector3<double>;

    /// Adds a point, and drops those that the nearest point of the hull does not need: at most three are left. Returns
    /// the nearest point. If the origin is inside of the hull, that is the nearest point of its surface.
    Point add(const Point& point);

private:
    struct Nearest {
        Point point;
        double square;
        std::array<Point, 3> of; ///< the points whose hull has it inside
        std::size_t count;
    };
    [[nodiscard]] static Nearest of_segment(const Point& a, const Point& b);
    [[nodiscard]] static Nearest of_triangle(const Point& a, const Point& b, const Point& c);

    std::array<Point, 3> points_;
    std::size_t count_ = 0;
};

} // namespace chasles::culling
