#include "chasles/contact/crossing_faces.h"

#include "chasles/mesh/face_normal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace chasles::contact {

namespace {

using Eigen::Vector3d;

/// A convex part of a face in the fixed body's frame.
struct PlacedPart {
    std::vector<Vector3d> corners;
    Vector3d normal = Vector3d::Zero(); ///< unit
    double deviation = 0;               ///< of the corners from the plane through the first corner

    explicit PlacedPart(std::vector<Vector3d> given) : corners(std::move(given)) {
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            normal += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
        normal.stableNormalize();
        for (const Vector3d& corner : corners)
            deviation = std::max(deviation, std::abs(normal.dot(corner - corners[0])));
    }
};

/// The convex parts of a face: the face, or the triangles that cover it. `place` carries a vertex into the fixed frame.
template <class Place>
std::vector<PlacedPart> placed_parts(const Body& body, std::uint32_t face, const Place& place) {
    std::vector<PlacedPart> parts;
    if (body.is_segment(face))
        return parts;
    const auto outline = body.face(face);
    const auto triangles = body.face_triangles(face);
    const auto corner = [&](std::uint32_t i) { return place(body.vertices()[outline[i]]); };
    for (std::size_t t = 0; t < triangles.size(); t += 3)
        parts.emplace_back(std::vector{corner(triangles[t]), corner(triangles[t + 1]), corner(triangles[t + 2])});
    if (triangles.empty()) {
        std::vector<Vector3d> corners;
        for (std::uint32_t i = 0; i < outline.size(); ++i)
            corners.push_back(corner(i));
        parts.emplace_back(std::move(corners));
    }
    return parts;
}

/// A part of a line: origin + s * direction for s in [lower, upper].
struct Stretch {
    Vector3d origin;
    Vector3d direction; ///< unit
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();

    /// Keeps what lies on the inner side of each side of a part.
    void clip(const PlacedPart& part) {
        for_each_side(part, [&](const Vector3d& from, const Vector3d& inwards) {
            const double height = inwards.dot(origin - from), slope = inwards.dot(direction);
            if (slope > 0)
                lower = std::max(lower, -height / slope);
            else if (slope < 0)
                upper = std::min(upper, -height / slope);
        });
    }
    [[nodiscard]] Vector3d middle() const { return origin + (lower + (upper - lower) / 2) * direction; }

    /// Calls `visit` with the start of each side and the unit vector across it into the part.
    template <class Visit>
    static void for_each_side(const PlacedPart& part, const Visit& visit) {
        for (std::size_t i = 0; i < part.corners.size(); ++i) {
            const Vector3d& from = part.corners[i];
            const Vector3d& to = part.corners[i + 1 == part.corners.size() ? 0 : i + 1];
            visit(from, part.normal.cross(to - from).stableNormalized());
        }
    }
};

/// The least distance of a point from the sides of a part; negative outside of the part.
double depth_in(const PlacedPart& part, const Vector3d& point) {
    double depth = std::numeric_limits<double>::infinity();
    Stretch::for_each_side(part, [&](const Vector3d& from, const Vector3d& inwards) {
        depth = std::min(depth, inwards.dot(point - from));
    });
    return depth;
}

bool are_parts_crossing(const PlacedPart& a, const PlacedPart& b, double error) {
    const Vector3d across = a.normal.cross(b.normal);
    const double sine = across.norm();
    if (!(sine > no_direction))
        return false;
    // The point of both planes that is nearest to the first corner of `a`.
    const double height = b.normal.dot(b.corners[0] - a.corners[0]);
    const Vector3d in_a = across.cross(a.normal) / (sine * sine);
    Stretch stretch{a.corners[0] + height * in_a, across / sine};
    stretch.clip(a);
    stretch.clip(b);
    if (!(stretch.lower < stretch.upper))
        return false;
    const Vector3d point = stretch.middle();
    const double total = error + a.deviation + b.deviation;
    return std::min(depth_in(a, point), depth_in(b, point)) * sine * sine > 32 * total;
}

} // namespace

bool are_crossing(const RelativeConfiguration& bodies, std::uint32_t moving_face, std::uint32_t fixed_face,
                  double error) {
    const auto moving_parts =
        placed_parts(bodies.moving(), moving_face, [&](const Vector3d& point) { return bodies.moved(point); });
    const auto fixed_parts = placed_parts(bodies.fixed(), fixed_face, [](const Vector3d& point) { return point; });
    return std::ranges::any_of(moving_parts, [&](const PlacedPart& a) {
        return std::ranges::any_of(fixed_parts, [&](const PlacedPart& b) { return are_parts_crossing(a, b, error); });
    });
}

} // namespace chasles::contact
