// Tests each polygon in this order: it has a plane, it is planar, it is not folded, it is convex or covered by
// triangles. Otherwise the polygon is cut or refused. Triangles need no test.
#include "chasles/mesh/polygon_faces.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/mesh/polygon_plane.h"
#include "chasles/mesh/triangulate_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace chasles {
namespace {

/// The rounding of the deviation itself. It is the only tolerance if polygons are cut into triangles.
constexpr double rounding_within = 32 * std::numeric_limits<double>::epsilon();

/// The width of a polygon without a direction, over its size and its number of corners: `PolygonProjection::is_flat`
/// allows 8 epsilons for the area, and a polygon is at least half as long as its bounding box.
constexpr double thin_within = 16 * std::numeric_limits<double>::epsilon();

/// Of a polygon that is not convex. Cutting it takes time in proportion to their square: two seconds for so many.
constexpr std::size_t most_corners = 20'000;

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

    /// For a polygon that the option would cut.
    [[noreturn]] void refuse(const std::string& why) const {
        throw InvalidInput("face " + std::to_string(source) + ": " + why + "; the option triangulate accepts it");
    }
};

/// The triangles at the first corner. They cover a polygon that is convex up to the deviation of its corners. For any
/// other outline they contain every point that the outline winds around.
std::vector<std::uint32_t> fan(std::size_t corners) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 1; i + 1 < corners; ++i)
        triangles.insert(triangles.end(), {0, i, i + 1});
    return triangles;
}

/// Appends the triangles as faces. Triangles of a fan may have no area.
void append_triangles(const Polygon& polygon, std::span<const std::uint32_t> triangles, SortedFaces& faces) {
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        corners = {polygon.outline[triangles[i]], polygon.outline[triangles[i + 1]], polygon.outline[triangles[i + 2]]};
        faces.append(corners, polygon.source, polygon.vertices);
    }
}

/// Appends a polygon cut into triangles that cover it exactly once, if there are any with all corners, otherwise as a
/// fan. A corner without a triangle lies on a line only in the projection, therefore the surface would change.
void append_cut(const Polygon& polygon, SortedFaces& faces) {
    const auto cut = triangulate_polygon(polygon.projection.corners);
    const bool is_complete = cut && cut->size() == 3 * (polygon.outline.size() - 2);
    append_triangles(polygon, is_complete ? *cut : fan(polygon.outline.size()), faces);
}

/// Whether all corners are within rounding of the line through the first corner and the corner farthest from it. This
/// holds for every convex polygon without a direction: twice its area is at least its width times its length.
bool is_thin(const Polygon& polygon) {
    Eigen::Vector3d longest = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i < polygon.outline.size(); ++i)
        if (const Eigen::Vector3d arm = polygon.corner(i) - polygon.corner(0); arm.stableNorm() > longest.stableNorm())
            longest = arm;
    const Eigen::Vector3d along = longest.stableNormalized();
    const double allowed = thin_within * static_cast<double>(polygon.outline.size()) * polygon.projection.size;
    for (std::size_t i = 1; i < polygon.outline.size(); ++i)
        if (!((polygon.corner(i) - polygon.corner(0)).cross(along).norm() <= allowed))
            return false;
    return true;
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

/// Triangles that cover a planar polygon exactly once; none for a polygon that is convex in the contact tests. Empty
/// for an outline that crosses itself.
std::optional<std::vector<std::uint32_t>> covering_triangles(const Polygon& polygon) {
    const bool convex = is_convex(polygon.projection.corners);
    if (!convex)
        return triangulate_polygon(polygon.projection.corners);
    return turns_left_everywhere(polygon) ? std::vector<std::uint32_t>() : fan(polygon.outline.size());
}

/// The faces of a mesh, polygon by polygon.
class PolygonSorter {
public:
    PolygonSorter(std::span<const Eigen::Vector3d> vertices, const PolyhedronOptions& options, FaceOutlines collapsed)
        : vertices_(vertices), options_(options) {
        cut_.collapsed = std::move(collapsed);
    }

    void append(std::span<const std::uint32_t> outline, std::uint32_t source) {
        if (outline.size() == 3)
            cut_.proper.append(outline, source);
        else
            append_polygon({vertices_, outline, source, project_polygon(vertices_, outline)});
    }

    PolygonFaces take() {
        if (!triangles_.items.empty())
            triangles_.offsets.resize(cut_.proper.source.size() + 1, triangles_.offsets.back());
        return {std::move(cut_.proper), std::move(triangles_), std::move(cut_.collapsed)};
    }

private:
    /// Checks a polygon and appends it whole or cut.
    void append_polygon(const Polygon& polygon) {
        if (polygon.projection.is_flat)
            return append_without_plane(polygon);
        if (polygon.outline.size() > most_corners && !is_convex(polygon.projection.corners))
            throw InvalidInput("face " + std::to_string(polygon.source) + ": has " +
                               std::to_string(polygon.outline.size()) +
                               " corners and is not convex; of such faces at most " + std::to_string(most_corners) +
                               " are read: cut it into smaller ones");
        const double allowed = allowed_deviation(polygon.projection, options_);
        if (polygon.projection.deviation <= allowed)
            return append_planar(polygon);
        if (!options_.triangulate)
            polygon.refuse("is not planar (its vertices leave a plane by " +
                           number_text(polygon.projection.deviation, 3) + ", and " + number_text(allowed, 3) +
                           " is allowed)");
        append_cut(polygon, cut_);
    }

    /// A thin polygon is a fan of thin triangles: its corners are within rounding of a line, so all ways to cut it are.
    void append_without_plane(const Polygon& polygon) {
        if (!options_.triangulate && !is_thin(polygon))
            polygon.refuse("has no area beyond rounding (its outline crosses itself or turns back)");
        append_triangles(polygon, fan(polygon.outline.size()), cut_);
    }

    /// Appends a planar polygon as one face, if its outline is simple.
    void append_planar(const Polygon& polygon) {
        const std::size_t folded = find_turning_back(polygon.projection.corners);
        const bool is_folded = folded < polygon.outline.size();
        if (is_folded && !options_.triangulate)
            polygon.refuse("its outline turns back onto itself at vertex " + std::to_string(polygon.outline[folded]));
        const auto triangles = is_folded ? std::nullopt : covering_triangles(polygon);
        if (triangles)
            return append_whole(polygon, *triangles);
        if (!options_.triangulate)
            polygon.refuse("its outline crosses itself");
        append_cut(polygon, cut_);
    }

    void append_whole(const Polygon& polygon, std::span<const std::uint32_t> triangles) {
        const std::size_t face = cut_.proper.source.size();
        cut_.proper.append(polygon.outline, polygon.source);
        if (triangles.empty())
            return;
        // no triangles for the faces before
        triangles_.offsets.resize(face + 1, static_cast<std::uint32_t>(triangles_.items.size()));
        triangles_.append(triangles);
    }

    std::span<const Eigen::Vector3d> vertices_;
    const PolyhedronOptions& options_;
    SortedFaces cut_;
    FlatLists<std::uint32_t> triangles_;
};

} // namespace

PolygonFaces examine_polygons(SortedFaces given, std::span<const Eigen::Vector3d> vertices,
                              const PolyhedronOptions& options) {
    FaceOutlines& proper = given.proper;
    if (proper.outlines.items.size() == 3 * proper.source.size())
        return {std::move(proper), {}, std::move(given.collapsed)};
    PolygonSorter sorter(vertices, options, std::move(given.collapsed));
    for (std::size_t i = 0; i < proper.source.size(); ++i)
        sorter.append(proper.outlines[i], proper.source[i]);
    return sorter.take();
}

} // namespace chasles
