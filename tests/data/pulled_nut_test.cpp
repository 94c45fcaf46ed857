// Real nuts are pulled along their bolts by a hand that does not turn them: they come off by their threads.
// CHASLES_LONG=1 in the environment: from farther below, and the tight one, which is slow, until it is off.
#include "chasles/manipulation/dragged_body.h"
#include "chasles/query/first_contact.h"
#include "tests/data/shared_data.h"
#include "tests/support/posed_motions.h"

#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Lengths in metres.
struct PulledNut {
    const char* nut;
    const char* bolt;
    double pitch;
    double start;       ///< height at which the threads are in phase, above the assembled state
    int first_pitch;    ///< pitches above that
    double margin;      ///< far below the play
    double least_turns; ///< that the nut makes on its thread
    int updates;        ///< in a test run; fewer than the nut needs: it does not come off
};

Polyhedron body_of(const char* name) {
    return Polyhedron::load(shared_data(std::string("assembly-factory/factory_") + name + ".obj"));
}

/// How far the nut can go straight up (or down) before it touches its thread.
double straight_way(const Polyhedron& nut, const Polyhedron& bolt, const Pose& from, double length) {
    const Pose to(from.translation + Vector3d(0, 0, length), Quaterniond(from.rotation));
    const FirstContact found =
        first_contact({.moving = nut, .fixed = bolt, .motion = ScrewMotion::between(from.isometry(), to.isometry())});
    EXPECT_EQ(found.verdict, Verdict::contact);
    return std::abs(length) * found.time.upper;
}

double turns_between(const Pose& from, const Pose& to) {
    const Quaterniond turn = Quaterniond(to.rotation) * Quaterniond(from.rotation).conjugate();
    return std::remainder(2 * std::atan2(turn.z(), turn.w()), 2 * std::numbers::pi) / (2 * std::numbers::pi);
}

/// Pulled by a millimetre, on the axis, as it is turned now.
DragStep pull(DraggedBody& hand) {
    const Pose& now = hand.pose();
    return hand.update(Pose(Vector3d(0, 0, now.translation.z() + 1e-3), Quaterniond(now.rotation)));
}

/// Easy to turn, so that the hand need not help.
DragOptions options_for(const Polyhedron& nut, double margin) {
    const Vector3d centre(0, 0, (nut.report().lower.z() + nut.report().upper.z()) / 2);
    DragOptions options;
    options.margin = margin;
    options.mass = MassProperties{centre, 5e-9 * Eigen::Matrix3d::Identity()};
    return options;
}

void expect_to_come_off(const PulledNut& asked) {
    const Polyhedron nut = body_of(asked.nut), bolt = body_of(asked.bolt);
    const bool is_long = times_if_long(2) == 2;
    const int first = asked.first_pitch - (is_long ? 1 : 0), most_updates = is_long ? 400 : asked.updates;
    const Pose start(Vector3d(0, 0, asked.start + first * asked.pitch), Quaterniond::Identity());
    const double up = straight_way(nut, bolt, start, asked.pitch), down = straight_way(nut, bolt, start, -asked.pitch);
    const double top = bolt.report().upper.z() - nut.report().lower.z(); // of the nut, where it is off
    Scene scene;
    scene.add({"bolt", bolt});
    scene.add({"nut", nut, Motion::at_rest(start)});
    DraggedBody hand(scene, "nut", options_for(nut, asked.margin));
    double turns = 0, turns_on_thread = 0, rise_on_thread = 0;
    int updates = 0;
    for (; updates < most_updates && hand.pose().translation.z() < top && !testing::Test::HasFailure(); ++updates) {
        const Pose before = hand.pose();
        const DragStep step = pull(hand);
        EXPECT_TRUE(step.state == DragState::moving || step.state == DragState::reached);
        turns += turns_between(before, step.pose);
        const double rise = step.pose.translation.z() - start.translation.z();
        if (step.pose.translation.z() > top - asked.pitch)
            continue; // the last turn is loose: only a part of the thread holds
        turns_on_thread = turns;
        rise_on_thread = rise;
        // a tilted nut has a little more play
        const double tilt = 0.02 * asked.pitch;
        EXPECT_LE(rise, asked.pitch * turns + up + tilt);
        EXPECT_GE(rise, asked.pitch * turns - down - tilt);
    }
    EXPECT_TRUE(hand.pose().translation.z() >= top || most_updates < 100);
    EXPECT_GT(turns_on_thread, asked.least_turns + (is_long ? 1 : 0));
    print_figures("%s: %d updates; %.3f turns and %.4f mm on the thread, %.4f mm a turn after the play of "
                  "%.4f mm (pitch %.2f)",
                  asked.nut, updates, turns_on_thread, 1e3 * rise_on_thread,
                  1e3 * (rise_on_thread - up) / turns_on_thread, 1e3 * up, 1e3 * asked.pitch);
}

TEST(PulledNut, M16ComesOffByItsThread) {
    CHASLES_REQUIRE_DATA("assembly-factory");
    expect_to_come_off({"nut_m16_loose_subdiv_3x", "bolt_m16_loose", 0.002, 0.97 * 0.002, 10, 2e-6, 0.4, 300});
}

/// The pull would turn the nut by 10,000 margins: the first steps that are tried are much too long.
TEST(PulledNut, M16DoesNotRestWhereNothingHoldsIt) {
    CHASLES_REQUIRE_DATA("assembly-factory");
    const Polyhedron nut = body_of("nut_m16_loose_subdiv_3x"), bolt = body_of("bolt_m16_loose");
    const Pose start({3.4182440703415349e-05, 1.5173933769241124e-05, 0.020927663410618223},
                     {0.28030707901940749, -0.00048028229078717061, -0.00039201972575089792, 0.95991018178841281});
    Scene scene;
    scene.add({"bolt", bolt});
    scene.add({"nut", nut, Motion::at_rest(start)});
    DraggedBody hand(scene, "nut", options_for(nut, 2e-6));
    const DragStep step = pull(hand);
    EXPECT_NE(step.state, DragState::resting);
    EXPECT_GT(turns_between(start, step.pose), 1e-3);
}

TEST(PulledNut, M12RisesByItsThread) {
    CHASLES_REQUIRE_DATA("assembly-factory");
    expect_to_come_off({"nut_m12_tight_subdiv_3x", "bolt_m12_tight", 0.00175, 0.9275 * 0.00175, 9, 1e-6, 0.05, 10});
}

} // namespace
} // namespace chasles::test
