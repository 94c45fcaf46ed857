// The last stage of a query: touches and misses that no floating-point bound can separate.
#include "chasles/search/exact_stage.h"

#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

constexpr double tiny = 0x1p-200; // far below the bound of double-double

Polyhedron wall_at(double height) {
    return Polyhedron::from_polygons(Vertices{{-2, -2, height}, {2, -2, 0}, {0, 3, 0}}, Faces{{0, 1, 2}});
}

/// A downward spike with its tip at the origin of its frame.
Polyhedron spike() {
    return Polyhedron::from_polygons(Vertices{{0, 0, 0}, {1, 0, 4}, {0, 1, 4}, {-1, -1, 4}},
                                     Faces{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
}

FirstContact slide(double height, const Find find = Find::first) {
    return first_contact({.moving = spike(),
                          .fixed = wall_at(0),
                          .motion = ScrewMotion::between(shifted(-6, 0, height), shifted(6, 0, height)),
                          .options = {.find = find}});
}

TEST(ExactStage, ASlideInThePlaneOfAFaceIsAContact) {
    const FirstContact found = slide(0);
    EXPECT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    EXPECT_GT(found.work.exact, 0u);
    EXPECT_LE(found.time.upper - found.time.lower, 1e-12);
    EXPECT_NEAR(found.time.lower, (6 - 1.2) / 12, 1e-12) << "x = -1.2 is where the edge crosses y = 0";
}

TEST(ExactStage, ASlideAboveThePlaneIsClearHoweverLow) {
    const FirstContact found = slide(tiny);
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_GT(found.work.exact, 0u) << "only the exact stage can decide";
}

TEST(ExactStage, ASlideBelowThePlaneIsAContactHoweverShallow) {
    for (const Find find : {Find::first, Find::any, Find::first_with_all_contacts}) {
        const FirstContact found = slide(-tiny, find);
        EXPECT_EQ(found.verdict, Verdict::contact);
        EXPECT_TRUE(found.certain);
    }
}

/// The tip moves on a circle that touches a wall exactly, or misses it by less than any bound.
TEST(ExactStage, ATangentTouchIsToldFromATangentMiss) {
    const Polyhedron arm =
        Polyhedron::from_polygons(Vertices{{-1, 0, 0}, {-0.5, 0, 0.01}, {-0.5, 0, -0.01}}, Faces{{0, 1, 2}});
    const auto wall = [](double x) {
        return Polyhedron::from_polygons(Vertices{{x, -1, -1}, {x, 1, -1}, {x, 1, 1}, {x, -1, 1}}, Faces{{0, 1, 2, 3}});
    };
    const Pose start(Eigen::Vector3d::Zero(), Eigen::Quaterniond(8, 0, 0, -1));
    const Pose goal(Eigen::Vector3d::Zero(), Eigen::Quaterniond(8, 0, 0, 1));
    const auto answer = [&](double x) {
        const Polyhedron fixed = wall(x);
        return first_contact({.moving = arm, .fixed = fixed, .motion = ScrewMotion::between(start, goal, 3)});
    };
    const FirstContact touch = answer(-1);
    EXPECT_EQ(touch.verdict, Verdict::contact);
    EXPECT_TRUE(touch.certain);
    EXPECT_LE(touch.tau.lower, 63.0 / 128) << "the turn is (63, 16 tau k), and half of it (8, k)";
    EXPECT_GE(touch.tau.upper, 63.0 / 128);
    EXPECT_LE(touch.tau.upper - touch.tau.lower, 1e-12);
    EXPECT_NEAR(touch.time.lower, 0.5, 1e-12);
    EXPECT_EQ(answer(std::nextafter(-1.0, -2.0)).verdict, Verdict::clear);
    EXPECT_EQ(answer(std::nextafter(-1.0, 0.0)).verdict, Verdict::contact);
}

/// The turn between these quaternions has the length sqrt(2), and is 45 degrees at half time.
TEST(ExactStage, ASweepIsDecidedWithTheRootOfItsQuaternion) {
    const auto answer = [&](double height) { // along an edge of the wall, z = 0, when it passes y = 0
        const Polyhedron arm =
            Polyhedron::from_polygons(Vertices{{1, -1, height}, {2, -2, 1 + height}, {2, -2, 2}}, Faces{{0, 1, 2}});
        const Polyhedron wall = Polyhedron::from_polygons(Vertices{{1, 0, 0}, {3, 0, 0}, {2, 0, -2}}, Faces{{0, 1, 2}});
        return first_contact(
            {.moving = arm, .fixed = wall, .motion = SweepMotion::between(Pose(), Pose({0, 0, 0}, {1, 0, 0, 1}))});
    };
    const FirstContact found = answer(0);
    EXPECT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    EXPECT_LE(found.time.lower, 0.5);
    EXPECT_GE(found.time.upper, 0.5);
    EXPECT_GT(found.work.exact, 0u);
    EXPECT_EQ(answer(tiny).verdict, Verdict::clear);
    EXPECT_EQ(answer(-tiny).verdict, Verdict::contact);
}

TEST(ExactStage, TouchingAtTheVeryEndIsCertain) {
    const auto answer = [&](double end) {
        const Polyhedron moving = spike();
        const Polyhedron fixed = wall_at(0);
        return first_contact(
            {.moving = moving, .fixed = fixed, .motion = ScrewMotion::between(shifted(0, 0, 1), shifted(0, 0, end))});
    };
    const FirstContact found = answer(0);
    EXPECT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    EXPECT_EQ(found.time.upper, 1);
    EXPECT_EQ(answer(tiny).verdict, Verdict::clear);
}

TEST(ExactStage, TouchingAtTheVeryStartIsToldFromStartingNextToIt) {
    const auto answer = [&](double start) {
        const Polyhedron moving = spike();
        const Polyhedron fixed = wall_at(0);
        return first_contact({.moving = moving,
                              .fixed = fixed,
                              .motion = ScrewMotion::between(shifted(0, 0, start), shifted(0.5, 0, start))});
    };
    EXPECT_EQ(answer(0).verdict, Verdict::contact_at_start);
    EXPECT_TRUE(answer(0).certain);
    EXPECT_EQ(answer(tiny).verdict, Verdict::clear);
    EXPECT_EQ(answer(-tiny).verdict, Verdict::contact_at_start);
}

TEST(ExactStage, TwoMovingBodiesAreSeenFromOneAnotherWithoutRounding) {
    const Eigen::Quaterniond odd(0.3, 0.1, -0.7, 0.2); // of no rational length
    const auto answer = [&](double height) {           // both edges are parallel, and one slides over the other
        const Polyhedron moving = spike();
        const Polyhedron fixed = wall_at(0);
        const Pose frame({0, 0, 0}, odd);
        const Eigen::Vector3d aside(3, 1, 2);
        return first_contact({.moving = moving,
                              .fixed = fixed,
                              .motion = ScrewMotion::relative(Pose({0, 0, height}, {1, 0, 0, 0}),
                                                              Pose(Eigen::Vector3d(0, 0, height) + aside, {1, 0, 0, 0}),
                                                              Pose(), Pose(aside, {1, 0, 0, 0}))});
    };
    EXPECT_EQ(answer(0).verdict, Verdict::contact_at_start);
    EXPECT_TRUE(answer(0).certain);
    EXPECT_EQ(answer(0x1p-40).verdict, Verdict::clear);
}

TEST(ExactStage, TouchingRightAfterTheStartIsNoContactAtTheStart) {
    for (const double height : {1e-14, 1e-15, 1e-16, 1e-17, 1e-20, 1e-30, tiny}) {
        const Polyhedron moving = spike();
        const Polyhedron fixed = wall_at(0);
        const FirstContact found =
            first_contact({.moving = moving,
                           .fixed = fixed,
                           .motion = ScrewMotion::between(shifted(0, 0, height), shifted(0, 0, -1))});
        EXPECT_EQ(found.verdict, Verdict::contact) << height;
        EXPECT_TRUE(found.certain);
        EXPECT_GT(found.time.lower, 0) << height;
        EXPECT_LE(found.time.lower, height);
    }
}

/// The time of the touch lies between 0 and the next double.
TEST(ExactStage, ATouchBeforeTheLeastDoubleIsNoContactAtTheStart) {
    const auto answer = [](double height) {
        const Polyhedron moving = spike();
        const Polyhedron fixed = wall_at(0);
        return first_contact({.moving = moving,
                              .fixed = fixed,
                              .motion = ScrewMotion::between(shifted(0, 0, height), shifted(0, 0, height - 1e20))});
    };
    const FirstContact later = answer(0x1p-1070);
    EXPECT_EQ(later.verdict, Verdict::contact);
    EXPECT_TRUE(later.certain);
    EXPECT_EQ(later.time.lower, 0);
    EXPECT_GT(later.time.upper, 0);
    const FirstContact now = answer(0);
    EXPECT_EQ(now.verdict, Verdict::contact_at_start);
    EXPECT_TRUE(now.certain);
    EXPECT_EQ(now.time.upper, 0);
}

/// A face with corners slightly off one plane is known only up to this deviation.
TEST(ExactStage, AWarpedFaceLeavesDoubt) {
    const auto answer = [](double warp) { // down to the middle of the face, and no farther
        const Polyhedron moving = spike();
        const Polyhedron fixed =
            Polyhedron::from_polygons(Vertices{{-2, -2, warp}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, Faces{{0, 1, 2, 3}});
        return first_contact(
            {.moving = moving, .fixed = fixed, .motion = ScrewMotion::between(shifted(0, 0, 1), shifted(0, 0, 0))});
    };
    EXPECT_EQ(answer(0).verdict, Verdict::contact);
    EXPECT_TRUE(answer(0).certain);
    EXPECT_EQ(answer(0x1p-44).verdict, Verdict::contact);
    EXPECT_FALSE(answer(0x1p-44).certain);
}

/// The tip is below the face by less than any bound. No bound can prove that the tip or an end of an edge is below.
TEST(ExactStage, AnOverlapByNextToNothingAtTheStartIsFound) {
    const auto answer = [](double height, const Eigen::Vector3d& way) {
        const Polyhedron moving = spike();
        const Polyhedron fixed = wall_at(0);
        const Pose start = shifted(0, 0, height);
        return first_contact({.moving = moving,
                              .fixed = fixed,
                              .motion = ScrewMotion::between(start, Pose(start.translation + way, start.rotation))});
    };
    for (const Eigen::Vector3d& way :
         {Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0, 0, 1)}) {
        const FirstContact found = answer(-tiny, way);
        EXPECT_EQ(found.verdict, Verdict::contact_at_start) << way.transpose();
        EXPECT_TRUE(found.certain);
        EXPECT_EQ(answer(tiny, way).verdict, way.z() < 0 ? Verdict::contact : Verdict::clear);
    }
}

TEST(ExactStage, AnEdgeThroughTheRimAtTheStartIsDecided) {
    const auto answer = [](double x) { // an edge through (x, 0, 0), and a triangle that ends at x = 0
        const Polyhedron moving =
            Polyhedron::from_polygons(Vertices{{x, 0, -1}, {x, 0, 1}, {3, 0, 2}}, Faces{{0, 1, 2}});
        const Polyhedron fixed =
            Polyhedron::from_polygons(Vertices{{0, -1, 0}, {0, 1, 0}, {-2, 0, 0}}, Faces{{0, 1, 2}});
        return first_contact(
            {.moving = moving, .fixed = fixed, .motion = ScrewMotion::between(Pose(), shifted(1, 0, 0))});
    };
    EXPECT_EQ(answer(0).verdict, Verdict::contact_at_start);
    EXPECT_TRUE(answer(0).certain);
    EXPECT_EQ(answer(tiny).verdict, Verdict::clear);
    EXPECT_EQ(answer(-tiny).verdict, Verdict::contact_at_start);
    EXPECT_TRUE(answer(-tiny).certain);
}

} // namespace
} // namespace chasles::test
