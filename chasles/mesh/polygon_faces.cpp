// Checks each polygon in this order: it is planar or can be cut, it is not folded, it is convex or covered by
// triangles. Triangles need no check.
#include "chasles/mesh/polygon_faces.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/mesh/polygon_plane.h"
#include "chasles/mesh/triangulate_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace chasles {
namespace {

/// Six digits in a file move a corner by up to 5e-6 of its coordinate (docs/decisions/0010-polygon-planarity.md).
constexpr double planar_within = 1e-5;
/// The rounding of the deviation itself. It is the only tolerance if polygons are cut into triangles.
constexpr double rounding_within = 32 * std::numeric_limits<double>::epsilon();

/// The greatest deviation from a plane, in the length unit.
double allowed_deviation(const PolygonProjection& projection, const PolyhedronOptions& options) {
    return (options.triangulate ? rounding_within : planar_within) * std::max(projection.size, projection.magnitude);
}

/// A corner counts as a left turn only if its turn far exceeds the rounding of the normal and of the turn.
constexpr double clear_turn = 0x1p-44;

/// One polygon under test.
struct Polygon {
    std::span<const Eigen::Vector3d> vertices; ///< of the whole mesh
    std::span<const std::uint32_t> outline;
    std::uint32_t source;
    PolygonProjection projection;

    [[nodiscard]] const Eigen::Vector3d& corner(std::size_t i) const { return vertices[outline[i % outline.size()]]; }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InvalidInput("face " + std::to_string(source) + ": " + why);
    }
};

/// Refuses an outline that turns back onto the previous side.
void check_not_folded(const Polygon& polygon) {
    const std::size_t corner = find_turning_back(polygon.projection.corners);
    if (corner < polygon.outline.size())
        polygon.refuse("its outline turns back onto itself at vertex " + std::to_string(polygon.outline[corner]));
}

/// Triangles that cover the polygon exactly once. Refuses an outline that crosses itself.
std::vector<std::uint32_t> triangles_of(const Polygon& polygon) {
    auto triangles = triangulate_polygon(polygon.projection.corners);
    if (!triangles)
        polygon.refuse("its outline crosses itself");
    return *std::move(triangles);
}

/// Appends the triangles of a polygon that is not planar as faces.
void append_cut(const Polygon& polygon, FaceOutlines& faces) {
    const std::vector<std::uint32_t> triangles = triangles_of(polygon);
    // A corner without a triangle lies on a line only in the projection, therefore the surface would change.
    if (triangles.size() != 3 * (polygon.outline.size() - 2))
        polygon.refuse("is not planar and can't be cut into triangles, because its outline touches itself");
    for (std::size_t i = 0; i < triangles.size(); i += 3)
        faces.append(std::array{polygon.outline[triangles[i]], polygon.outline[triangles[i + 1]],
                                polygon.outline[triangles[i + 2]]},
                     polygon.source);
}

/// Whether the outline turns left at every corner, in the projection along the normal of the contact tests (Newell's
/// method). Only then do the half-planes of the edges cover the polygon. A convex projection along a coordinate axis is
/// not sufficient if a corner is straight or off the plane. Source: docs/derivations/05-being-inside.md.
bool turns_left_everywhere(const Polygon& polygon) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double size = 0;
    for (std::size_t i = 1; i + 1 < polygon.outline.size(); ++i) {
        const Eigen::Vector3d a = polygon.corner(i) - polygon.corner(0);
        const Eigen::Vector3d b = polygon.corner(i + 1) - polygon.corner(0);
        normal += a.cross(b);
        size += a.lpNorm<1>() * b.lpNorm<1>();
    }
    for (std::size_t i = 0; i < polygon.outline.size(); ++i) {
        const Eigen::Vector3d in = polygon.corner(i + 1) - polygon.corner(i);
        const Eigen::Vector3d out = polygon.corner(i + 2) - polygon.corner(i + 1);
        if (!(normal.dot(in.cross(out)) > clear_turn * size * in.lpNorm<1>() * out.lpNorm<1>()))
            return false;
    }
    return true;
}

/// The triangles at the first corner. They cover a polygon that is convex up to the deviation of its corners.
std::vector<std::uint32_t> fan(std::size_t corners) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 1; i + 1 < corners; ++i)
        triangles.insert(triangles.end(), {0, i, i + 1});
    return triangles;
}

/// Appends a planar polygon as one face.
void append_whole(const Polygon& polygon, PolygonFaces& result) {
    check_not_folded(polygon);
    const std::size_t face = result.faces.source.size();
    result.faces.append(polygon.outline, polygon.source);
    const bool convex = is_convex(polygon.projection.corners);
    if (convex && turns_left_everywhere(polygon))
        return;
    FlatLists<std::uint32_t>& triangles = result.triangles;
    triangles.offsets.resize(face + 1,
                             static_cast<std::uint32_t>(triangles.items.size())); // no triangles for the faces before
    triangles.append(convex ? fan(polygon.outline.size()) : triangles_of(polygon));
}

/// Checks a polygon and appends it whole or cut.
void append_polygon(const Polygon& polygon, const PolyhedronOptions& options, PolygonFaces& result) {
    if (polygon.projection.is_flat)
        polygon.refuse("has no area beyond rounding (its outline crosses itself, turns back or is too thin)");
    const double allowed = allowed_deviation(polygon.projection, options);
    if (polygon.projection.deviation <= allowed)
        append_whole(polygon, result);
    else if (options.triangulate)
        append_cut(polygon, result.faces);
    else
        polygon.refuse("is not planar (its vertices leave a plane by " + number_text(polygon.projection.deviation, 3) +
                       ", and " + number_text(allowed, 3) + " is allowed)");
}

} // namespace

PolygonFaces examine_polygons(FaceOutlines given, std::span<const Eigen::Vector3d> vertices,
                              const PolyhedronOptions& options) {
    PolygonFaces result;
    if (given.outlines.items.size() == 3 * given.source.size()) {
        result.faces = std::move(given);
        return result;
    }
    for (std::size_t i = 0; i < given.source.size(); ++i) {
        const std::span<const std::uint32_t> outline = given.outlines[i];
        if (outline.size() == 3)
            result.faces.append(outline, given.source[i]);
        else
            append_polygon({vertices, outline, given.source[i], project_polygon(vertices, outline)}, options, result);
    }
    if (!result.triangles.items.empty())
        result.triangles.offsets.resize(result.faces.source.size() + 1, result.triangles.offsets.back());
    return result;
}

} // namespace chasles
