// Bodies of a scene that start inside of each other.
#include "chasles/mesh/primitives.h"
#include "chasles/scene/stepper.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

Pose along_x(double x) {
    return {Eigen::Vector3d(x, 0, 0), Eigen::Quaterniond::Identity()};
}

/// A box with a small one inside of it and a small one beside it.
Scene nested_scene() {
    Scene scene;
    const Polyhedron small = make_box({0.1, 0.1, 0.1});
    scene.add({"large", make_box({2, 2, 2}), Motion::at_rest(Pose())});
    scene.add({"in", small, Motion::velocity(along_x(0.5), along_x(0.6))});
    scene.add({"beside", small, Motion::velocity(along_x(3), along_x(2))});
    return scene;
}

TEST(InsideOfScenes, IsTheFirstContact) {
    const Scene scene = nested_scene();
    for (const Find find : {Find::first, Find::any, Find::first_with_all_contacts}) {
        const SceneAnswer found = scene.first_contact({.options = {.find = find}});
        ASSERT_EQ(found.verdict, Verdict::contact_at_start);
        ASSERT_EQ(found.contacts.size(), 1U);
        const FirstContact& contact = found.contacts[0].contact;
        ASSERT_TRUE(contact.inside);
        EXPECT_EQ(scene.bodies()[found.contacts[0].moving].name, "in");
        EXPECT_TRUE(contact.inside->moving_is_inside);
    }
    EXPECT_EQ(scene.all_contacts({}).contacts.size(), 1U);
    EXPECT_EQ(scene.all_contacts({.until = 0}).contacts.size(), 1U);
}

TEST(InsideOfScenes, IsAPairThatTouchesAtTheStart) {
    Scene scene = nested_scene();
    EXPECT_EQ(scene.ignore_touching_at_start().size(), 1U);
    EXPECT_EQ(scene.first_contact({}).verdict, Verdict::clear);
}

TEST(InsideOfScenes, AStepperNamesIt) {
    const std::string message = refusal([] { (void)Stepper(nested_scene(), {.margin = 1e-3}).advance(); });
    EXPECT_NE(message.find("one of them is inside of the other one"), std::string::npos) << message;
}

} // namespace
} // namespace chasles::test
