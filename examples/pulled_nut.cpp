// A nut is pulled along its bolt. The hand only pulls and does not turn it; the threads turn the nut, and it comes off.
// Each step is proven clear. With a file name, writes a page that replays it.
#include "scenes/threaded_fastener.h"
#include "view/page.h"
#include "view/scene_record.h"

#include <chasles/chasles.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <fstream>
#include <numbers>

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// M16, of which the nut still has four millimetres of thread. The facets of 36 segments would lock: along them the
/// nut would have to go down before it goes up.
constexpr chasles::scenes::ThreadedFastener fastener{.bolt_length = 14, .nut_height = 5, .segments = 72};
constexpr double start_height = 10; // millimetres
constexpr double pull = 1;          // millimetres between the nut and the hand
constexpr int most_updates = 60;

chasles::view::PoseRow row_of(const chasles::Pose& pose, const chasles::view::PoseRow* last) {
    const Quaterniond turn(pose.rotation);
    const Vector3d& place = pose.translation;
    chasles::view::PoseRow row{place.x(), place.y(), place.z(), turn.w(), turn.x(), turn.y(), turn.z()};
    // the shorter way from the pose before
    if (last && row[3] * (*last)[3] + row[6] * (*last)[6] < 0)
        for (std::size_t i = 3; i < 7; ++i)
            row[i] = -row[i];
    return row;
}

/// The turn about the axis from one pose to the next one, in turns.
double turns_between(const chasles::Pose& from, const chasles::Pose& to) {
    const Quaterniond turn = Quaterniond(to.rotation) * Quaterniond(from.rotation).conjugate();
    return std::remainder(2 * std::atan2(turn.z(), turn.w()), 2 * std::numbers::pi) / (2 * std::numbers::pi);
}

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

    chasles::view::SceneRecord record{.title = "A pulled nut"};
    record.bodies = {{"bolt", bolt, {row_of(chasles::Pose(), nullptr)}}, {"nut", nut, {row_of(start, nullptr)}}};
    record.times = {0};
    double turns = 0, turns_on_thread = 0, rise_on_thread = 0;
    std::size_t pieces = 0;
    for (int i = 1; i <= most_updates && hand.pose().translation.z() < fastener.bolt_length; ++i) {
        const chasles::Pose before = hand.pose();
        // upwards, on the axis, and as it is turned now
        const Vector3d place(0, 0, before.translation.z() + pull);
        const chasles::DragStep step = hand.update(chasles::Pose(place, Quaterniond(before.rotation)));
        turns += turns_between(before, step.pose);
        pieces += step.pieces.size();
        // the last turn is loose, as only a part of the thread holds
        if (step.pose.translation.z() < fastener.bolt_length - fastener.pitch / 2) {
            turns_on_thread = turns;
            rise_on_thread = step.pose.translation.z() - start_height;
        }
        record.times.push_back(i);
        record.bodies[1].poses.push_back(row_of(step.pose, &record.bodies[1].poses.back()));
    }
    std::printf("%zu proven pieces: the nut has turned %.2f times and risen %.2f mm on the thread, %.2f mm a turn\n",
                pieces, turns_on_thread, rise_on_thread, rise_on_thread / turns_on_thread);
    const bool is_off = hand.pose().translation.z() >= fastener.bolt_length;
    std::printf(is_off ? "the nut is off its bolt\n" : "the nut is still on its bolt\n");
    if (count > 1)
        std::ofstream(arguments[1]) << chasles::view::scene_page(record);
    return is_off ? 0 : 1;
}
