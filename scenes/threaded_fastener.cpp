#include "scenes/threaded_fastener.h"

#include "scenes/require.h"
#include "scenes/triangle_mesh.h"

#include <cmath>
#include <fmt/core.h>
#include <numbers>

namespace chasles::scenes {

namespace {

using std::numbers::pi;

void require_usable(const ThreadedFastener& size) {
    const double lengths[] = {size.nominal_diameter, size.pitch,      size.bolt_length,
                              size.head_height,      size.nut_height, size.width_across_flats,
                              size.radial_clearance};
    for (const double length : lengths)
        require("threaded fastener", length > 0 && length < 1e6, "sizes", "each must be positive");
    require("threaded fastener", size.segments >= 12 && size.segments <= 10000, "segments", "between 12 and 10000");
    require("threaded fastener", size.bolt_thread().root_radius() > 0, "pitch", "too coarse for the diameter");
    require("threaded fastener", size.width_across_flats > 1.2 * size.nominal_diameter, "width across flats",
            "too small for the thread");
    require("threaded fastener",
            radial_facet_error(size) < size.radial_clearance && axial_facet_error(size) < axial_clearance(size),
            "segments", "too few: the facets would use up the clearance");
}

// The helices of the profile's corners, numbered along the axis. Line k + 4 is line k raised by one pitch. Line k ends
// after a full turn at the start of line k + 4.
class ThreadLines {
public:
    ThreadLines(const MetricThread& thread, int segments)
        : thread_(thread), corners_(thread.corners()), segments_(segments) {}

    [[nodiscard]] Eigen::Vector3d point(int line, int segment) const {
        const ProfileCorner& corner = corners_[(line % 4 + 4) % 4];
        const double turns = std::floor(line / 4.0) + static_cast<double>(segment) / segments_;
        const double angle = 2 * pi * segment / segments_;
        return {corner.radius * std::cos(angle), corner.radius * std::sin(angle), corner.axial + thread_.pitch * turns};
    }

private:
    MetricThread thread_;
    std::array<ProfileCorner, 4> corners_;
    int segments_;
};

// The side of the material. Each facet of a flank is split into two triangles along the diagonal that removes material:
// (k, j + 1) to (k + 1, j) for the bolt, the opposite diagonal for the nut, on both flanks (derivation 09).
enum class Material : std::uint8_t { inside, outside };

void add_facet(TriangleMesh& mesh, const std::array<Index, 4>& corner, bool is_cut_upward) {
    const auto [low, low_next, high_next, high] = corner;
    if (is_cut_upward) {
        mesh.triangles.push_back({low, low_next, high_next});
        mesh.triangles.push_back({low, high_next, high});
    } else {
        mesh.triangles.push_back({low, low_next, high});
        mesh.triangles.push_back({low_next, high_next, high});
    }
}

// The thread surface with its triangles counter-clockwise when viewed from outside. Its first and last lines lie
// entirely outside [0, height].
TriangleMesh endless_thread(const MetricThread& thread, const ThreadedFastener& size, double height,
                            Material material) {
    const ThreadLines lines(thread, size.segments);
    const int first = -12;
    const int last = 4 * static_cast<int>(std::ceil(height / size.pitch)) + 8;
    TriangleMesh mesh;
    for (int line = first; line <= last + 4; ++line) {
        for (int segment = 0; segment < size.segments; ++segment)
            mesh.add(lines.point(line, segment));
    }
    const auto vertex = [&](int line, int segment) {
        return static_cast<Index>((line - first + 4 * (segment / size.segments)) * size.segments +
                                  segment % size.segments);
    };
    for (int line = first; line < last; ++line) {
        for (int segment = 0; segment < size.segments; ++segment) {
            add_facet(mesh,
                      {vertex(line, segment), vertex(line, segment + 1), vertex(line + 1, segment + 1),
                       vertex(line + 1, segment)},
                      material == Material::outside);
        }
    }
    return mesh;
}

// The thread, cut off at z = 0 and z = height.
TriangleMesh thread_between_planes(const MetricThread& thread, const ThreadedFastener& size, double height,
                                   Material material) {
    const double snap = 1e-9 * size.pitch; // far above rounding, far below any clearance
    const TriangleMesh endless = endless_thread(thread, size, height, material);
    return cut_off(cut_off(endless, Side::above, 0, snap), Side::below, height, snap);
}

// A regular hexagon about the axis, counter-clockwise when viewed from +z, with two flats normal to y.
std::vector<Index> add_hexagon(TriangleMesh& mesh, double width_across_flats, double height) {
    const double half = width_across_flats / 2;
    const double corner = width_across_flats / std::numbers::sqrt3;
    const Eigen::Vector2d outline[] = {{corner, 0},  {corner / 2, half},   {-corner / 2, half},
                                       {-corner, 0}, {-corner / 2, -half}, {corner / 2, -half}};
    std::vector<Index> hexagon;
    for (const Eigen::Vector2d& point : outline)
        hexagon.push_back(mesh.add({point.x(), point.y(), height}));
    return hexagon;
}

void add_walls(TriangleMesh& mesh, const std::vector<Index>& lower, const std::vector<Index>& upper) {
    for (std::size_t i = 0; i < lower.size(); ++i) {
        const std::size_t next = (i + 1) % lower.size();
        add_facet(mesh, {lower[i], lower[next], upper[next], upper[i]}, true);
    }
}

std::vector<Index> reversed(const std::vector<Index>& loop) {
    return {loop.rbegin(), loop.rend()};
}

} // namespace

MetricThread ThreadedFastener::bolt_thread() const {
    return {nominal_diameter - 2 * radial_clearance, pitch};
}

MetricThread ThreadedFastener::nut_thread() const {
    return {nominal_diameter, pitch};
}

double axial_clearance(const ThreadedFastener& fastener) {
    return fastener.radial_clearance * flank_slope();
}

double radial_facet_error(const ThreadedFastener& fastener) {
    return fastener.nut_thread().crest_radius() * (1 - std::cos(pi / fastener.segments));
}

double axial_facet_error(const ThreadedFastener& fastener) {
    const double half = pi / fastener.segments;
    const double steepest = std::sqrt(std::tan(half) / half - 1) / std::tan(half);
    const double angle_error = std::atan(steepest * std::tan(half)) - steepest * half;
    return flank_slope() * radial_facet_error(fastener) + 2 * fastener.bolt_thread().lead(angle_error);
}

Polyhedron bolt(const ThreadedFastener& fastener) {
    require_usable(fastener);
    TriangleMesh mesh = thread_between_planes(fastener.bolt_thread(), fastener, fastener.bolt_length, Material::inside);
    close_with_fan(mesh, rim(mesh, fastener.bolt_length));
    const auto lower = add_hexagon(mesh, fastener.width_across_flats, -fastener.head_height);
    const auto upper = add_hexagon(mesh, fastener.width_across_flats, 0);
    close_with_ring(mesh, rim(mesh, 0), upper);
    add_walls(mesh, lower, upper);
    close_with_fan(mesh, lower);
    return mesh.polyhedron();
}

Polyhedron nut(const ThreadedFastener& fastener) {
    require_usable(fastener);
    TriangleMesh mesh = thread_between_planes(fastener.nut_thread(), fastener, fastener.nut_height, Material::outside);
    flip(mesh);
    const auto lower = add_hexagon(mesh, fastener.width_across_flats, 0);
    const auto upper = add_hexagon(mesh, fastener.width_across_flats, fastener.nut_height);
    close_with_ring(mesh, rim(mesh, 0), reversed(lower));
    close_with_ring(mesh, rim(mesh, fastener.nut_height), upper);
    add_walls(mesh, lower, upper);
    return mesh.polyhedron();
}

} // namespace chasles::scenes
