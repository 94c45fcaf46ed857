// Prisms about cylinders, and bands of polygons about spheres. Each face is tangent to the round body, or farther out.
// Source: docs/derivations/29-robots.md, "Round bodies".
#include "chasles/mesh/primitives.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace chasles {

namespace {

using Eigen::Vector3d;

/// Bodies are enlarged by this factor. All rounding of vertices is below a thousandth of what it adds.
constexpr double outward = 1 + 1e-12;

struct Named {
    const char* name;
    double value;
};

void require_positive(const char* body, std::initializer_list<Named> numbers) {
    for (const auto& [name, value] : numbers)
        if (!(value > 0 && value <= 1e30))
            throw InvalidInput(std::string(body) + ": " + name + ": must be positive and at most 1e30, and is " +
                               number_text(value));
}

void require_feasible(const char* body, double deviation, double least) {
    if (deviation < least)
        throw InvalidInput(std::string(body) + ": deviation: must be at least " + number_text(least, 6) +
                           ", or the polyhedron has too many faces");
}

/// The least even number of sides of a polygon around a circle of radius 1 whose corners are at most 1 + deviation
/// away.
int sides_around(double deviation) {
    const double half_angle = algebra::arc_tangent(std::sqrt(deviation * (2 + deviation)));
    const int sides = std::max(4, int(std::ceil(std::numbers::pi / half_angle - 1e-9)));
    return sides + sides % 2;
}

/// Rings of vertices about the z axis, closed by a polygon or a point at both ends.
class Rings {
public:
    explicit Rings(int sides) : sides_(std::uint32_t(sides)) {}

    void add(double radius, double height) {
        if (radius == 0) {
            starts_.push_back({std::uint32_t(vertices_.size()), 1});
            vertices_.emplace_back(0, 0, height);
            return;
        }
        starts_.push_back({std::uint32_t(vertices_.size()), sides_});
        for (std::uint32_t i = 0; i < sides_; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides_;
            const auto [sine, cosine] = algebra::sine_cosine(angle);
            vertices_.emplace_back(radius * cosine, radius * sine, height);
        }
    }

    /// Outwards, for rings of ascending height.
    [[nodiscard]] Polyhedron polyhedron() const {
        std::vector<std::vector<std::uint32_t>> faces;
        for (std::size_t k = 0; k + 1 < starts_.size(); ++k)
            for (std::uint32_t i = 0; i < sides_; ++i)
                append_side(faces, starts_[k], starts_[k + 1], i);
        append_end(faces, starts_.front(), true);
        append_end(faces, starts_.back(), false);
        return Polyhedron::from_polygons(vertices_, faces);
    }

private:
    struct Ring {
        std::uint32_t first, count;
        [[nodiscard]] std::uint32_t operator[](std::uint32_t i) const { return first + i % count; }
    };

    /// Quads of equal radius are planar as they are; others are cut into triangles.
    void append_side(std::vector<std::vector<std::uint32_t>>& faces, const Ring& low, const Ring& high,
                     std::uint32_t i) const {
        const bool is_straight = low.count == high.count && vertices_[low[i]].x() == vertices_[high[i]].x() &&
                                 vertices_[low[i]].y() == vertices_[high[i]].y();
        if (is_straight) {
            faces.push_back({low[i], low[i + 1], high[i + 1], high[i]});
            return;
        }
        if (low.count > 1)
            faces.push_back({low[i], low[i + 1], high[i]});
        if (high.count > 1)
            faces.push_back({low[i + 1], high[i + 1], high[i]});
    }
    static void append_end(std::vector<std::vector<std::uint32_t>>& faces, const Ring& ring, bool is_low) {
        if (ring.count == 1)
            return;
        std::vector<std::uint32_t> outline(ring.count);
        for (std::uint32_t i = 0; i < ring.count; ++i)
            outline[is_low ? ring.count - 1 - i : i] = ring[i];
        faces.push_back(std::move(outline));
    }

    std::uint32_t sides_;
    std::vector<Vector3d> vertices_;
    std::vector<Ring> starts_;
};

/// A body of bands between circles of latitude about a sphere that is pulled apart by `length` along z.
///
/// A band between two latitudes is tangent to the sphere in its middle. Around it, each polygon with n sides is tangent
/// to its circle. So the corners are at a factor 1 / cos(step / 2) and, across, 1 / cos(pi / n) away.
EnclosingPolyhedron banded(double radius, double length, double deviation) {
    const int sides = sides_around(std::sqrt(1 + deviation / radius) - 1); // once along, and once across
    const int bands = std::max(2, sides / 2);                              // from pole to pole
    const double step = std::numbers::pi / bands;
    const double enlarged = radius + (outward - 1) * (radius + length);
    const double ring = enlarged / algebra::cosine(step / 2); // the circumscribed polygon of a meridian
    const double across = 1 / algebra::cosine(std::numbers::pi / sides);
    Rings rings(sides);
    for (int k = 0; k <= bands; ++k) {
        const double latitude = -std::numbers::pi / 2 + k * step;
        const bool is_pole = k == 0 || k == bands;
        const double shift = 2 * k < bands ? -length / 2 : length / 2;
        const double width = is_pole ? 0 : ring * across * algebra::cosine(latitude);
        const double height = ring * algebra::sine(latitude) + shift;
        if (2 * k == bands && length > 0)
            rings.add(width, height - length);
        rings.add(width, height);
    }
    return {rings.polyhedron(), ring * across - radius};
}

} // namespace

Polyhedron make_box(const Vector3d& sides) {
    require_positive("box", {{"x", sides.x()}, {"y", sides.y()}, {"z", sides.z()}});
    std::vector<Vector3d> vertices(8);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        vertices[i] = 0.5 * sides.cwiseProduct(Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    const std::vector<std::vector<std::uint32_t>> faces{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return Polyhedron::from_polygons(vertices, faces);
}

Polyhedron make_sphere(double radius) {
    require_positive("sphere", {{"radius", radius}});
    return make_points(std::array{Vector3d(0, 0, 0)}, radius);
}

Polyhedron make_capsule(double radius, double length) {
    require_positive("capsule", {{"radius", radius}, {"length", length}});
    const std::array ends{Vector3d(0, 0, -0.5 * length), Vector3d(0, 0, 0.5 * length)};
    const std::vector<std::vector<std::uint32_t>> segment{{0, 1, 1}};
    return Polyhedron::from_polygons(ends, segment, {.radius = radius});
}

Polyhedron make_points(std::span<const Vector3d> points, double radius) {
    require_positive("points", {{"radius", radius}});
    if (points.empty())
        throw InvalidInput("points: needs at least one point");
    std::vector<std::uint32_t> corners;
    std::vector<std::span<const std::uint32_t>> outlines;
    corners.reserve(3 * points.size()); // spans stay valid
    for (std::uint32_t point = 0; point < points.size(); ++point) {
        corners.insert(corners.end(), 3, point);
        outlines.emplace_back(std::span(corners).last(3));
    }
    return Polyhedron::from_outlines(points, outlines, {.radius = radius});
}

EnclosingPolyhedron enclosing_cylinder(double radius, double length, double deviation) {
    require_positive("cylinder", {{"radius", radius}, {"length", length}, {"deviation", deviation}});
    require_feasible("cylinder", deviation, 1e-5 * radius);
    const int sides = sides_around(deviation / radius);
    const double corner = radius * outward / algebra::cosine(std::numbers::pi / sides);
    Rings rings(sides);
    rings.add(corner, -0.5 * length * outward);
    rings.add(corner, 0.5 * length * outward);
    return {rings.polyhedron(), corner - radius + 0.5 * length * (outward - 1)};
}

EnclosingPolyhedron enclosing_sphere(double radius, double deviation) {
    require_positive("sphere", {{"radius", radius}, {"deviation", deviation}});
    require_feasible("sphere", deviation, 1e-3 * radius);
    return banded(radius, 0, deviation);
}

EnclosingPolyhedron enclosing_capsule(double radius, double length, double deviation) {
    require_positive("capsule", {{"radius", radius}, {"length", length}, {"deviation", deviation}});
    require_feasible("capsule", deviation, 1e-3 * radius);
    return banded(radius, length, deviation);
}

} // namespace chasles
