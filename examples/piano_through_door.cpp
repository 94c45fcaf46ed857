// A piano is moved through a door that it fits through only lengthwise, into a corridor, where it has to be turned. The
// mover points roughly where it should go: into door posts and walls, tilted, and a little into the floor. The piano
// slides along what it touches. Each step is proven clear. With a file name, writes a page that replays it.
#include "examples/dragging/recording.h"
#include "examples/dragging/shapes.h"
#include "examples/dynamics/shapes.h"

#include <chasles/chasles.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>

namespace {

using chasles::Pose;
using chasles::examples::box;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double degree = EIGEN_PI / 180;

/// Metres. The wall with the door is at y = 0, the corridor behind it.
constexpr double door = 0.82, door_height = 2, wall = 0.12, corridor = 1.45;
constexpr double patience = 0.3; // of the mover: how far ahead of the piano
constexpr int most_updates = 1000;
/// An upright piano: 1.5 long, 0.66 deep with its keyboard, 1.2 high.
constexpr double length = 1.5, depth = 0.66, height = 1.2;

/// Its length along x, its keyboard towards -y; the origin is in the middle of its ground.
chasles::Polyhedron piano() {
    // the profile from the side, along which it is extruded
    const std::vector<Eigen::Vector2d> profile{{-0.03, 0},   {0.33, 0},     {0.33, height}, {0, height},
                                               {-0.03, 0.8}, {-0.33, 0.74}, {-0.33, 0.6},   {-0.03, 0.55}};
    const chasles::Polyhedron along_z = chasles::examples::extruded(profile, length);
    std::vector<Vector3d> vertices;
    for (const Vector3d& v : along_z.vertices())
        vertices.emplace_back(v.z() - length / 2, v.x(), v.y()); // turned in space: x, y, z to y, z, x
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t f = 0; f < along_z.face_count(); ++f)
        faces.emplace_back(along_z.face(f).begin(), along_z.face(f).end());
    return chasles::Polyhedron::from_polygons(vertices, faces);
}

void add_house(chasles::Scene& scene) {
    scene.add({"floor", box({-3, -3, -0.2}, {4, 2, 0})});
    scene.add({"left of the door", box({-3, 0, 0}, {-door / 2, wall, 2.5})});
    scene.add({"right of the door", box({door / 2, 0, 0}, {4, wall, 2.5})});
    scene.add({"lintel", box({-door / 2, 0, door_height}, {door / 2, wall, 2.5})});
    scene.add({"end of the corridor", box({-3, wall + corridor, 0}, {4, wall + corridor + 0.2, 2.5})});
}

/// Where the mover wants the piano: place of its middle, and direction of its length.
struct Waypoint {
    double x, y, degrees;
    int updates; ///< to go there from the one before
};

constexpr Waypoint way[] = {
    {0.35, -1.8, 70, 1},  // beside the door and askew
    {0.1, -0.95, 88, 40}, // before the door, not quite in its middle
    {-0.08, 0.8, 93, 80}, // through it, along its post
    {0.5, 0.85, 40, 80},  // turn
    {1.2, 0.95, 5, 60},   // along the corridor
    {2.4, 1.15, -15, 60}, // and into its end wall
};

/// The hand's pose between two waypoints; it tilts and shakes, and presses the piano to the floor.
Pose hand_at(const Waypoint& from, const Waypoint& to, double share, int update) {
    const auto between = [&](double a, double b) { return a + share * (b - a); };
    const Vector3d place(between(from.x, to.x) + 0.03 * std::sin(0.7 * update), between(from.y, to.y),
                         -0.01 + 0.01 * std::sin(0.9 * update));
    const AngleAxisd turn(between(from.degrees, to.degrees) * degree, Vector3d::UnitZ());
    const AngleAxisd tilt(3 * degree * std::sin(0.4 * update), Vector3d::UnitX());
    return {place, Quaterniond(turn * tilt)};
}

} // namespace

int main(int count, char** arguments) {
    chasles::Scene scene;
    add_house(scene);
    const Pose start(Vector3d(way[0].x, way[0].y, 0.05),
                     Quaterniond(AngleAxisd(way[0].degrees * degree, Vector3d::UnitZ())));
    scene.add({"piano", piano(), chasles::Motion::at_rest(start)});
    // held with both hands: hard to turn
    chasles::DragOptions options;
    options.mass = chasles::MassProperties{Vector3d(0, 0, height / 2), Eigen::Matrix3d::Identity()};
    chasles::DraggedBody hand(scene, "piano", options);
    chasles::examples::HandRecording recording(scene, "A piano through a door");

    int updates = 0, in_contact = 0;
    std::size_t pieces = 0;
    for (std::size_t i = 1; i < std::size(way); ++i)
        for (int k = 1; k <= way[i].updates && updates < most_updates; ++updates) {
            const chasles::DragStep step =
                hand.update(hand_at(way[i - 1], way[i], double(k) / way[i].updates, updates));
            in_contact += !step.contacts.empty();
            pieces += step.pieces.size();
            recording.keep_contacts("piano", step);
            recording.keep();
            // the mover waits for the piano
            k += step.distance < patience ? 1 : 0;
        }
    const Vector3d place = hand.pose().translation;
    const bool is_through = place.x() > 1.8 && place.y() > wall + depth / 2;
    std::printf("%d updates, %d in contact, %zu proven pieces; the piano ends at (%.2f, %.2f, %.2f)\n", updates,
                in_contact, pieces, place.x(), place.y(), place.z());
    std::printf(is_through ? "the piano is in the corridor\n" : "the piano is stuck\n");
    recording.write(count, arguments);
    return is_through ? 0 : 1;
}
