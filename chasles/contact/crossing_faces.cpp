#include "chasles/contact/crossing_faces.h"

#include "chasles/elementary/face_shape.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace chasles::contact {

namespace {

using elementary::ConvexPart;
using elementary::FaceShape;
using Vector = algebra::Vector3<double>;
using Corners = std::vector<Vector>;

Vector unit(const Vector& v) {
    return scale(v, 1 / length(v));
}

/// The corners of a face in the fixed body's frame. `place` carries a vertex there.
template <class Place>
Corners placed_corners(const Body& body, std::uint32_t face, const Place& place) {
    Corners corners;
    for (const std::uint32_t vertex : body.face(face)) {
        const Eigen::Vector3d point = place(body.vertices()[vertex]);
        corners.push_back({point.x(), point.y(), point.z()});
    }
    return corners;
}

/// Calls `visit` with the start of each side of a part and the unit vector across it into the part.
template <class Visit>
void for_each_side(const ConvexPart<double>& part, const Visit& visit) {
    for (std::size_t i = 0; i < part.count; ++i) {
        const Vector& from = part.corner(i);
        visit(from, unit(cross(part.face.normal, part.next_corner(i) - from)));
    }
}

/// A part of a line: origin + s * direction for s in [lower, upper].
struct Stretch {
    Vector origin;
    Vector direction; ///< unit
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();

    /// Keeps what lies on the inner side of each side of a part.
    void clip(const ConvexPart<double>& part) {
        for_each_side(part, [&](const Vector& from, const Vector& inwards) {
            const double height = dot(inwards, origin - from), slope = dot(inwards, direction);
            if (slope > 0)
                lower = std::max(lower, -height / slope);
            else if (slope < 0)
                upper = std::min(upper, -height / slope);
        });
    }
    [[nodiscard]] Vector middle() const { return origin + scale(direction, lower + (upper - lower) / 2); }
};

/// The least distance of a point from the sides of a part; negative outside of the part.
double depth_in(const ConvexPart<double>& part, const Vector& point) {
    double depth = std::numeric_limits<double>::infinity();
    for_each_side(
        part, [&](const Vector& from, const Vector& inwards) { depth = std::min(depth, dot(inwards, point - from)); });
    return depth;
}

/// How far corners are from the plane of their face.
double deviation_of(const FaceShape<double>& face) {
    return face.deviation / length(face.normal);
}

bool are_parts_crossing(const ConvexPart<double>& a, const ConvexPart<double>& b, double error) {
    const Vector normal_of_a = unit(a.face.normal), normal_of_b = unit(b.face.normal);
    const Vector across = cross(normal_of_a, normal_of_b);
    const double sine = length(across);
    if (!(sine > no_direction))
        return false;
    // The point of both planes that is nearest to the first corner of `a`.
    const Vector& start = a.face.corners[0];
    const double height = dot(normal_of_b, b.face.corners[0] - start);
    Stretch stretch{start + scale(cross(across, normal_of_a), height / (sine * sine)), scale(across, 1 / sine)};
    stretch.clip(a);
    stretch.clip(b);
    if (!(stretch.lower < stretch.upper))
        return false;
    const Vector point = stretch.middle();
    const double total = error + deviation_of(a.face) + deviation_of(b.face);
    return std::min(depth_in(a, point), depth_in(b, point)) * sine * sine > 32 * total;
}

} // namespace

bool are_crossing(const RelativeConfiguration& bodies, std::uint32_t moving_face, std::uint32_t fixed_face,
                  double error) {
    const Corners moving =
        placed_corners(bodies.moving(), moving_face, [&](const Eigen::Vector3d& point) { return bodies.moved(point); });
    const Corners fixed =
        placed_corners(bodies.fixed(), fixed_face, [](const Eigen::Vector3d& point) { return point; });
    const auto a = elementary::face_shape<double>(moving, bodies.moving().face_triangles(moving_face));
    const auto b = elementary::face_shape<double>(fixed, bodies.fixed().face_triangles(fixed_face));
    for (std::size_t i = 0; i < convex_part_count(a); ++i)
        for (std::size_t k = 0; k < convex_part_count(b); ++k)
            if (are_parts_crossing(convex_part(a, i), convex_part(b, k), error))
                return true;
    return false;
}

} // namespace chasles::contact
