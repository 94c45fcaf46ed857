// Two gears turn each other. A hand turns the first gear; nothing turns the second gear but the teeth of the first one:
// its hand is no hand, but gives way to the force of the contacts. Both gears sit on pins with a little play, and
// nothing else holds them. Each step of both is proven clear. With a file name, writes a page that replays it.
#include "examples/dragging/recording.h"
#include "examples/dragging/shapes.h"
#include "examples/dynamics/shapes.h"
#include "scenes/spur_gear.h"

#include <chasles/chasles.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using chasles::DraggedBody;
using chasles::DragStep;
using chasles::Pose;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double degree = EIGEN_PI / 180;
constexpr int sides = 48;       // of pins
constexpr double pin = 3;       // radius, millimetres
constexpr double bearing = 0.1; // radius of a bore less that of its pin

constexpr chasles::scenes::SpurGear first{.teeth = 18, .play = 0.4, .bore_radius = pin + bearing};
constexpr chasles::scenes::SpurGear second{.teeth = 27, .play = 0.4, .bore_radius = pin + bearing};
constexpr double step_angle = 4 * degree; // of the hand before the first gear
constexpr int updates = 20;

/// On a pin, turned about it, and pressed a little on the ground.
Pose on_pin(const Vector3d& axis, double angle) {
    return {axis - Vector3d(0, 0, 0.02), Quaterniond(AngleAxisd(angle, Vector3d::UnitZ()))};
}

double angle_of(const Pose& pose) {
    const Quaterniond turn(pose.rotation);
    return 2 * std::atan2(turn.z(), turn.w());
}

/// A gear in a scene.
struct Gear {
    DraggedBody body;
    Vector3d axis;
    double turned = 0; ///< radians

    DragStep turn_to(double angle) {
        const Pose before = body.pose();
        DragStep step = body.update(on_pin(axis, angle));
        turned += 2 * EIGEN_PI * chasles::examples::turns_about_z(before, step.pose);
        return step;
    }
};

/// The torque about an axis along z of the contacts of a step on one other body.
double torque_on(const DragStep& step, std::size_t body, const Vector3d& axis) {
    double torque = 0;
    for (const chasles::DragContact& contact : step.contacts)
        if (contact.body == body)
            torque -= contact.force * (contact.contact.point - axis).cross(contact.contact.normal).z();
    return torque;
}

chasles::DragOptions options_for(double radius, double width) {
    chasles::DragOptions options;
    options.margin = 0.01;
    options.mass =
        chasles::MassProperties{Vector3d(0, 0, width / 2), 0.5 * radius * radius * Eigen::Matrix3d::Identity()};
    return options;
}

} // namespace

int main(int count, char** arguments) {
    const Vector3d first_axis(0, 0, 0), second_axis(first.pitch_radius() + second.pitch_radius(), 0, 0);
    const chasles::Polyhedron rod = chasles::examples::rod(pin, 8, sides);
    chasles::Scene scene;
    scene.add({"ground", chasles::examples::box({-15, -20, -3}, {45, 20, 0})});
    scene.add({"first pin", rod});
    scene.add({"second pin", rod, chasles::Motion::at_rest(Pose(second_axis, Quaterniond::Identity()))});
    const auto place = [&](const char* name, const chasles::scenes::SpurGear& size, const Vector3d& axis,
                           double angle) {
        const Pose pose(axis + Vector3d(0, 0, 0.1), Quaterniond(AngleAxisd(angle, Vector3d::UnitZ())));
        scene.add({name, chasles::scenes::spur_gear(size), chasles::Motion::at_rest(pose)});
        return angle;
    };
    place("first gear", first, first_axis, 0);
    place("second gear", second, second_axis, chasles::scenes::meshing_angle(second));
    Gear driving{DraggedBody(scene, "first gear", options_for(first.pitch_radius(), first.width)), first_axis};
    Gear driven{DraggedBody(scene, "second gear", options_for(second.pitch_radius(), second.width)), second_axis};
    chasles::examples::HandRecording recording(scene, "Two gears that turn each other");

    std::size_t pieces = 0;
    double hand = 0;
    for (int i = 0; i < updates; ++i) {
        hand += step_angle;
        // the gears go in turns until the first one is where the hand is
        for (int k = 0; k < 40 && hand - driving.turned > 0.1 * step_angle; ++k) {
            const DragStep push = driving.turn_to(hand);
            const double torque = torque_on(push, scene.index_of("second gear"), second_axis);
            // the second gear gives way as far as a spring of its own inertia would be wound up
            const double inertia = 0.5 * second.pitch_radius() * second.pitch_radius();
            const DragStep give = driven.turn_to(angle_of(driven.body.pose()) + torque / inertia);
            pieces += push.pieces.size() + give.pieces.size();
            recording.keep_contacts("first gear", push);
            recording.keep_contacts("second gear", give);
        }
        recording.keep();
    }
    const double ratio = -driven.turned / driving.turned;
    std::printf("the first gear has turned %.1f degrees, the second gear has turned %.1f degrees: %.3f for 1, and %d "
                "teeth to %d are %.3f\n",
                driving.turned / degree, driven.turned / degree, ratio, int(first.teeth), int(second.teeth),
                double(first.teeth) / double(second.teeth));
    std::printf("%zu proven pieces\n", pieces);
    recording.write(count, arguments);
    return std::abs(ratio - double(first.teeth) / double(second.teeth)) < 0.02 ? 0 : 1;
}
