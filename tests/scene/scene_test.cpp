// Scenes against brute force over all pairs, and their bookkeeping.
#include "chasles/scene/scene.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/timed_poses.h"
#include "chasles/scene/nearest_pair.h"
#include "tests/query/bodies.h"
#include "tests/scene/pair_contact.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

const std::array groups{"", "left", "right"};

/// A motion through a world of this size. Some stand still, some do not turn.
Motion random_motion(Random& random, double size) {
    const Pose start = random_pose(random, size);
    const Pose goal = random_goal(random, start, random.chance(0.2) ? 0 : random.uniform(0, 2), random.uniform(0, 2));
    switch (random.integer(0, 6)) {
    case 0:
        return Motion::at_rest(start);
    case 1:
        return Motion::twist(start, goal);
    case 2:
        return Motion::at_rest(start) * Motion::hinge(Vector3d::Zero(), random_point(random, 1), {0, 2, -1});
    case 3:
        return TimedPoses::through({0, 0.4, 1}, {start, goal, random_goal(random, goal, 1, 1)});
    default:
        return Motion::velocity(start, goal, random_point(random, 0.5));
    }
}

std::vector<SceneBody> random_bodies(Random& random, int count) {
    std::mt19937 shapes_random(unsigned(random.integer(0, 1 << 30)));
    std::vector<Polyhedron> shapes;
    for (int i = 0; i < 3; ++i)
        shapes.push_back(random_octahedron(shapes_random).polyhedron());
    const double size = random.uniform(1, 3) * std::cbrt(count);
    std::vector<SceneBody> bodies;
    for (int i = 0; i < count; ++i)
        bodies.push_back({"body " + std::to_string((i * 7919) % count), shapes[std::size_t(random.integer(0, 2))],
                          random_motion(random, size), groups[std::size_t(random.integer(0, 2))]});
    return bodies;
}

Scene scene_of(const std::vector<SceneBody>& bodies) {
    Scene scene;
    for (const SceneBody& body : bodies)
        scene.add(body);
    scene.ignore_groups("left", "right");
    scene.ignore_groups("right", "right");
    return scene;
}

bool rests(const Motion& motion) {
    return motion.pose_at(0).isometry().matrix() == motion.pose_at(0.3).isometry().matrix() &&
           motion.pose_at(0).isometry().matrix() == motion.pose_at(1).isometry().matrix();
}

/// Every pair by itself, through the public interface for two bodies.
std::vector<PairContact> contacts_of_all_pairs(const std::vector<SceneBody>& bodies, const QueryOptions& options) {
    std::vector<PairContact> contacts;
    for (const SceneBody& a : bodies)
        for (const SceneBody& b : bodies) {
            const bool a_moves = rests(a.motion) != rests(b.motion) ? rests(b.motion) : a.name < b.name;
            const bool ignored = (a.group == "left" && b.group == "right") || (a.group == "right" && !b.group.empty());
            if (a.name == b.name || !a_moves || ignored || (rests(a.motion) && rests(b.motion)))
                continue;
            FirstContact contact = first_contact({a.shape, b.shape, relative(a.motion, b.motion), options});
            if (contact.verdict != Verdict::clear)
                contacts.push_back({a.name, b.name, std::move(contact)});
        }
    std::ranges::sort(contacts, {}, [](const PairContact& c) {
        return std::tuple(c.contact.time.lower, c.contact.time.upper, c.moving, c.fixed);
    });
    return contacts;
}

TEST(Scene, AnswersAsAllPairsByThemselves) {
    Random random(1901);
    std::size_t touching = 0, at_start = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const int count = int(2 * std::pow(100, std::pow(random.uniform(0, 1), 2)));
        const std::vector<SceneBody> bodies = random_bodies(random, count);
        const Scene scene = scene_of(bodies);
        QueryOptions options;
        options.margin = random.chance(0.3) ? random.uniform(0, 0.1) : 0;
        if (options.margin > 0 && random.chance(0.5))
            options.hold = options.margin * random.uniform(0, 0.9);
        const std::vector<PairContact> expected = contacts_of_all_pairs(bodies, options);
        const SceneAnswer first = scene.first_contact({.options = options});
        const SceneAnswer all = scene.all_contacts({.options = options});
        SceneQuery any{.options = options};
        any.options.find = Find::any;
        EXPECT_EQ(scene.first_contact(any).verdict == Verdict::clear, expected.empty());
        ASSERT_EQ(all.contacts.size(), expected.size()) << "trial " << trial;
        for (std::size_t i = 0; i < expected.size(); ++i)
            expect_same(scene, all.contacts[i], expected[i]);
        for (const PairContact& contact : expected)
            EXPECT_LE(first.clear_until, contact.contact.clear_until);
        if (expected.empty()) {
            EXPECT_EQ(first.verdict, Verdict::clear);
            EXPECT_TRUE(first.contacts.empty());
            continue;
        }
        EXPECT_EQ(first.verdict, expected.front().contact.verdict);
        std::size_t simultaneous = 0;
        while (simultaneous < expected.size() &&
               expected[simultaneous].contact.time.lower <= expected.front().contact.time.upper)
            ++simultaneous;
        ++touching;
        if (first.verdict == Verdict::contact_at_start) { // some of them
            ++at_start;
            EXPECT_LE(first.contacts.size(), simultaneous);
            EXPECT_EQ(first.contacts.at(0).contact.time.upper, expected.front().contact.time.upper);
            continue;
        }
        ASSERT_EQ(first.contacts.size(), simultaneous) << "trial " << trial;
        for (std::size_t i = 0; i < simultaneous; ++i)
            expect_same(scene, first.contacts[i], expected[i]);
    }
    std::cout << touching << " scenes touch, " << at_start << " of them at the start\n";
    EXPECT_GT(touching, 300U);
    EXPECT_GT(touching - at_start, 80U);
}

TEST(Scene, AnswersTheSameForAnyOrderAndAnyNumberOfThreads) {
    Random random(1902);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<SceneBody> bodies = random_bodies(random, 150);
        const Scene scene = scene_of(bodies);
        const SceneAnswer one = scene.all_contacts({.threads = 1});
        std::ranges::reverse(bodies);
        const Scene reversed = scene_of(bodies);
        SceneQuery any{.threads = 3};
        any.options.find = Find::any;
        const SceneAnswer many = reversed.all_contacts({.threads = 3});
        ASSERT_EQ(one.contacts.size(), many.contacts.size());
        const auto name = [](const Scene& of, std::size_t index) { return of.bodies()[index].name; };
        for (std::size_t i = 0; i < one.contacts.size(); ++i) {
            EXPECT_EQ(name(scene, one.contacts[i].moving), name(reversed, many.contacts[i].moving));
            EXPECT_EQ(name(scene, one.contacts[i].fixed), name(reversed, many.contacts[i].fixed));
            EXPECT_EQ(one.contacts[i].contact.time.lower, many.contacts[i].contact.time.lower);
            EXPECT_EQ(one.contacts[i].contact.time.upper, many.contacts[i].contact.time.upper);
        }
        const SceneAnswer some = scene.first_contact(any);
        any.threads = 1;
        const SceneAnswer same = reversed.first_contact(any);
        ASSERT_EQ(some.contacts.size(), same.contacts.size());
        if (!some.contacts.empty()) {
            EXPECT_EQ(name(scene, some.contacts[0].moving), name(reversed, same.contacts[0].moving));
        }
    }
}

/// Two boxes of half side 1 fly towards each other; a third one follows.
Scene three_boxes() {
    Scene scene;
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    scene.add({"first", cube, Motion::velocity(shifted(-4, 0, 0), shifted(0, 0, 0))});
    scene.add({"second", cube, Motion::velocity(shifted(4, 0, 0), shifted(0, 0, 0))});
    scene.add({"third", cube, Motion::velocity(shifted(9.5, 0, 0), shifted(1.5, 0, 0))});
    return scene;
}

TEST(Scene, FindsTheEarliestContact) {
    const Scene scene = three_boxes();
    SceneQuery query;
    query.options.find = Find::first_with_all_contacts;
    const SceneAnswer found = scene.first_contact(query);
    ASSERT_EQ(found.contacts.size(), 1U);
    const SceneContact& contact = found.contacts[0];
    EXPECT_EQ(scene.bodies()[contact.moving].name, "first");
    EXPECT_EQ(scene.bodies()[contact.fixed].name, "second");
    EXPECT_NEAR(contact.contact.time.lower, 0.75, 1e-12) << "8 apart, of which 2 are the boxes, at a speed of 8";
    EXPECT_TRUE(contact.contact.certain);
    EXPECT_EQ(contact.contact.contacts.size(), 4U) << "the corners of the faces that meet";

    const SceneAnswer all = scene.all_contacts();
    ASSERT_EQ(all.contacts.size(), 3U);
    EXPECT_NEAR(all.contacts[1].contact.time.lower, 0.875, 1e-12) << "the third catches up: 3.5 apart, 4 faster";
    const std::vector<double> clear = scene.clear_until();
    EXPECT_NEAR(clear[0], 0.75, 1e-12);
    EXPECT_NEAR(clear[2], 0.875, 1e-12);
}

/// A box falls from 2 above the floor by 2, beside another one.
TEST(Scene, PairsAndGroupsHaveMarginsOfTheirOwn) {
    Scene scene;
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    scene.add({"floor", box({9, 9, 1}).polyhedron(), Motion::at_rest(shifted(0, 0, -1)), "static"});
    for (const std::string name : {"a", "b"}) {
        const double place = name == "a" ? 0 : 3;
        scene.add({name, cube, Motion::velocity(shifted(place, 0, 2.5), shifted(place, 0, 0.5)), "falling"});
    }
    const auto time_of = [&](double margin, const std::string& name) {
        for (const SceneContact& contact : scene.all_contacts({.options = {.margin = margin}}).contacts)
            if (scene.bodies()[contact.moving].name == name && scene.bodies()[contact.fixed].name == "floor")
                return contact.contact.time.lower;
        return 2.0;
    };
    EXPECT_NEAR(time_of(0.5, "a"), 0.75, 1e-11);
    scene.set_group_margin("static", "falling", 1.5);
    EXPECT_NEAR(time_of(0.5, "a"), 0.25, 1e-11);
    scene.set_margin("floor", "b", 0.2);
    EXPECT_NEAR(time_of(0, "a"), 0.25, 1e-11);
    EXPECT_NEAR(time_of(0, "b"), 0.9, 1e-11);
    EXPECT_EQ(scene.first_contact().contacts.size(), 1);
    scene.set_margin("a", "b", 2.5); // they are 2 apart all along
    EXPECT_EQ(scene.first_contact().verdict, Verdict::contact_at_start);
    EXPECT_EQ(refusal([&] { scene.set_margin("a", "a", 1); }), "scene: a: margin: the same body twice");
    EXPECT_EQ(refusal([&] { scene.set_margin("a", "c", 1); }), "scene: c: is not in the scene");
    EXPECT_EQ(refusal([&] { scene.set_group_margin("a", "c", -1); }), "query: margin: must be in [0, 1e30]");
    scene.remove("b");
    scene.add({"b", cube, Motion::at_rest(shifted(3, 0, 2.5))});
    EXPECT_EQ(scene.first_contact({.until = 0}).verdict, Verdict::clear);
}

/// A box turns and slides over a floor, 0.05 above it. Another one flies above both.
TEST(Scene, HeldPairsMayMoveOn) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    Scene scene;
    scene.add({"floor", box({9, 9, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -0.5)), "static"});
    scene.add({"box", cube, Motion::velocity(shifted(0, 0, 0.55), turned({3, 0, 0.55}, {0, 0, 1}, 1)), "parts"});
    scene.add({"other", cube, Motion::velocity(shifted(9, 0, 2), shifted(-9, 0, 2)), "parts"});
    SceneQuery query{.options = {.margin = 0.1}};
    EXPECT_EQ(scene.first_contact(query).verdict, Verdict::contact_at_start);
    query.options.hold = 0.02;
    EXPECT_EQ(scene.first_contact(query).verdict, Verdict::clear);
    EXPECT_EQ(scene.first_contact(query).clear_until, 1);

    query.options.hold.reset();
    scene.set_group_hold("parts", "static", 0.02);
    EXPECT_EQ(scene.first_contact(query).verdict, Verdict::clear);
    scene.set_hold("floor", "box", 0.049);
    EXPECT_EQ(scene.first_contact(query).verdict, Verdict::clear);
    scene.set_margin("floor", "box", 0.06);
    EXPECT_EQ(scene.first_contact(query).verdict, Verdict::clear);
    scene.set_hold("floor", "box", 0.06);
    EXPECT_EQ(scene.first_contact(query).verdict, Verdict::contact_at_start) << "a margin that is not greater";

    scene.set_hold("floor", "box", 0.02);
    scene.move(1, Motion::velocity(shifted(0, 0, 0.55), turned({0, 0, 0.55}, {1, 0, 0}, 0.6)));
    const SceneAnswer tilted = scene.first_contact(query);
    ASSERT_EQ(tilted.contacts.size(), 1U);
    // The lowest edge is cos(angle - pi / 4) / sqrt(2) below the centre.
    const double angle = std::numbers::pi / 4 - std::acos((0.55 - 0.02) * std::numbers::sqrt2);
    EXPECT_NEAR(tilted.contacts[0].contact.time.lower, angle / 0.6, 1e-11);
    EXPECT_EQ(tilted.clear_until, tilted.contacts[0].contact.time.lower);
    EXPECT_EQ(tilted.contacts[0].contact.held.size(), 4U);
    EXPECT_EQ(scene.clear_until(query)[0], tilted.clear_until);

    EXPECT_EQ(refusal([&] { scene.set_hold("box", "box", 1); }), "scene: box: hold: the same body twice");
    EXPECT_EQ(refusal([&] { scene.set_group_hold("parts", "static", -1); }), "query: hold: must be in [0, 1e30]");
    query.options.hold = 0.1;
    EXPECT_EQ(refusal([&] { (void)scene.first_contact(query); }), "query: hold: 0.1 is not less than the margin 0.1");
    SceneQuery any;
    any.options.find = Find::any;
    const std::string lists = "query: find: any asks whether anything touches, and this lists all that does: leave it "
                              "out, or ask for the first contact";
    EXPECT_EQ(refusal([&] { (void)scene.all_contacts(any); }), lists);
    EXPECT_EQ(refusal([&] { (void)scene.clear_until(any); }), lists);
    query.options.hold = std::nan("");
    EXPECT_EQ(refusal([&] { (void)scene.first_contact(query); }), "query: hold: must be in [0, 1e30]");
}

/// A box on a floor passes a step of the floor within the margin, and is reported at the hold distance. Another pair
/// comes before.
TEST(Scene, APairThatIsHeldIsReportedAtTheHoldDistance) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    Body stair = box({9, 9, 0.5});
    add_box(stair, {4, 0, 0.5}, {1, 1, 1});
    Scene scene;
    scene.add({"floor", stair.polyhedron(), Motion::at_rest(shifted(0, 0, -0.5))});
    scene.add({"box", cube, Motion::velocity(shifted(0, 0, 0.55), shifted(4, 0, 0.55))});
    // The box is within the margin of the step from 2.4 / 4 on, and at the hold distance at 2.48 / 4.
    scene.add({"late", cube, Motion::velocity(shifted(0, 7, 5.6), shifted(0, 7, 5.6 - 5 / 0.61))});
    SceneQuery query{.options = {.margin = 0.1, .hold = 0.02}};
    const SceneAnswer found = scene.first_contact(query);
    ASSERT_EQ(found.contacts.size(), 1U);
    EXPECT_EQ(std::max(found.contacts[0].moving, found.contacts[0].fixed), 2U);
    EXPECT_NEAR(found.contacts[0].contact.time.lower, 0.61, 1e-11);
    const SceneAnswer all = scene.all_contacts(query);
    ASSERT_EQ(all.contacts.size(), 2U);
    EXPECT_NEAR(all.clear_until, 0.61, 1e-11);
    EXPECT_NEAR(all.contacts[1].contact.time.lower, 0.62, 1e-11);
}

TEST(Scene, LooksNoFurtherThanAsked) {
    const Scene scene = three_boxes();
    EXPECT_EQ(scene.first_contact({.until = 0.7}).verdict, Verdict::clear);
    EXPECT_EQ(scene.first_contact({.until = 0.8}).verdict, Verdict::contact);
    EXPECT_TRUE(scene.all_contacts({.until = 0.7}).contacts.empty());
    EXPECT_EQ(scene.clear_until({.until = 0.5}), std::vector<double>(3, 0.5));
    SceneQuery wide{.until = 0.7};
    wide.options.margin = 0.5; // reached 0.5 / 8 earlier
    EXPECT_EQ(scene.first_contact(wide).verdict, Verdict::contact);
}

TEST(Scene, KeepsItsBooks) {
    Scene scene = three_boxes();
    scene.ignore("second", "first");
    EXPECT_EQ(scene.all_contacts().contacts.size(), 2U);
    scene.remove("first");
    EXPECT_EQ(scene.index_of("third"), 0U) << "the last one takes the index";
    EXPECT_EQ(scene.all_contacts().contacts.size(), 1U);
    scene.add({"first", scene.bodies()[0].shape, Motion::velocity(shifted(-4, 0, 0), shifted(0, 0, 0))});
    EXPECT_EQ(scene.all_contacts().contacts.size(), 3U) << "a new body of an old name is not ignored";
    scene.move(scene.index_of("first"), Motion::at_rest(shifted(-40, 0, 0)));
    EXPECT_EQ(scene.all_contacts().contacts.size(), 1U);
    EXPECT_EQ(Scene().first_contact().verdict, Verdict::clear);
}

template <class Call>
void expect_refusal(const Call& call, const std::string& start) {
    EXPECT_EQ(refusal(call).substr(0, start.size()), start);
}

TEST(Scene, RefusesWhatItCannotUse) {
    Scene scene = three_boxes();
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    expect_refusal([&] { scene.add({"", cube}); }, "scene: a body has no name");
    expect_refusal([&] { scene.add({"first", cube}); }, "scene: first: is in the scene already");
    expect_refusal(
        [&] {
            scene.add({"screw", cube, Motion::screw(Pose(), shifted(1, 0, 0))});
        },
        "scene: screw: motion");
    expect_refusal([&] { scene.remove("fourth"); }, "scene: fourth: is not in the scene");
    expect_refusal([&] { scene.ignore("first", "fourth"); }, "scene: fourth: is not in the scene");
    expect_refusal([&] { scene.ignore("first", "first"); }, "scene: first: ignore: the same body twice");
    expect_refusal([&] { scene.move(3, Motion::at_rest(Pose())); }, "scene: body 3: there are 3 bodies");
    expect_refusal([&] { (void)scene.first_contact({.until = 2}); }, "query: until: must be in [0, 1]");
    EXPECT_EQ(scene.bodies().size(), 3U);
}

TEST(Scene, NamesThePairWhoseMotionIsRefused) {
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    const Pose far({0, 0, 1e20}, Eigen::Quaterniond::Identity());
    Scene scene;
    scene.add({"table", cube});
    scene.add({"thrown", cube, Motion::velocity(far, Pose({0, 0, 0}, Eigen::Quaterniond(2, 1, 0, 0)))});
    for (const std::string& refused : {refusal([&] { (void)scene.first_contact(); }), refusal([&] {
                                           (void)scene::nearest_pair(scene, {.pairs = {.first = {0, 1}}});
                                       })}) {
        EXPECT_EQ(refused.substr(0, 7), "scene: ");
        EXPECT_NE(refused.find("thrown"), std::string::npos);
        EXPECT_NE(refused.find(": motion: goes up to "), std::string::npos) << refused;
    }
}

TEST(Scene, EndsWhereItIsCancelled) {
    const Scene scene = three_boxes();
    std::size_t done = 0;
    SceneQuery query;
    query.progress = [&](std::size_t now, std::size_t pairs) {
        EXPECT_EQ(pairs, 3U);
        done = now;
        return true;
    };
    (void)scene.all_contacts(query);
    EXPECT_EQ(done, 3U);
    query.progress = [](std::size_t, std::size_t) { return false; };
    const SceneAnswer cancelled = scene.all_contacts(query);
    EXPECT_EQ(cancelled.verdict, Verdict::unknown);
    EXPECT_TRUE(cancelled.contacts.empty());
}

} // namespace
} // namespace chasles::test
