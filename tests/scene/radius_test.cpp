// Round bodies in scenes: no broad phase knows only their polyhedra.
#include "chasles/mesh/primitives.h"
#include "chasles/scene/nearest_pair.h"
#include "chasles/scene/stepper.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>
#include <map>
#include <numeric>

namespace chasles::test {
namespace {

Polyhedron random_shape(Random& random) {
    const double radius = random.uniform(0.1, 0.8);
    switch (random.integer(0, 3)) {
    case 0:
        return make_sphere(radius);
    case 1:
        return make_capsule(radius, random.uniform(0.1, 1));
    case 2:
        return make_box({0.1, 0.2, 0.3}).with_radius(radius);
    default:
        return make_box({random.uniform(0.1, 0.8), random.uniform(0.1, 0.8), random.uniform(0.1, 0.8)});
    }
}

Scene random_scene(Random& random) {
    Scene scene;
    for (int i = 0; i < 12; ++i) {
        const Pose start = random_pose(random, 2.5);
        const bool rests = random.chance(0.3);
        scene.add({std::to_string(i), random_shape(random),
                   rests ? Motion::at_rest(start) : Motion::velocity(start, random_goal(random, start, 1, 3))});
    }
    return scene;
}

/// The first contact of two bodies of a scene by themselves, at the time of its lower end.
std::optional<double> meeting(const Scene& scene, std::size_t a, std::size_t b) {
    const SceneBody &first = scene.bodies()[a], &second = scene.bodies()[b];
    const FirstContact found = first_contact({first.shape, second.shape, relative(first.motion, second.motion)});
    return found.verdict == Verdict::clear ? std::nullopt : std::optional(found.time.lower);
}

TEST(RoundBodiesInScenes, MeetAsPairsByThemselves) {
    Random random(4411);
    int met = 0;
    for (int round = 0; round < 40; ++round) {
        const Scene scene = random_scene(random);
        std::map<std::pair<std::size_t, std::size_t>, double> found;
        for (const SceneContact& contact : scene.all_contacts({}).contacts)
            found[std::minmax(contact.moving, contact.fixed)] = contact.contact.time.lower;
        double first = 2;
        for (std::size_t a = 0; a < scene.bodies().size(); ++a)
            for (std::size_t b = a + 1; b < scene.bodies().size(); ++b) {
                const auto at = found.find({a, b});
                const auto alone = meeting(scene, a, b);
                const bool both_rest =
                    scene.bodies()[a].motion.pose_at(1).translation ==
                        scene.bodies()[a].motion.pose_at(0).translation &&
                    scene.bodies()[b].motion.pose_at(1).translation == scene.bodies()[b].motion.pose_at(0).translation;
                if (both_rest)
                    continue;
                ASSERT_EQ(at != found.end(), alone.has_value()) << round << ": " << a << ", " << b;
                if (alone) {
                    EXPECT_NEAR(at->second, *alone, 1e-9);
                    first = std::min(first, *alone);
                    ++met;
                }
            }
        const SceneAnswer answer = scene.first_contact({});
        ASSERT_EQ(answer.contacts.empty(), first > 1);
        if (first <= 1) {
            EXPECT_NEAR(answer.contacts[0].contact.time.lower, first, 1e-9);
        }
    }
    EXPECT_GT(met, 100);
}

TEST(RoundBodiesInScenes, AStepperStopsWhereTheyMeet) {
    Scene scene;
    const auto along_x = [](double x) { return Pose({x, 0, 0}, Eigen::Quaterniond::Identity()); };
    scene.add({"left", make_sphere(0.5), Motion::velocity(along_x(-4), along_x(0))});
    scene.add({"right", make_sphere(0.25), Motion::velocity(along_x(4), along_x(0))});
    Stepper stepper(scene, {.margin = 0.25});
    const auto event = stepper.advance();
    ASSERT_TRUE(event);
    EXPECT_NEAR(event->time, 7.0 / 8, 1e-9); // 1 apart
    ASSERT_EQ(event->contacts.size(), 1U);
    const Contact& contact = event->contacts[0].contact.contacts.at(0);
    EXPECT_NEAR(contact.gap, 0.25, 1e-9);
    const bool left_is_fixed = scene.bodies()[event->contacts[0].fixed].name == "left";
    EXPECT_NEAR(contact.point.x(), left_is_fixed ? 0.0 : 0.25, 1e-9);
}

TEST(RoundBodiesInScenes, LeastDistancesAreThoseOfRoundBodies) {
    Random random(4412);
    for (int round = 0; round < 20; ++round) {
        Scene scene;
        std::vector<std::pair<Eigen::Vector3d, double>> balls;
        for (int i = 0; i < 8; ++i) {
            balls.emplace_back(random_point(random, 10), random.uniform(0.01, 0.3));
            const Pose there(balls.back().first, Eigen::Quaterniond::Identity());
            scene.add({std::to_string(i), make_sphere(balls.back().second), Motion::at_rest(there)});
        }
        double least = 1e300;
        for (std::size_t a = 0; a < balls.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                least = std::min(least, (balls[a].first - balls[b].first).norm() - balls[a].second - balls[b].second);
        if (least < 0.01)
            continue;
        std::vector<std::size_t> all(balls.size());
        std::iota(all.begin(), all.end(), std::size_t(0));
        const chasles::SceneDistance found =
            chasles::scene::nearest_pair(scene, {.pairs = {.first = all, .second = all}});
        EXPECT_LE(found.nearest.distance.lower, least * (1 + 1e-12));
        EXPECT_GE(found.nearest.distance.upper, least * (1 - 1e-12));
    }
}

} // namespace
} // namespace chasles::test
