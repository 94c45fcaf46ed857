// Scenes and steps that end at a limit: what they have proven until then is true, and steps go on.
#include "chasles/base/limit.h"

#include "chasles/scene/stepper.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <chrono>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Clock = std::chrono::steady_clock;

/// Octahedra that start apart and fly through each other.
Scene crowd(Random& random, int bodies) {
    std::mt19937 shapes_random(7);
    const Polyhedron shape = random_octahedron(shapes_random).polyhedron();
    Scene scene;
    for (int i = 0; i < bodies; ++i) {
        const Pose start({4. * (i % 8), 4. * (i / 8 % 8), 4. * (i / 64)}, random_pose(random, 1).rotation);
        scene.add({"body " + std::to_string(i), shape, Motion::velocity(start, random_goal(random, start, 1, 3))});
    }
    return scene;
}

double seconds_of(const auto& work) {
    const auto start = Clock::now();
    work();
    return std::chrono::duration<double>(Clock::now() - start).count();
}

TEST(SceneLimit, WhatIsProvenUntilThenIsTrue) {
    Random random(61);
    int unknown = 0, later_than_start = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Scene scene = crowd(random, 400);
        SceneAnswer whole;
        const double seconds = seconds_of([&] { whole = scene.all_contacts(); });
        ASSERT_EQ(whole.verdict == Verdict::clear, whole.contacts.empty());
        for (const bool all : {false, true}) {
            const Limit limit(random.uniform(0.01, 0.9) * seconds);
            const SceneAnswer found = all ? scene.all_contacts() : scene.first_contact();
            if (found.verdict != Verdict::unknown)
                continue;
            ++unknown;
            later_than_start += found.clear_until > 0;
            EXPECT_TRUE(found.contacts.empty());
            EXPECT_LE(found.clear_until, whole.clear_until);
        }
    }
    EXPECT_GT(unknown, 10);
    EXPECT_GT(later_than_start, 5);
}

TEST(SceneLimit, NobodyTakesUnknownForClear) {
    Random random(62);
    const Scene scene = crowd(random, 400);
    Scene pile;
    for (const SceneBody& body : scene.bodies())
        pile.add({body.name, body.shape, Motion::at_rest(random_pose(random, 3))});
    const Limit limit(1e-9);
    EXPECT_EQ(scene.first_contact().verdict, Verdict::unknown);
    for (const double time : scene.clear_until())
        EXPECT_LT(time, 1);
    EXPECT_THROW((void)pile.ignore_touching_at_start(), Cancelled);
}

TEST(SceneLimit, AStepGoesOnAfterIt) {
    Random random(63);
    const Scene scene = crowd(random, 300);
    Stepper whole(scene, {.margin = 1e-3}), interrupted(scene, {.margin = 1e-3});
    int cancelled = 0;
    for (int i = 0; i < 20; ++i) {
        const std::optional<StepEvent> expected = whole.advance();
        std::optional<StepEvent> found;
        for (double seconds = 1e-6;; seconds *= 2) {
            try {
                const Limit limit(seconds);
                found = interrupted.advance();
                break;
            } catch (const Cancelled&) {
                ++cancelled;
            }
        }
        ASSERT_EQ(found.has_value(), expected.has_value());
        if (!found)
            break;
        EXPECT_EQ(found->time, expected->time);
        ASSERT_EQ(found->contacts.size(), expected->contacts.size());
        for (std::size_t k = 0; k < found->contacts.size(); ++k)
            EXPECT_EQ(found->contacts[k].moving, expected->contacts[k].moving);
    }
    EXPECT_GT(cancelled, 0);
}

} // namespace
} // namespace chasles::test
