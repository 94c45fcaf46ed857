// The bodies of the playground's scenes, as one JSON text: names, vertices and faces. The build runs this module once, so
// that the page holds meshes of the project's own generators, and none has to be committed.
#include "examples/dragging/shapes.h"
#include "examples/dynamics/shapes.h"
#include "scenes/maze.h"
#include "scenes/spur_gear.h"
#include "scenes/threaded_fastener.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

namespace chasles::playground {
namespace {

using Eigen::Vector3d;
using examples::box;
using examples::rod;
using examples::turned_ring;

/// Lengths in millimetres. A coarse thread of few facets: an update has to fit into a frame.
constexpr scenes::ThreadedFastener fastener{
    .pitch = 6, .bolt_length = 24, .head_height = 7, .nut_height = 6.5, .radial_clearance = 0.7, .segments = 16};
constexpr scenes::Maze maze_size{.columns = 6, .rows = 4, .seed = 3};
constexpr scenes::SpurGear sun{.teeth = 24, .module = 2, .width = 8, .play = 0.5};
constexpr scenes::SpurGear planet{.teeth = 18, .module = 2, .width = 8, .play = 0.5};
constexpr int sides = 48;          // of what is round
constexpr double peg_radius = 8;   // millimetres
constexpr double peg_play = 0.08;  // of the radius
constexpr double plate_height = 14;

Polyhedron shifted(const Polyhedron& body, const Vector3d& by) {
    std::vector<Vector3d> vertices;
    for (const Vector3d& vertex : body.vertices())
        vertices.push_back(vertex + by);
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto corners = body.face(face);
        faces.emplace_back(corners.begin(), corners.end());
    }
    return Polyhedron::from_polygons(vertices, faces);
}

/// Writes bodies one after another.
class Text {
public:
    void add(const char* name, const Polyhedron& body) {
        add(name, std::initializer_list<Polyhedron>{body});
    }

    /// Several surfaces as one body.
    void add(const char* name, std::initializer_list<Polyhedron> parts) {
        fmt::format_to(out(), R"({}"{}":{{"vertices":[)", text_.empty() ? "{" : ",", name);
        const char* comma = "";
        for (const Polyhedron& part : parts)
            for (const Vector3d& vertex : part.vertices()) {
                fmt::format_to(out(), "{}[{},{},{}]", comma, vertex.x(), vertex.y(), vertex.z());
                comma = ",";
            }
        text_ += R"(],"faces":[)";
        comma = "";
        std::size_t first = 0;
        for (const Polyhedron& part : parts) {
            for (std::size_t face = 0; face < part.face_count(); ++face) {
                text_ += comma;
                add_face(part.face(face), first);
                comma = ",";
            }
            first += part.vertices().size();
        }
        text_ += "]}";
    }

    [[nodiscard]] std::string text() const { return text_ + "}"; }

private:
    std::back_insert_iterator<std::string> out() { return std::back_inserter(text_); }

    template <typename Corners>
    void add_face(const Corners& corners, std::size_t first) {
        char separator = '[';
        for (const auto corner : corners) {
            fmt::format_to(out(), "{}{}", separator, corner + first);
            separator = ',';
        }
        text_ += ']';
    }

    std::string text_;
};

void add_peg(Text& text) {
    const double hole = (peg_radius + peg_play) / std::cos(std::numbers::pi / sides);
    text.add("peg", rod(peg_radius, 34, sides));
    text.add("plate", turned_ring({{hole, 0}, {26, 0}, {26, plate_height}, {hole, plate_height}}, sides));
    text.add("table", box({-36, -36, -4}, {36, 36, -0.01}));
}

/// The lid lies above the key: whoever lifts the key does not get it over the walls.
void add_maze(Text& text) {
    const Polyhedron key = scenes::maze_key(maze_size);
    double top = 0;
    for (const Vector3d& vertex : key.vertices())
        top = std::max(top, vertex.z());
    const Vector3d end = scenes::middle_of(maze_size, {maze_size.columns, maze_size.rows - 1});
    const double gap = 0.4;
    text.add("maze", scenes::maze(maze_size));
    text.add("key", key);
    text.add("lid", box({0, 0, top + gap}, {end.x() - maze_size.corridor / 2, end.y() + maze_size.corridor, top + 2}));
}

/// The gear of scenes/spur_gear.h without bore and with three chords a flank, for updates within a frame. Chords make
/// teeth thinner, never thicker. Below the base circle flanks are radial.
Polyhedron coarse_gear(const scenes::SpurGear& size) {
    constexpr double pressure_angle = 20 * std::numbers::pi / 180;
    constexpr int chords = 3;
    const double pitch = size.pitch_radius(), base = pitch * std::cos(pressure_angle);
    const double tip = pitch + size.module, root = pitch - 1.25 * size.module;
    const double half_tooth = (std::numbers::pi * size.module - size.play) / (4 * pitch);
    const auto involute = [](double angle) { return std::tan(angle) - angle; };
    const auto half_angle = [&](double radius) {
        return half_tooth + involute(pressure_angle) - involute(std::acos(std::min(1.0, base / radius)));
    };
    std::vector<Eigen::Vector2d> flank{{root, half_angle(base)}}; // radius and angle from the middle of the tooth
    for (int i = 0; i <= chords; ++i) {
        const double radius = base + (tip - base) * i / chords;
        flank.emplace_back(radius, half_angle(radius));
    }
    std::vector<Eigen::Vector2d> outline;
    for (std::size_t tooth = 0; tooth < size.teeth; ++tooth) {
        const double middle = 2 * std::numbers::pi * double(tooth) / double(size.teeth);
        const auto add = [&](double radius, double angle) {
            outline.emplace_back(radius * std::cos(middle + angle), radius * std::sin(middle + angle));
        };
        for (const Eigen::Vector2d& point : flank)
            add(point.x(), -point.y());
        for (std::size_t i = flank.size(); i-- > 0;)
            add(flank[i].x(), flank[i].y());
    }
    return examples::extruded(outline, size.width);
}

void add_gears(Text& text) {
    text.add("sun gear", coarse_gear(sun));
    text.add("planet gear", coarse_gear(planet));
    text.add("ground", box({-66, -66, -3}, {66, 66, -0.01}));
}

/// A bar with round ends along x: the middles of the ends are at 0 and at `length`.
std::vector<Eigen::Vector2d> bar(double length, double half_width) {
    constexpr int parts = 16; // of a half circle
    std::vector<Eigen::Vector2d> outline;
    for (const double end : {1.0, 0.0})
        for (int i = 0; i <= parts; ++i) {
            const double angle = (0.5 - end + double(i) / parts) * std::numbers::pi;
            outline.emplace_back(end * length + half_width * std::cos(angle), half_width * std::sin(angle));
        }
    return outline;
}

/// A SCARA arm that is stretched along x: two links turn about upright axes at x = 0 and 160, and a quill slides and turns
/// at x = 300. Links keep gaps of a millimetre and more, and only the quill reaches the height of the others.
void add_robot(Text& text) {
    constexpr int facets = 24;
    text.add("pedestal", {rod(30, 200, facets), box({-60, -60, -8}, {60, 60, -0.1})});
    text.add("upper arm", shifted(examples::extruded(bar(160, 30), 28), {0, 0, 201}));
    text.add("forearm", {shifted(examples::extruded(bar(105, 24), 24), {160, 0, 231}),
                         shifted(turned_ring({{10, 0}, {24, 0}, {24, 38}, {10, 38}}, facets), {300, 0, 231.5})});
    text.add("quill", {shifted(rod(8, 238, facets), {300, 0, 104}), shifted(rod(13, 16, facets), {300, 0, 96}),
                       shifted(rod(13, 14, facets), {300, 0, 330})});
    text.add("ring", shifted(turned_ring({{15, 0}, {34, 0}, {34, 70}, {15, 70}}, facets), {150, 190, 0}));
    text.add("posts", {shifted(rod(9, 150, facets), {228, 84, 0}), shifted(rod(9, 150, facets), {152, 72, 0}),
                       shifted(rod(9, 300, facets), {40, 236, 0})});
    text.add("cell floor", box({-100, -160, -8.2}, {300, 270, -8.1}));
}

std::string all_shapes() {
    Text text;
    text.add("bolt", scenes::bolt(fastener));
    text.add("nut", scenes::nut(fastener));
    add_peg(text);
    add_maze(text);
    add_gears(text);
    add_robot(text);
    return text.text();
}

/// Numbers that the scenes need with the bodies: where the key starts, and how the planet meshes.
std::string all_places() {
    const std::vector<scenes::MazeCell> way = scenes::way_out(maze_size);
    const Vector3d start = scenes::middle_of(maze_size, way[1]);
    const Vector3d ahead = start - scenes::middle_of(maze_size, way[0]);
    return fmt::format(R"({{"key":[{},{},{},{}],"planet":[{},{}],"nut":{}}})", start.x(), start.y(), start.z(),
                       std::atan2(ahead.y(), ahead.x()), sun.pitch_radius() + planet.pitch_radius(),
                       scenes::meshing_angle(planet), fastener.pitch);
}

} // namespace
} // namespace chasles::playground

/// The text ends with a zero byte. Its address.
extern "C" __attribute__((export_name("shapes"))) const char* shapes() {
    static const std::string text = "{\"shapes\":" + chasles::playground::all_shapes() +
                                    ",\"places\":" + chasles::playground::all_places() + "}";
    return text.c_str();
}
