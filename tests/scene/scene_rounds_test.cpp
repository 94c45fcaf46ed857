// Scenes of many pairs: rounds, and limits by other pairs.
#include "chasles/scene/scene.h"

#include "chasles/motion/timed_poses.h"
#include "tests/query/bodies.h"
#include "tests/scene/pair_contact.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

/// Pairs of bodies that fly towards each other, each pair far from all others: many pairs, so there are several rounds.
std::vector<SceneBody> random_meetings(Random& random, int count, double turn) {
    std::mt19937 shapes_random(unsigned(random.integer(0, 1 << 30)));
    std::vector<SceneBody> bodies;
    for (int i = 0; i < count; ++i) {
        const auto flying = [&](double from, double to) {
            Pose start = random_pose(random, 0.3);
            Pose goal = random_goal(random, start, random.uniform(0, turn), 0);
            start.translation += Vector3d(from, 10 * i, 0);
            goal.translation += Vector3d(to, 10 * i, 0);
            return Motion::velocity(start, goal);
        };
        const double far = random.uniform(3, 4.5);
        for (const char* name : {"left ", "right "}) {
            const double side = name[0] == 'l' ? -far : far;
            bodies.push_back(
                {name + std::to_string(i), random_octahedron(shapes_random).polyhedron(), flying(side, -side / 2), ""});
        }
    }
    return bodies;
}

TEST(Scene, FindsTheFirstOfManyContactsBeforeATime) {
    Random random(1903);
    int touching = 0;
    for (int trial = 0; trial < 40; ++trial) {
        SCOPED_TRACE(trial);
        const int count = random.integer(100, 300);
        const std::vector<SceneBody> bodies = random_meetings(random, count, 2);
        Scene scene;
        std::vector<PairContact> expected;
        SceneQuery query{.until = random.uniform(0.3, 1)};
        for (const SceneBody& body : bodies)
            scene.add(body);
        for (std::size_t i = 0; i < bodies.size(); i += 2) {
            const SceneBody &a = bodies[i], &b = bodies[i + 1];
            FirstContact contact = first_contact({a.shape, b.shape, relative(a.motion, b.motion), query.options});
            if (contact.verdict != Verdict::clear && contact.time.lower <= query.until)
                expected.push_back({a.name, b.name, std::move(contact)});
        }
        std::ranges::sort(expected, {}, [](const PairContact& c) { return c.contact.time.lower; });
        const SceneAnswer first = scene.first_contact(query);
        SceneQuery any = query;
        any.options.find = Find::any;
        const SceneAnswer some = scene.first_contact(any);
        ASSERT_EQ(first.verdict == Verdict::clear, expected.empty());
        ASSERT_EQ(some.verdict == Verdict::clear, expected.empty());
        if (expected.empty())
            continue;
        ++touching;
        expect_same(scene, first.contacts.at(0), expected.front());
        EXPECT_LE(first.clear_until, expected.front().contact.time.lower);
        EXPECT_LE(some.clear_until, expected.front().contact.time.lower) << "no pair touches before";
    }
    EXPECT_GT(touching, 20);
}

/// Plates in a tilted stack: their boxes and balls overlap all along, so their pairs fill the first round. The first
/// two come together; what another pair of bodies is asked then has a limit. All plates move a little, as pairs at rest
/// are not asked.
std::vector<SceneBody> tilted_plates(double time) {
    const Polyhedron plate = box({1, 1, 0.01}).polyhedron();
    const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.8, Vector3d::UnitX()));
    const auto at = [&](double height) { return Pose(Vector3d(100, 0, 0) + tilt * Vector3d(0, 0, height), tilt); };
    std::vector<SceneBody> plates{{"a low", plate, Motion::at_rest(at(0)), ""},
                                  {"a falling", plate, Motion::velocity(at(0.12), at(0.12 - 0.1 / time)), ""}};
    for (int i = 1; i <= 11; ++i) {
        const double height = 0.2 + 0.04 * i;
        plates.push_back({"b " + std::to_string(i), plate, Motion::velocity(at(height), at(height + 1e-3)), ""});
    }
    return plates;
}

TEST(Scene, ALimitByOtherPairsChangesNoBitOfABracket) {
    Random random(1904);
    int limited = 0, simultaneous = 0;
    for (int trial = 0; trial < 500; ++trial) {
        std::vector<SceneBody> bodies = random_meetings(random, 1, 0);
        const auto ask = [&](const SceneBody& a, const SceneBody& b) {
            return first_contact({a.shape, b.shape, relative(a.motion, b.motion), {}});
        };
        const FirstContact alone = ask(bodies[0], bodies[1]);
        if (alone.verdict != Verdict::contact)
            continue;
        const double later = random.chance(0.5) ? 0 : std::pow(10, random.uniform(-13, -0.5));
        const std::vector<SceneBody> plates = tilted_plates(alone.time.lower + later);
        bodies.insert(bodies.end(), plates.begin(), plates.end());
        const FirstContact other = ask(plates[1], plates[0]);
        Scene scene;
        for (const SceneBody& body : bodies)
            scene.add(body);
        const SceneAnswer answer = scene.first_contact();
        const Bracket& first = alone.time.lower < other.time.lower ? alone.time : other.time;
        const bool is_met = alone.time.lower <= first.upper;
        ASSERT_EQ(answer.contacts.size(), std::size_t(is_met) + std::size_t(other.time.lower <= first.upper)) << trial;
        for (const SceneContact& found : answer.contacts) {
            const FirstContact& expected = found.moving < 2 ? alone : other;
            EXPECT_EQ(found.contact.time.lower, expected.time.lower) << trial;
            EXPECT_EQ(found.contact.time.upper, expected.time.upper) << trial;
        }
        limited += is_met ? 1 : 0;
        simultaneous += answer.contacts.size() == 2 ? 1 : 0;
    }
    EXPECT_GT(limited, 200);
    EXPECT_GT(simultaneous, 50);
}

/// The tau of a time is rounded up where a clock runs unevenly.
TEST(Scene, ListsNoContactThatBeginsAfterATime) {
    const Pose start = shifted(5, 0.2, 0.3);
    const Pose goal = turned({0, 0.2, 0.3}, {0, 0, 1}, 1.5);
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    for (const Motion& motion :
         {Motion::velocity(start, goal), Motion::twist(start, goal),
          Motion::hinge({0, -4, 0}, {0, 0, 1}, {1.2, 0.3, -1.5}),
          Motion(TimedPoses::through({0, 0.3, 1}, {start, turned({4, 0, 0}, {0, 0, 1}, 1), goal})),
          Motion::slider({1, 0.01, 0}, {-4, 3, 1}), Motion::velocity(start, shifted(0, 0.2, 0.3))}) {
        Scene scene;
        scene.add({"floor", cube, Motion::at_rest(Pose()), ""});
        scene.add({"body", cube, motion, ""});
        const SceneAnswer whole = scene.first_contact();
        ASSERT_EQ(whole.verdict, Verdict::contact);
        const Bracket time = whole.contacts.front().contact.time;
        for (int i = 0; i <= 400; ++i) {
            const double until = i < 200 ? i / 200.0 : time.lower - (i - 300) * 1e-4;
            if (until >= 0 && until <= 1 && std::abs(until - time.lower) > 1e-11) {
                const SceneAnswer all = scene.all_contacts({.until = until});
                EXPECT_EQ(all.contacts.empty(), until < time.lower) << until;
                EXPECT_EQ(all.verdict == Verdict::clear, until < time.lower) << until;
                EXPECT_EQ(all.clear_until, std::min(until, all.contacts.empty() ? 1 : time.lower)) << until;
            }
        }
    }
}

/// A question of yes or no may come upon a later contact first.
TEST(Scene, AnyContactBeforeATimeIsFoundAmongLaterOnes) {
    Random random(1905);
    int touching = 0, clear = 0;
    for (int trial = 0; trial < 300; ++trial) {
        std::mt19937 shapes_random(unsigned(random.integer(0, 1 << 30)));
        Scene scene;
        Body pillars;
        for (int i = 0; i < 25; ++i)
            add_box(pillars, {random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-1, 1)}, {0.1, 0.1, 0.1});
        scene.add({"pillars", pillars.polyhedron(), Motion::at_rest(Pose()), ""});
        const Pose start = random_pose(random, 3);
        scene.add({"body", random_octahedron(shapes_random).polyhedron(),
                   Motion::velocity(start, random_goal(random, start, random.uniform(0.5, 3), 9)), ""});
        const SceneAnswer whole = scene.first_contact();
        for (int i = 0; i < 8; ++i) {
            SceneQuery query{.until = random.uniform(0, 1)};
            query.options.find = Find::any;
            const bool is_contact =
                whole.verdict != Verdict::clear && whole.contacts[0].contact.time.lower <= query.until;
            EXPECT_EQ(scene.first_contact(query).verdict == Verdict::clear, !is_contact) << trial << ' ' << query.until;
            ++(is_contact ? touching : clear);
        }
    }
    EXPECT_GT(touching, 100);
    EXPECT_GT(clear, 100);
}

/// The wide bracket of a contact may begin before the time, and the contact after it. Found by an outsider's attack.
TEST(Scene, AnyContactIsNoneThatANarrowerBracketHasAfterTheTime) {
    Body steps;
    const double height = 1.163406406505169, lower = 0.9724136853723051;
    for (const double x : {0.0, 0.5, 1.0, 1.5}) {
        const double z = x < 1 ? height : lower;
        steps.vertices.insert(steps.vertices.end(), {{x, 0, 0}, {x, 0.5, 0}, {x, 0.5, z}, {x, 0, z}});
    }
    for (const std::uint32_t k : {0U, 8U})
        for (const auto& face : Faces{{3, 2, 0},
                                      {2, 1, 0},
                                      {4, 5, 7},
                                      {5, 6, 7},
                                      {4, 7, 0},
                                      {7, 3, 0},
                                      {1, 2, 5},
                                      {2, 6, 5},
                                      {1, 5, 0},
                                      {5, 4, 0},
                                      {3, 7, 2},
                                      {7, 6, 2}})
            steps.faces.push_back({face[0] + k, face[1] + k, face[2] + k});
    Body octahedron{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, {}};
    octahedron.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    const Pose start({-0.20862997699820518, -0.6929675894806744, 3.5}, Eigen::Quaterniond::Identity());
    const Pose goal({-0.48683896026057605, 0.6925002564506451, -3.5},
                    {-0.43212902179738616, -1.1107303753669326, -0.09946130686293066, -0.46541921746150605});
    Scene scene;
    scene.add({"octahedron", octahedron.polyhedron(), Motion::at_rest(Pose()), ""});
    scene.add({"steps", steps.polyhedron(), Motion::velocity(start, goal), ""});
    SceneQuery query{.options = {.margin = 0.1}};
    const double time = scene.first_contact(query).contacts.at(0).contact.time.upper;
    query.options.find = Find::any;
    EXPECT_GT(scene.first_contact(query).contacts.at(0).contact.time.lower, time) << "a later one is found first";
    for (double later = 1e-9; later < 1e-2; later *= 3) {
        query.until = time + later;
        EXPECT_EQ(scene.first_contact(query).verdict, Verdict::contact) << later;
    }
}

} // namespace
} // namespace chasles::test
