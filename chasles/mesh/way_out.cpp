#include "chasles/mesh/way_out.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace chasles {

namespace {

using Eigen::Vector3d;

/// Whether a way leads through a triangle along its normal. Its rim counts.
bool leads_through(const std::array<Vector3d, 3>& triangle, const Vector3d& from, const Vector3d& to, double flat) {
    const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    const double rim = flat * normal.norm();
    if (!(normal.dot(from - triangle[0]) <= rim && normal.dot(to - triangle[0]) > rim))
        return false;
    const Vector3d way = to - from;
    for (std::size_t i = 0; i < 3; ++i)
        if (way.dot((triangle[i] - from).cross(triangle[(i + 1) % 3] - from)) < 0)
            return false;
    return true;
}

} // namespace

WayOut::WayOut(const Body& body, double flat)
    : body_(body), flat_(flat),
      parts_(parts_of_surface(
          body.vertices().size(), body.face_count(), [&](std::size_t face) { return body.face(std::uint32_t(face)); },
          body.volume().joined)) {}

bool WayOut::leads_through(std::uint32_t face, const Vector3d& from, const Vector3d& to) const {
    const std::span<const std::uint32_t> outline = body_.face(face), triangles = body_.face_triangles(face);
    const auto corner = [&](std::size_t i) { return body_.vertices()[outline[i]]; };
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
        if (chasles::leads_through({corner(triangles[i]), corner(triangles[i + 1]), corner(triangles[i + 2])}, from, to,
                                   flat_))
            return true;
    for (std::size_t i = 2; i < outline.size() && triangles.empty(); ++i)
        if (chasles::leads_through({corner(0), corner(i - 1), corner(i)}, from, to, flat_))
            return true;
    return false;
}

std::optional<std::uint32_t> WayOut::face_on_way(std::uint32_t vertex, const Vector3d& to) {
    const Vector3d& from = body_.vertices()[vertex];
    if (from == to)
        return std::nullopt;
    const Vector3d lower = from.cwiseMin(to) - body_.bvh().centre(), upper = from.cwiseMax(to) - body_.bvh().centre();
    const auto misses = [&](const BvhNode& node) {
        for (std::size_t i = 0; i < 3; ++i)
            if (const auto axis = Eigen::Index(i); lower[axis] > node.upper[i] || upper[axis] < node.lower[i])
                return true;
        return false;
    };
    std::array<std::uint32_t, Bvh::max_depth + 1> stack{};
    for (std::size_t size = 1; size > 0;) {
        const BvhNode& node = body_.bvh().nodes()[stack[--size]];
        if (misses(node))
            continue;
        if (!node.is_leaf()) {
            stack[size++] = node.first;
            stack[size++] = node.first + 1;
            continue;
        }
        const std::uint32_t face = node.first;
        if (parts_.of(body_.face(face)[0]) == parts_.of(vertex) && !std::ranges::count(body_.face(face), vertex) &&
            leads_through(face, from, to))
            return face;
    }
    return std::nullopt;
}

} // namespace chasles
