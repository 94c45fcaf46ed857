#include "scenes/spur_gear.h"

#include "scenes/require.h"
#include "scenes/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>
#include <utility>

namespace chasles::scenes {

namespace {

using std::numbers::pi;

constexpr double pressure_angle = pi / 9; // 20 degrees

double root_radius(const SpurGear& gear) {
    return gear.pitch_radius() - 1.25 * gear.module;
}

double bore_radius(const SpurGear& gear) {
    return gear.bore_radius == 0 ? 0.5 * gear.pitch_radius() : gear.bore_radius;
}

void require_usable(const SpurGear& gear) {
    const auto is_positive = [](double length) { return length > 0 && length < 1e6; };
    require("spur gear", gear.teeth >= 17 && gear.teeth <= 1000, "teeth", "between 17 and 1000");
    require("spur gear", is_positive(gear.module), "module", "must be positive");
    require("spur gear", is_positive(gear.width), "width", "must be positive");
    require("spur gear", gear.play >= 0 && gear.play < 0.5 * pi * gear.module, "play",
            "at least 0 and below half of a pitch");
    require("spur gear", is_positive(bore_radius(gear)) && bore_radius(gear) < root_radius(gear), "bore radius",
            "must be positive and below the radius of the roots");
}

/// Half the angle that a tooth spans at a radius that is not below that of the base circle.
double half_tooth(const SpurGear& gear, double radius) {
    const double pitch_radius = gear.pitch_radius();
    const auto involute = [&](double at) {
        const double angle = std::acos(std::min(1.0, pitch_radius * std::cos(pressure_angle) / at));
        return std::tan(angle) - angle;
    };
    const double thickness = 0.5 * (pi * gear.module - gear.play);
    return 0.5 * thickness / pitch_radius + involute(pitch_radius) - involute(radius);
}

/// The flank of a tooth from the root to the tip: radius, and angle from the tooth's middle.
std::vector<std::pair<double, double>> flank(const SpurGear& gear) {
    constexpr int chords = 8;
    const double base = gear.pitch_radius() * std::cos(pressure_angle);
    const double tip = gear.pitch_radius() + gear.module;
    const double start = std::max(base, root_radius(gear));
    std::vector<std::pair<double, double>> points;
    // below the base circle the flank is almost radial
    if (root_radius(gear) < base)
        points.emplace_back(root_radius(gear), 1.02 * half_tooth(gear, base));
    for (int i = 0; i <= chords; ++i) {
        const double radius = start + (tip - start) * i / chords;
        points.emplace_back(radius, half_tooth(gear, radius));
    }
    return points;
}

/// Adds the outline of the gear, or of its bore with corners at the same angles. Both run counter-clockwise when viewed
/// from above.
std::vector<Index> add_outline(TriangleMesh& mesh, const SpurGear& gear, bool is_bore, double height) {
    const auto half = flank(gear);
    std::vector<Index> ring;
    const auto add = [&](double radius, double angle) {
        const double at = is_bore ? bore_radius(gear) : radius;
        ring.push_back(mesh.add({at * std::cos(angle), at * std::sin(angle), height}));
    };
    for (std::size_t tooth = 0; tooth < gear.teeth; ++tooth) {
        const double middle = 2 * pi * double(tooth) / double(gear.teeth);
        for (auto point = half.begin(); point != half.end(); ++point)
            add(point->first, middle - point->second);
        for (auto point = half.rbegin(); point != half.rend(); ++point)
            add(point->first, middle + point->second);
    }
    return ring;
}

void join(TriangleMesh& mesh, const std::vector<Index>& lower, const std::vector<Index>& upper) {
    for (std::size_t i = 0; i < lower.size(); ++i) {
        const std::size_t next = (i + 1) % lower.size();
        mesh.triangles.push_back({lower[i], lower[next], upper[next]});
        mesh.triangles.push_back({lower[i], upper[next], upper[i]});
    }
}

} // namespace

Polyhedron spur_gear(const SpurGear& size) {
    require_usable(size);
    TriangleMesh mesh;
    const auto bottom = add_outline(mesh, size, false, 0);
    const auto top = add_outline(mesh, size, false, size.width);
    const auto bore_top = add_outline(mesh, size, true, size.width);
    const auto bore_bottom = add_outline(mesh, size, true, 0);
    join(mesh, bottom, top);
    join(mesh, top, bore_top);
    join(mesh, bore_top, bore_bottom);
    join(mesh, bore_bottom, bottom);
    return mesh.polyhedron();
}

double meshing_angle(const SpurGear& second) {
    // at an odd number of teeth the middle of a gap points along -x, otherwise a tooth
    return second.teeth % 2 == 0 ? pi / double(second.teeth) : 0;
}

} // namespace chasles::scenes
