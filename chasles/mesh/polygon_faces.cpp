// The checks of one polygon in order: planar or to be cut, not folded, convex or covered by triangles.
#include "chasles/mesh/polygon_faces.h"

#include "chasles/invalid_input.h"
#include "chasles/mesh/polygon_plane.h"
#include "chasles/mesh/triangulate_polygon.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>

namespace chasles {
namespace {

/// Six digits in a file move a corner by up to 5e-6 of its coordinate (docs/decisions/0010-polygon-planarity.md).
constexpr double planar_within = 1e-5;
/// The rounding of the deviation itself; all that is forgiven where creases are wanted.
constexpr double rounding_within = 32 * std::numeric_limits<double>::epsilon();

double allowed_deviation(const PolygonView& view, const PolyhedronOptions& options) {
    return (options.triangulate ? rounding_within : planar_within) * std::max(view.size, view.magnitude);
}

/// One polygon on its way through the checks.
struct Polygon {
    std::span<const std::uint32_t> outline;
    std::uint32_t source;
    PolygonView view;

    [[noreturn]] void refuse(const std::string& why) const {
        throw InvalidInput(fmt::format("face {}: {}", source, why));
    }
};

void check_not_folded(const Polygon& polygon) {
    const std::size_t corner = find_turning_back(polygon.view.corners);
    if (corner < polygon.outline.size())
        polygon.refuse(fmt::format("its outline turns back onto itself at vertex {}", polygon.outline[corner]));
}

std::vector<std::uint32_t> triangles_of(const Polygon& polygon) {
    auto triangles = triangulate_polygon(polygon.view.corners);
    if (!triangles)
        polygon.refuse("its outline crosses itself");
    return *std::move(triangles);
}

void append_cut(const Polygon& polygon, FaceOutlines& faces) {
    const std::vector<std::uint32_t> triangles = triangles_of(polygon);
    // A corner left out lies on a line only as seen along the normal, so the surface would change.
    if (triangles.size() != 3 * (polygon.outline.size() - 2))
        polygon.refuse("is not planar and can't be cut into triangles, because its outline touches itself");
    for (std::size_t i = 0; i < triangles.size(); i += 3)
        faces.append(std::array{polygon.outline[triangles[i]], polygon.outline[triangles[i + 1]],
                                polygon.outline[triangles[i + 2]]},
                     polygon.source);
}

void append_whole(const Polygon& polygon, PolygonFaces& result) {
    check_not_folded(polygon);
    const std::size_t face = result.faces.source.size();
    result.faces.append(polygon.outline, polygon.source);
    if (is_convex(polygon.view.corners))
        return;
    FlatLists<std::uint32_t>& triangles = result.triangles;
    triangles.offsets.resize(face + 1, static_cast<std::uint32_t>(triangles.items.size())); // none for those before
    triangles.append(triangles_of(polygon));
}

void append_polygon(const Polygon& polygon, const PolyhedronOptions& options, PolygonFaces& result) {
    if (polygon.view.is_flat)
        polygon.refuse("has no area beyond rounding (its outline crosses itself, turns back or is too thin)");
    const double allowed = allowed_deviation(polygon.view, options);
    if (polygon.view.deviation <= allowed)
        append_whole(polygon, result);
    else if (options.triangulate)
        append_cut(polygon, result.faces);
    else
        polygon.refuse(fmt::format("is not planar (its vertices leave a plane by {:.3g}, and {:.3g} is allowed)",
                                   polygon.view.deviation, allowed));
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
            append_polygon({outline, given.source[i], view_polygon(vertices, outline)}, options, result);
    }
    if (!result.triangles.items.empty())
        result.triangles.offsets.resize(result.faces.source.size() + 1, result.triangles.offsets.back());
    return result;
}

} // namespace chasles
