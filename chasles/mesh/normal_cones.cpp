#include "chasles/mesh/normal_cones.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/base/sort.h"
#include "chasles/mesh/adjacent_directions.h"
#include "chasles/mesh/face_normal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace chasles {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double right_angle = std::numbers::pi / 2;
const NormalCone every_direction{{0, 0, 1}, float(right_angle)};
/// Added to the angle of each cone of a face, edge or vertex. It covers all roundings.
constexpr double rounding = 1e-4;

NormalCone cone(const Vector3d& axis, double angle) {
    if (!(angle + rounding < right_angle) || axis.isZero(0))
        return every_direction;
    return {axis.stableNormalized().cast<float>(), float(angle + rounding)};
}

using Ways = std::vector<Vector3d>;

/// The directions that `for_each_way(collect)` yields, of length one.
template <class ForEachWay>
Ways unit_ways(ForEachWay for_each_way) {
    Ways ways;
    for_each_way([&](const Vector3d& way) {
        ways.push_back(way.stableNormalized());
        return false;
    });
    return ways;
}

/// The greatest angle between consecutive directions of the plane.
double greatest_gap(std::vector<double> angles) {
    chasles::sort(angles);
    double gap = angles.front() + 2 * std::numbers::pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i)
        gap = std::max(gap, angles[i] - angles[i - 1]);
    return gap;
}

/// Directions d with d . w <= 0 for the ways w from a vertex. Let d be at the angle phi from the axis, and e the
/// direction of its part across the axis. Among the ways seen along the axis, one is at most half of the greatest gap
/// from e, and its slope bounds phi.
NormalCone cone_around(const Vector3d& axis, const Ways& ways) {
    const Vector3d first = axis.unitOrthogonal();
    const Vector3d second = axis.cross(first);
    std::vector<double> angles;
    double slope = 0;
    for (const Vector3d& way : ways) {
        const Vector2d across(first.dot(way), second.dot(way));
        if (across.norm() < 1e-3)
            return every_direction;
        angles.push_back(algebra::arc_tangent(across.y(), across.x()));
        slope = std::max(slope, std::abs(axis.dot(way)) / across.norm());
    }
    const double half_gap = angles.empty() ? right_angle : 0.5 * greatest_gap(std::move(angles));
    return half_gap >= right_angle ? every_direction
                                   : cone(axis, algebra::arc_tangent(slope / algebra::cosine(half_gap)));
}

} // namespace

NormalCone cone_of_face(const Body& body, std::uint32_t face) {
    const FaceNormal normal = face_normal(body, face);
    return normal.error < 1e-6 ? cone(normal.unit, 0) : every_direction;
}

/// Directions d at a right angle to an edge with d . w <= 0 for the ways w across its faces. Any two of the ways bound
/// them: d is within pi/2 - theta/2 of the line between the ways, at the angle theta.
NormalCone cone_of_edge(const Body& body, const Edge& edge) {
    const Ways ways = unit_ways([&](auto collect) { any_direction_from_edge(body, edge, collect); });
    const Vector3d along = (body.vertices()[edge.to] - body.vertices()[edge.from]).stableNormalized();
    NormalCone best = every_direction;
    for (std::size_t i = 0; i < ways.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const NormalCone bound = cone((ways[i] - ways[j]).cross(along),
                                          algebra::arc_sine(std::min(1.0, 0.5 * (ways[i] + ways[j]).norm())));
            if (bound.angle < best.angle)
                best = bound;
        }
    return best;
}

/// The smaller of the cones around two axes: the mean of the ways is good at sharp tips, and the axis of the faces'
/// normals where the surface is nearly flat.
NormalCone cone_of_vertex(const Body& body, std::uint32_t vertex) {
    const Ways ways = unit_ways([&](auto collect) { any_direction_from_vertex(body, vertex, collect); });
    NormalCone best = every_direction;
    const auto try_axis = [&](const Vector3d& axis) {
        const NormalCone bound = cone_around(axis.normalized(), ways);
        if (bound.angle < best.angle)
            best = bound;
    };
    const Vector3d sum = std::accumulate(ways.begin(), ways.end(), Vector3d(0, 0, 0));
    if (sum.norm() > 0.1)
        try_axis(sum);
    NormalCone faces = cone_of_face(body, body.faces_around(vertex).front());
    for (const std::uint32_t face : body.faces_around(vertex))
        faces = enclosing(faces, cone_of_face(body, face));
    if (faces.angle < every_direction.angle)
        try_axis(faces.axis.cast<double>());
    return best;
}

NormalCone enclosing(const NormalCone& a, const NormalCone& b) {
    const Vector3d of_a = a.axis.cast<double>();
    const Vector3d of_b = (a.axis.dot(b.axis) < 0 ? -1 : 1) * b.axis.cast<double>();
    const double between = algebra::arc_tangent(of_a.cross(of_b).norm(), of_a.dot(of_b));
    if (between + double(b.angle) <= double(a.angle))
        return a;
    if (between + double(a.angle) <= double(b.angle))
        return b;
    const double angle = 0.5 * (between + double(a.angle) + double(b.angle));
    if (between < 1e-6)
        return cone(of_a, angle);
    const double turn = angle - double(a.angle); // from a's axis towards b's
    return cone((algebra::sine(between - turn) * of_a + algebra::sine(turn) * of_b) / algebra::sine(between), angle);
}

namespace {

/// A face with the vertices and edges that it owns.
NormalCone cone_of_leaf(const Body& body, std::uint32_t face) {
    NormalCone result = cone_of_face(body, face);
    for (const std::uint32_t vertex : body.owned_vertices(face))
        result = enclosing(result, cone_of_vertex(body, vertex));
    for (const Edge& edge : body.owned_edges(face))
        result = enclosing(result, cone_of_edge(body, edge));
    return result;
}

} // namespace

std::vector<NormalCone> normal_cones_of(const Body& body) {
    const std::span<const BvhNode> nodes = body.bvh().nodes();
    std::vector<NormalCone> cones(nodes.size());
    for (std::size_t i = nodes.size(); i-- > 0;) // children follow their parent
        cones[i] = nodes[i].is_leaf() ? cone_of_leaf(body, nodes[i].first)
                                      : enclosing(cones[nodes[i].first], cones[nodes[i].first + 1]);
    return cones;
}

} // namespace chasles
