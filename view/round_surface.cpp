#include "view/round_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <vector>

namespace chasles::view {
namespace {

using Eigen::Vector3d;
using Ids = std::array<std::uint32_t, 2>;

/// The balls and tubes of a body have at most so many triangles, as long as they stay round to the eye.
constexpr std::size_t enough = 40'000;
/// So many balls, and so many tubes, are drawn at most.
constexpr std::size_t most = 20'000;

struct RoundParts {
    std::vector<std::uint32_t> vertices;
    std::vector<Ids> edges;
};

template <class Part>
void keep_each_once(std::vector<Part>& parts) {
    std::ranges::sort(parts);
    parts.erase(std::ranges::unique(parts).begin(), parts.end());
}

RoundParts parts_of(const Polyhedron& body) {
    RoundParts parts;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto outline = body.face(face);
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const std::uint32_t from = outline[i], to = outline[(i + 1) % outline.size()];
            parts.vertices.push_back(from);
            if (from != to)
                parts.edges.push_back({std::min(from, to), std::max(from, to)});
        }
    }
    keep_each_once(parts.vertices);
    keep_each_once(parts.edges);
    return parts;
}

/// At most `most` of them, the same ones each time. Every n-th one would be stripes where points lie in rows.
template <class Part>
std::vector<Part> sample(const std::vector<Part>& parts) {
    std::vector<Part> chosen;
    std::ranges::sample(parts, std::back_inserter(chosen), std::ptrdiff_t(most), std::mt19937());
    return chosen;
}

/// So many corners has a tube around it; a ball has rings of so many.
int sides_of(const RoundParts& parts) {
    const std::size_t balls = std::min(parts.vertices.size(), most), tubes = std::min(parts.edges.size(), most);
    for (const std::size_t sides : {24U, 16U, 12U, 8U, 6U})
        if (balls * sides * sides + tubes * 2 * sides <= enough)
            return int(sides);
    return 4;
}

class RoundSurface {
public:
    RoundSurface(DrawnMesh& drawn, const Polyhedron& body) : drawn_(drawn), body_(body), radius_(body.radius()) {}

    void add() {
        const RoundParts parts = parts_of(body_);
        const int sides = sides_of(parts);
        for (const std::uint32_t vertex : sample(parts.vertices))
            add_rings(place(vertex), Vector3d::Zero(), sides);
        for (const auto& [from, to] : sample(parts.edges))
            add_rings(place(from), place(to) - place(from), sides);
        for (std::size_t face = 0; face < body_.face_count(); ++face)
            for (const auto& triangle : body_.triangles(face))
                add_both_sides(triangle);
    }

private:
    [[nodiscard]] Vector3d place(std::uint32_t vertex) const { return body_.vertices()[vertex] - drawn_.origin; }

    std::uint32_t add_vertex(const Vector3d& point) {
        const Eigen::Vector3f rounded = point.cast<float>();
        drawn_.vertices.push_back({rounded.x(), rounded.y(), rounded.z()});
        return std::uint32_t(drawn_.vertices.size() - 1);
    }

    /// A ball about a point, or a tube along a way: rings of corners, joined by triangles.
    void add_rings(const Vector3d& from, const Vector3d& way, int sides) {
        const bool is_ball = way.isZero(0);
        const Vector3d axis = is_ball ? Vector3d(Vector3d::UnitZ()) : way.normalized();
        const Vector3d across = axis.unitOrthogonal(), third = axis.cross(across);
        const int rings = is_ball ? sides / 2 : 1;
        const auto corner = [&](int ring, int side) -> Vector3d {
            const double around = 2 * std::numbers::pi * side / sides;
            const double up = is_ball ? std::numbers::pi * ring / rings : std::numbers::pi / 2;
            const Vector3d out = std::cos(around) * across + std::sin(around) * third;
            return from + (is_ball ? 0.0 : double(ring)) * way + radius_ * (std::sin(up) * out - std::cos(up) * axis);
        };
        const auto first = std::uint32_t(drawn_.vertices.size()), n = std::uint32_t(sides);
        for (int ring = 0; ring <= rings; ++ring)
            for (int side = 0; side < sides; ++side)
                add_vertex(corner(ring, side));
        for (std::uint32_t ring = 0; ring < std::uint32_t(rings); ++ring)
            for (std::uint32_t side = 0; side < n; ++side) {
                const std::uint32_t a = first + ring * n + side, b = first + ring * n + (side + 1) % n;
                drawn_.triangles.push_back({a, b, b + n});
                drawn_.triangles.push_back({a, b + n, a + n});
            }
    }

    void add_both_sides(const std::array<std::uint32_t, 3>& triangle) {
        const Vector3d a = place(triangle[0]), b = place(triangle[1]), c = place(triangle[2]);
        const Vector3d normal = (b - a).cross(c - a).stableNormalized();
        if (normal.isZero(0))
            return;
        const Vector3d out = radius_ * normal;
        const std::uint32_t first = add_vertex(a + out);
        for (const Vector3d& corner :
             {Vector3d(b + out), Vector3d(c + out), Vector3d(a - out), Vector3d(b - out), Vector3d(c - out)})
            add_vertex(corner);
        drawn_.triangles.push_back({first, first + 1, first + 2});
        drawn_.triangles.push_back({first + 3, first + 5, first + 4});
    }

    DrawnMesh& drawn_;
    const Polyhedron& body_;
    double radius_;
};

/// "20000 of 100000 points", empty if all are drawn.
std::string share(std::size_t count, const std::string& what) {
    return count <= most ? "" : std::to_string(most) + " of " + std::to_string(count) + " " + what;
}

} // namespace

void add_round_surface(DrawnMesh& drawn, const Polyhedron& body) {
    RoundSurface(drawn, body).add();
}

std::string drawn_in_part(const Polyhedron& body) {
    if (body.radius() == 0)
        return {};
    const RoundParts parts = parts_of(body);
    const std::string points = share(parts.vertices.size(), "points"), edges = share(parts.edges.size(), "edges");
    return points + (points.empty() || edges.empty() ? "" : " and ") + edges;
}

} // namespace chasles::view
