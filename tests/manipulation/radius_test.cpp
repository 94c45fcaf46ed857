// Round bodies in a hand: gaps are those of round surfaces, and a ball that turns keeps its gap.
#include "chasles/manipulation/contact_model.h"
#include "chasles/mesh/primitives.h"
#include "tests/manipulation/drag_scenes.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

TEST(RoundBodiesInHands, ABallRestsOnATableAndRolls) {
    Scene scene;
    scene.add({"table", box({5, 5, 1}).polyhedron(), Motion::at_rest(shifted(0, 0, -1))});
    scene.add({"ball", make_sphere(0.5), Motion::at_rest(shifted(0, 0, 1))});
    DraggedBody body(scene, "ball", {.margin = 1e-4});
    DragStep step;
    for (int i = 0; i < 20; ++i)
        step = body.update(shifted(0, 0, -1));
    EXPECT_NEAR(step.pose.translation.z(), 0.5001, 2e-5);
    ASSERT_FALSE(step.contacts.empty());
    EXPECT_NEAR(step.contacts[0].contact.gap, 1e-4, 2e-5);
    EXPECT_NEAR(step.contacts[0].contact.point.z(), 0, 1e-9);
    for (int i = 0; i < 20; ++i)
        step = body.update(shifted(2, 0, -1));
    EXPECT_NEAR(step.pose.translation.x(), 2, 1e-3) << "slides along";
    EXPECT_GE(step.pose.translation.z(), 0.5);
}

TEST(RoundBodiesInHands, AGapIsKeptWhenABallTurns) {
    const Polyhedron ball = make_sphere(0.5), table = box({5, 5, 1}).polyhedron();
    const Pose here = shifted(0, 0, 0.75), there = shifted(0, 0, -1);
    Contact contact;
    contact.kind = ContactKind::vertex_face;
    contact.point = {0, 0, 0};
    contact.normal = {0, 0, 1};
    contact.gap = 0.25;
    const manipulation::ModelledContact modelled =
        manipulation::modelled(contact, 0, {ball.body(), table.body(), here, there});
    const Pose turned({0, 0, 0.75}, Eigen::Quaterniond(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitX())));
    EXPECT_NEAR(gap_after(modelled, manipulation::Displacement::between(here, turned)), 0.25, 1e-15);
    EXPECT_NEAR(gap_after(modelled, manipulation::Displacement::between(here, shifted(1, 0, 0.5))), 0, 1e-15);
}

} // namespace
} // namespace chasles::test
