// A nut is pulled along its bolt. The hand only pulls and does not turn it; the threads turn the nut, and it comes off.
// Each step is proven clear. With a file name, writes a page that replays it.
#include "examples/dragging/recording.h"
#include "scenes/threaded_fastener.h"

#include <chasles/chasles.h>

#include <Eigen/Geometry>
#include <cstdio>

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// M16, of which the nut still has four millimetres of thread. The facets of 36 segments would lock: along them the
/// nut would have to go down before it goes up.
constexpr chasles::scenes::ThreadedFastener fastener{.bolt_length = 14, .nut_height = 5, .segments = 72};
constexpr double start_height = 10; // millimetres
constexpr double pull = 1;          // millimetres between the nut and the hand
constexpr int most_updates = 60;

} // namespace

int main(int count, char** arguments) {
    const chasles::Polyhedron bolt = chasles::scenes::bolt(fastener), nut = chasles::scenes::nut(fastener);
    chasles::Scene scene;
    const chasles::Pose start(Vector3d(0, 0, start_height), Quaterniond::Identity());
    scene.add({"bolt", bolt});
    scene.add({"nut", nut, chasles::Motion::at_rest(start)});
    // easy to turn, so that the hand need not help
    chasles::DragOptions options;
    options.margin = 2e-3;
    options.mass = chasles::MassProperties{Vector3d(0, 0, fastener.nut_height / 2), 0.05 * Eigen::Matrix3d::Identity()};
    chasles::DraggedBody hand(scene, "nut", options);

    chasles::examples::HandRecording recording(scene, "A pulled nut");
    double turns = 0, turns_on_thread = 0, rise_on_thread = 0;
    std::size_t pieces = 0;
    for (int i = 0; i < most_updates && hand.pose().translation.z() < fastener.bolt_length; ++i) {
        const chasles::Pose before = hand.pose();
        // upwards, on the axis, and as it is turned now
        const Vector3d place(0, 0, before.translation.z() + pull);
        const chasles::DragStep step = hand.update(chasles::Pose(place, Quaterniond(before.rotation)));
        turns += chasles::examples::turns_about_z(before, step.pose);
        pieces += step.pieces.size();
        // the last turn is loose, as only a part of the thread holds
        if (step.pose.translation.z() < fastener.bolt_length - fastener.pitch / 2) {
            turns_on_thread = turns;
            rise_on_thread = step.pose.translation.z() - start_height;
        }
        recording.keep_contacts("nut", step);
        recording.keep();
    }
    std::printf("%zu proven pieces: the nut has turned %.2f times and risen %.2f mm on the thread, %.2f mm a turn\n",
                pieces, turns_on_thread, rise_on_thread, rise_on_thread / turns_on_thread);
    const bool is_off = hand.pose().translation.z() >= fastener.bolt_length;
    std::printf(is_off ? "the nut is off its bolt\n" : "the nut is still on its bolt\n");
    recording.write(count, arguments);
    return is_off ? 0 : 1;
}
