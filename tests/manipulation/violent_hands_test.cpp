// Hands that jump by ten body sizes and spin: the body never touches anything, and no step leads through anything.
#include "scenes/threaded_fastener.h"
#include "tests/manipulation/drag_scenes.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

/// What the updates of one scene came to.
struct Tally {
    int updates = 0;
    int in_contact = 0;
    int sliding = 0; ///< in contact before and after, and has moved
    int reached = 0;
    int touching = 0;
};

/// Goals of a hand: near the body, pressed into what is near, or far away, with turns of any size.
Pose next_goal(Random& random, const Pose& pose, double size) {
    const double reach = random.chance(0.1) ? 10 * size : random.chance(0.5) ? size : 0.1 * size;
    const double turn = random.chance(0.2) ? std::numbers::pi : random.chance(0.5) ? 0.3 : 0;
    return random_goal(random, pose, random.uniform(-turn, turn), reach);
}

/// Each piece goes from where the body was, keeps clear up to its end by a query of its own, and the next one goes on.
void check_pieces(const Scene& scene, const std::string& name, const Pose& before, const DragStep& step) {
    Pose pose = before;
    const Polyhedron& shape = scene.bodies()[scene.index_of(name)].shape;
    for (const DragPiece& piece : step.pieces) {
        EXPECT_EQ(piece.motion.pose_at(0).translation, pose.translation);
        for (const SceneBody& other : scene.bodies()) {
            if (other.name == name)
                continue;
            const Pose there = other.motion.pose_at(1);
            const Motion seen = ScrewMotion::relative(piece.motion.pose_at(0), piece.motion.pose_at(1), there, there);
            const FirstContact found = first_contact({.moving = shape, .fixed = other.shape, .motion = seen});
            EXPECT_NE(found.verdict, Verdict::contact_at_start);
            EXPECT_TRUE(found.verdict == Verdict::clear || found.time.lower > piece.until) << piece.until;
        }
        EXPECT_GT(piece.clearance, 0);
        pose = piece.motion.pose_at(piece.until);
    }
    EXPECT_LE((pose.isometry().matrix() - step.pose.isometry().matrix()).norm(), 1e-12);
}

/// Of the spring, for a body whose moments of inertia are all `moment`.
double energy(const Pose& pose, const Pose& goal, const Vector3d& centre, double moment) {
    const double angle =
        Eigen::Quaterniond(pose.rotation).normalized().angularDistance(Eigen::Quaterniond(goal.rotation).normalized());
    return ((goal.isometry() * centre - pose.isometry() * centre).squaredNorm() + moment * angle * angle) / 2;
}

/// A hand that pulls the body to and fro near `home`.
Tally drag(Scene& scene, const std::string& name, const Pose& home, std::uint64_t seed, int count) {
    Random random(seed);
    const MeshReport box = scene.bodies()[scene.index_of(name)].shape.report();
    const double size = (box.upper - box.lower).norm(), moment = 0.1 * size * size;
    const Vector3d centre = (box.lower + box.upper) / 2;
    DragOptions options;
    options.mass = MassProperties{centre, moment * Eigen::Matrix3d::Identity()};
    DraggedBody body(scene, name, options);
    Tally tally;
    Pose goal = home;
    bool was_in_contact = false;
    for (int i = 0; i < count; ++i) {
        // a goal is kept for some updates; now and then the hand returns to where there is something to touch
        if (i % 3 == 0)
            goal = random.chance(0.4) ? random_goal(random, home, random.uniform(-1, 1), 0.3 * size)
                                      : next_goal(random, body.pose(), size);
        const Pose before = body.pose();
        const DragStep step = body.update(goal);
        check_pieces(scene, name, before, step);
        EXPECT_GT(distance_from_others(scene, name, step.pose), 0) << i;
        // the way out of contacts nearer than the margin may cost what the spring does along some margins
        const double stretched = energy(before, goal, centre, moment);
        EXPECT_LE(energy(step.pose, goal, centre, moment), stretched + 8 * body.margin() * std::sqrt(2 * stretched))
            << i;
        const bool is_in_contact = !step.contacts.empty();
        ++tally.updates;
        tally.in_contact += is_in_contact;
        tally.sliding += is_in_contact && was_in_contact && !step.pieces.empty();
        tally.reached += step.state == DragState::reached;
        tally.touching += step.state == DragState::touching;
        was_in_contact = is_in_contact;
    }
    EXPECT_EQ(tally.touching, 0);
    std::cout << tally.updates << " updates, " << tally.in_contact << " in contact, " << tally.sliding << " sliding, "
              << tally.reached << " reached" << std::endl;
    return tally;
}

void expect_rates(const Tally& tally, double in_contact, double sliding) {
    EXPECT_GT(tally.in_contact, in_contact * tally.updates);
    EXPECT_GT(tally.sliding, sliding * tally.updates);
    EXPECT_GT(tally.reached, 0.05 * tally.updates);
}

int updates(int few) {
    return std::getenv("CHASLES_LONG") ? 100 * few : few; // NOLINT(concurrency-mt-unsafe)
}

TEST(ViolentHands, ABoxOverATable) {
    Scene scene;
    scene.add({"table", box({5, 5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -0.5))});
    scene.add({"post", box({0.2, 0.2, 1}).polyhedron(), Motion::at_rest(turned({1, 1, 1.1}, {1, 1, 1}, 0.2))});
    scene.add({"box", box({0.5, 0.4, 0.3}).polyhedron(), Motion::at_rest(shifted(0, 0, 1))});
    expect_rates(drag(scene, "box", shifted(0.5, 0.5, 0.2), 1, updates(300)), 0.4, 0.1);
}

TEST(ViolentHands, APegInAHole) {
    Scene scene;
    scene.add({"plate", plate_with_hole(16, 1.02, 3, 1).polyhedron()});
    scene.add({"peg", prism(16, 1, 3).polyhedron(), Motion::at_rest(shifted(0, 0, -1))});
    expect_rates(drag(scene, "peg", shifted(0, 0, -1), 2, updates(100)), 0.4, 0.1);
}

TEST(ViolentHands, LinkedRings) {
    Scene scene;
    scene.add({"fixed", torus(1, 0.25, 16, 8).polyhedron()});
    scene.add({"ring", torus(1, 0.25, 16, 8).polyhedron(), Motion::at_rest(turned({1, 0, 0}, {1, 0, 0}, 1.5))});
    const Tally tally = drag(scene, "ring", turned({1, 0, 0}, {1, 0, 0}, 1.5), 3, updates(60));
    EXPECT_GT(tally.in_contact, 0.4 * tally.updates);
    // the rings stay linked, so their middles stay near each other
    EXPECT_LT(scene.bodies()[1].motion.pose_at(1).translation.norm(), 2);
}

TEST(ViolentHands, ANutOnItsBolt) {
    const scenes::ThreadedFastener fastener{
        .bolt_length = 12, .nut_height = 5, .radial_clearance = 0.3, .segments = 18};
    Scene scene;
    scene.add({"bolt", scenes::bolt(fastener)});
    scene.add({"nut", scenes::nut(fastener), Motion::at_rest(shifted(0, 0, 4))});
    const Tally tally = drag(scene, "nut", shifted(0, 0, 4), 5, updates(15));
    EXPECT_GT(tally.in_contact, 0.4 * tally.updates);
    EXPECT_GT(tally.sliding, 0.1 * tally.updates);
}

TEST(ViolentHands, ABoxInACorner) {
    Scene scene;
    scene.add({"corner", corner(4).polyhedron()});
    scene.add({"box", box({0.5, 0.4, 0.3}).polyhedron(), Motion::at_rest(shifted(2, 2, 2))});
    expect_rates(drag(scene, "box", shifted(0.4, 0.4, 0.4), 4, updates(300)), 0.4, 0.1);
}

} // namespace
} // namespace chasles::test
