// The three results of the demo's queries, compared with the geometry of the thread.
#include "scenes/demo.h"

#include "chasles/query/path.h"
#include "scenes/nut_motions.h"
#include "tests/scenes/axial_way.h"
#include "tests/scenes/exact_crossing.h"
#include "tests/support/own_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

namespace chasles::scenes {
namespace {

constexpr double max_turn = std::numbers::pi / 18;
constexpr double height = 2; // of the nut: one pitch
const ThreadedFastener small{.bolt_length = 8, .nut_height = 4.5, .segments = 24};

bool do_cross(const std::vector<Corners>& moving, const std::vector<Corners>& fixed) {
    bool found = false;
    for_near_pairs(moving, fixed, 0, [&](const Corners& a, const Corners& b) { found = found || cross(a, b); });
    return found;
}

FirstContact pulled(const Polyhedron& moving, const Polyhedron& fixed, double turns, double way) {
    const NutTurn thread{.height = height, .slide_per_turn = small.pitch};
    const Pose start = nut_pose(thread, turns);
    Pose goal = start;
    goal.translation.z() += way;
    return first_contact({.moving = moving, .fixed = fixed, .motion = ScrewMotion::between(start, goal)});
}

TEST(Demo, TheRightScrewIsProvenClear) {
    const Polyhedron screw = bolt(small);
    const Polyhedron ring = nut(small);
    for (const double turns : {2.0, -0.6}) {
        const std::vector<Pose> poses = nut_path({.height = height, .turns = turns, .slide_per_turn = small.pitch});
        const FirstContact found =
            first_contact_on_path({.moving = ring, .fixed = screw, .motions = screws_along(poses)}).contact;
        EXPECT_EQ(found.verdict, Verdict::clear) << turns;
        EXPECT_GT(found.work.elementary_tests, 1000U)
            << "clear by tests of close features, not because the bodies are far apart";
    }
}

// Derivation 09: in phase the nut can move up by exactly the axial clearance.
TEST(Demo, APullInPhaseEndsAtTheAxialClearance) {
    for (const double way : {1.0, -1.0, 6.0}) {
        const FirstContact found = pulled(nut(small), bolt(small), 0, way);
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_NEAR(found.time.lower * std::abs(way), axial_clearance(small), 1e-9);
        EXPECT_NEAR(found.time.upper * std::abs(way), axial_clearance(small), 1e-9);
    }
}

TEST(Demo, APullOutOfPhaseEndsWhereTheProjectedFacetsMeet) {
    const Polyhedron screw = bolt(small);
    const Polyhedron ring = nut(small);
    const auto fixed = placed(screw, {});
    for (double facets = 0.05; facets < 1; facets += 0.15) {
        const double turns = facets / small.segments;
        const Pose start = nut_pose({.height = height, .slide_per_turn = small.pitch}, turns);
        const double way = way_to_contact(placed(ring, start), fixed);
        const FirstContact found = pulled(ring, screw, turns, 1);
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_LE(found.time.lower, way + 1e-12) << "no later than it is";
        EXPECT_GE(found.time.upper, way - 1e-11) << "and no earlier";
    }
}

TEST(Demo, AWrongPitchTouchesOnceThePlayIsUsedUp) {
    const Polyhedron screw = bolt(small);
    const Polyhedron ring = nut(small);
    for (const double wrong : {1.75, 2.2}) {
        const NutTurn motion{.height = height, .turns = 1, .slide_per_turn = wrong};
        const std::vector<Pose> poses = nut_path(motion);
        const auto [found, segment] =
            first_contact_on_path({.moving = ring, .fixed = screw, .motions = screws_along(poses)});
        ASSERT_EQ(found.verdict, Verdict::contact);
        const double turns = (static_cast<double>(segment) + found.time.lower) / steps_per_turn;
        const double strayed = std::abs(found.pose.translation.z() - height - turns * small.pitch);
        const double least = axial_clearance(small) - axial_facet_error(small) - slide_deviation(wrong, max_turn);
        EXPECT_GE(strayed, least);
        EXPECT_LE(strayed, axial_clearance(small) + std::abs(small.pitch - wrong) / small.segments);
    }
}

// The exact crossing of sampled surfaces brackets the reported contact.
TEST(Demo, AWrongPitchCrossesJustAfterTheContactAndNotBefore) {
    const Polyhedron screw = bolt(small);
    const Polyhedron ring = nut(small);
    const auto fixed = placed(screw, {});
    const ScrewMotion motion =
        ScrewMotion::between(nut_pose({.height = height, .slide_per_turn = 1.5}, 0),
                             nut_pose({.height = height, .slide_per_turn = 1.5}, 1.0 / 3), std::numbers::pi);
    const FirstContact found = first_contact({.moving = ring, .fixed = screw, .motion = motion});
    ASSERT_EQ(found.verdict, Verdict::contact);
    for (int i = 0; i < 25; ++i) {
        const double time = 0.04 * i * found.time.lower;
        EXPECT_FALSE(do_cross(placed(ring, motion.pose_at(time)), fixed)) << time;
    }
    EXPECT_FALSE(do_cross(placed(ring, motion.pose_at(found.time.lower - 1e-9)), fixed)); // poses are rounded
    EXPECT_TRUE(do_cross(placed(ring, motion.pose_at(found.time.upper + 1e-9)), fixed));
}

void expect_same(const Polyhedron& read, const Polyhedron& made) {
    ASSERT_EQ(read.vertex_count(), made.vertex_count());
    ASSERT_EQ(read.face_count(), made.face_count());
    for (std::size_t i = 0; i < made.vertex_count(); ++i) {
        ASSERT_EQ(read.vertices()[i], made.vertices()[i]);
    }
}

TEST(Demo, TellsTheStoryReturnsZeroAndSavesBodiesThatReadBackTheSame) {
    const auto folder = test::own_file("demo");
    std::filesystem::create_directories(folder);
    std::ostringstream out;
    const auto save = [&](const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; };
    EXPECT_EQ(run_demo(out, small, save), 0) << out.str();
    EXPECT_NE(out.str().find("proven clear"), std::string::npos);
    EXPECT_EQ(out.str().find("WRONG"), std::string::npos);
    EXPECT_EQ(out.str().find("nan"), std::string::npos);
    expect_same(Polyhedron::load(folder / "bolt.obj"), bolt(small));
    expect_same(Polyhedron::load(folder / "nut.obj"), nut(small));
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace chasles::scenes
