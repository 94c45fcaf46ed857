// A peg finds its hole. The hand does not know where the hole is: it presses the peg on the plate and wanders in a
// widening spiral, until the peg drops in. Then it presses the peg to the ground of the hole. Each step is proven
// clear. With a file name, writes a page that replays it.
#include "examples/dragging/recording.h"
#include "examples/dragging/shapes.h"
#include "examples/dynamics/shapes.h"

#include <chasles/chasles.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>

namespace {

using chasles::Pose;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int sides = 48;
constexpr double radius = 8;     // millimetres
constexpr double play = 0.05;    // of the radius
constexpr double thickness = 12; // of the plate
const Vector3d guess(2.5, -1.5, 0);
constexpr double pressed = 1; // below the peg, the hand

/// Upright and shifted.
Pose upright(const Vector3d& place) {
    return {place, Quaterniond::Identity()};
}

/// Around the guess, a turn every 40 updates, and wider by 0.15 mm with each turn.
Vector3d searched(int update) {
    const double turns = update / 40.0, reach = 0.15 * turns;
    return guess + reach * Vector3d(std::cos(2 * EIGEN_PI * turns), std::sin(2 * EIGEN_PI * turns), 0);
}

} // namespace

int main(int count, char** arguments) {
    const double hole = (radius + play) / std::cos(EIGEN_PI / sides);
    chasles::Scene scene;
    scene.add({"table", chasles::examples::box({-40, -40, -5}, {40, 40, 0})});
    scene.add({"plate", chasles::examples::turned_ring({{hole, 0}, {30, 0}, {30, thickness}, {hole, thickness}}, sides),
               chasles::Motion::at_rest(upright({0, 0, 0.01}))});
    scene.add({"peg", chasles::examples::rod(radius, 40, sides),
               chasles::Motion::at_rest(upright(guess + Vector3d(0, 0, thickness + 5)))});
    chasles::DraggedBody hand(scene, "peg");
    chasles::examples::HandRecording recording(scene, "A peg that finds its hole");

    int update = 0, in_contact = 0;
    std::size_t pieces = 0;
    const auto drag = [&](const Vector3d& place) {
        const chasles::DragStep step = hand.update(upright(place));
        pieces += step.pieces.size();
        in_contact += !step.contacts.empty();
        recording.keep_contacts("peg", step);
        recording.keep();
    };
    const auto height = [&] { return hand.pose().translation.z(); };
    // it does not see the hole, but feels the drop
    for (; update < 2000 && height() > thickness - 0.5; ++update) {
        Vector3d place = searched(update);
        place.z() = std::min(height(), thickness + 0.2) - pressed;
        drag(place);
    }
    const Vector3d found = hand.pose().translation;
    std::printf("after %d updates, %d in contact, the peg drops at (%.2f, %.2f): %.2f mm from where the hand guessed\n",
                update, in_contact, found.x(), found.y(), (found - guess).head<2>().norm());
    int pushes = 0;
    for (; pushes < 200 && height() > 0.1; ++pushes)
        drag({found.x(), found.y(), height() - pressed});
    std::printf("%zu proven pieces: %s\n", pieces,
                height() <= 0.1 ? "the peg stands on the ground of its hole" : "the peg is stuck");
    recording.write(count, arguments);
    return height() <= 0.1 ? 0 : 1;
}
