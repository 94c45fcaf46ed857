// Curves of the distance in closed form, and beside the distances of all triangles at many poses.
#include "chasles/query/profile.h"

#include "chasles/base/limit.h"
#include "chasles/mesh/primitives.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/support/posed_motions.h"
#include "tests/support/refusal.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

constexpr double rounding = 1e-13;

DistanceProfile ask(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion,
                    const ProfileOptions& options = {}) {
    return profile({.moving = moving, .fixed = fixed, .motion = motion, .options = options});
}

/// The entry that holds at a time.
std::size_t step_at(const DistanceProfile& found, double time) {
    const auto after = std::ranges::upper_bound(found.times, time);
    return std::min(std::size_t(after - found.times.begin()), found.times.size() - 1) - 1;
}

/// The steps are whole and in order, and each is as narrow as asked.
void expect_narrow(const DistanceProfile& found, double tolerance, double absolute) {
    EXPECT_TRUE(found.certain);
    ASSERT_GE(found.times.size(), 2U);
    ASSERT_EQ(found.times.size(), found.lower.size());
    ASSERT_EQ(found.times.size(), found.upper.size());
    EXPECT_EQ(found.times.front(), 0);
    EXPECT_EQ(found.times.back(), 1);
    for (std::size_t i = 0; i + 1 < found.times.size(); ++i) {
        EXPECT_LT(found.times[i], found.times[i + 1]);
        EXPECT_GE(found.lower[i], 0);
        EXPECT_LE(found.upper[i] - found.lower[i], std::max(tolerance * found.upper[i], absolute) + rounding);
    }
}

void expect_holds(const DistanceProfile& found, const std::function<double(double)>& distance, int samples) {
    for (int i = 0; i <= samples; ++i) {
        const double time = double(i) / samples;
        const std::size_t step = step_at(found, time);
        EXPECT_LE(found.lower[step], distance(time) + rounding) << time;
        EXPECT_GE(found.upper[step], distance(time) - rounding) << time;
    }
}

Polyhedron point(double radius) {
    const std::vector<Vector3d> origin{Vector3d::Zero()};
    return make_points(origin, radius);
}

TEST(Profile, OfBallsOnAnArmAndOnALine) {
    for (const double tolerance : {1e-4, 1e-2, 0.3}) {
        const DistanceProfile on_arm =
            ask(point(0.5), point(0.25), Motion::hinge({0, 2, 0}, {0, 0, 1}, {0.75, 5}), {.tolerance = tolerance});
        const auto of_arm = [](double time) { return std::abs(4 * std::sin((0.75 + 5 * time) / 2)) - 0.75; };
        expect_narrow(on_arm, tolerance, 1e-6);
        expect_holds(on_arm, of_arm, 1000);
        const DistanceProfile on_line =
            ask(point(0.5), point(0.25), Motion::polynomial({{-3, 2, 1}, {7, 0, 0}}), {.tolerance = tolerance});
        expect_narrow(on_line, tolerance, 1e-6);
        expect_holds(
            on_line, [](double time) { return std::hypot(7 * time - 3, 2, 1) - 0.75; }, 1000);
    }
}

/// All kinds of motions of boxes that turn, sharp or round, against the least distance of all pairs of triangles.
TEST(Profile, IsNeverCrossedByTheDistancesOfAllTriangles) {
    Random random(61);
    int seen = 0;
    for (int i = 0; i < 40 * times_if_long(20); ++i) {
        const auto random_box = [&] {
            const Polyhedron sharp =
                box({random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)}).polyhedron();
            return random.chance(0.5) ? sharp : sharp.with_radius(random.uniform(0, 1));
        };
        const auto random_pose = [&] { return Pose(eigen(random.vector(4)), random_rotation(random)); };
        const Polyhedron moving = random_box(), fixed = random_box();
        const Pose start = random_pose(), goal = random_pose();
        for (const Motion& motion : {Motion(ScrewMotion::between(start, goal)), Motion::velocity(start, goal),
                                     Motion(SweepMotion::between(start, goal)), Motion::twist(start, goal)}) {
            const ProfileOptions options{.tolerance = random.chance(0.5) ? 0.02 : 0.3,
                                         .absolute_tolerance = random.chance(0.5) ? 1e-5 : 3e-2};
            const DistanceProfile found = ask(moving, fixed, motion, options);
            if (found.free().size() != 1 || found.free()[0].lower > 0 || found.free()[0].upper < 1)
                continue; // surfaces that cross have distances that are not 0
            ++seen;
            expect_narrow(found, options.tolerance, options.absolute_tolerance);
            const double radii = moving.report().radius + fixed.report().radius;
            const auto distance = [&](double time) { return distance_at(moving, fixed, motion.pose_at(time)) - radii; };
            expect_holds(found, distance, 100);
        }
    }
    EXPECT_GT(seen, 60);
}

/// Where bodies come near from far away, the tolerance changes from a part of the distance to a length.
TEST(Profile, StepsAreAsNarrowAsAskedUntilTheBodiesTouch) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const Pose goal({-1, 0.25, 0.3}, Eigen::Quaterniond(1, 0.1, 0, 0.2));
    for (const double radius : {0.0, 0.4})
        for (const double tolerance : {0.01, 0.05, 0.2}) {
            const ProfileOptions options{.tolerance = tolerance, .absolute_tolerance = 1e-6};
            const DistanceProfile found =
                ask(cube.with_radius(radius), cube, ScrewMotion::between(shifted(3, 0.2, 0.3), goal), options);
            EXPECT_TRUE(found.certain);
            std::size_t apart = 0;
            for (std::size_t i = 0; i + 1 < found.times.size() && found.lower[i] > 0; ++i, ++apart)
                EXPECT_LE(found.upper[i] - found.lower[i], std::max(tolerance * found.upper[i], 1e-6) + rounding)
                    << found.times[i];
            EXPECT_GT(apart, 20U);
        }
}

/// A cube passes through another one: free, then not, and free again.
TEST(Profile, NamesTheTimesThatAreFree) {
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    const DistanceProfile found = ask(cube, cube, Motion::slider({1, 0, 0}, {-6, 10}));
    EXPECT_TRUE(found.certain);
    const std::vector<Bracket> free = found.free();
    ASSERT_EQ(free.size(), 2U);
    EXPECT_EQ(free[0].lower, 0);
    EXPECT_NEAR(free[0].upper, 0.4, 1e-6);
    EXPECT_LT(free[0].upper, 0.4);
    EXPECT_NEAR(free[1].lower, 0.8, 1e-6);
    EXPECT_GT(free[1].lower, 0.8);
    EXPECT_EQ(free[1].upper, 1);
    expect_holds(
        found, [](double time) { return std::max(0.0, std::abs(10 * time - 6) - 2); }, 200);
}

/// A cube passes through two others, which are one body. The distance is 0 while it does, without many steps.
TEST(Profile, OverlapsThatLastAreOneStepOrAFew) {
    Body two = box({0.3, 0.3, 2});
    add_box(two, {6, 0, 0}, {0.3, 0.3, 2});
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron(), posts = two.polyhedron();
    const Pose tilted({0.1, 0.2, 0.3}, Eigen::Quaterniond(1, 0.2, 0.3, 0.1));
    for (const Motion& motion : {Motion::slider({1, 0, 0}, {-3, 12}) * Motion::at_rest(tilted),
                                 Motion::velocity(shifted(-3, 0.1, 0.2), Pose({9, 0.2, 0.1}, tilted.rotation)),
                                 Motion::screw(Pose({-3, 0.2, 0}, tilted.rotation), shifted(9, 0, 0.1))}) {
        const DistanceProfile found = ask(cube, posts, motion);
        EXPECT_TRUE(found.certain);
        EXPECT_EQ(found.free().size(), 3U);
        expect_holds(
            found, [&](double time) { return distance_at(cube, posts, motion.pose_at(time)); }, 300);
        std::size_t zero = 0;
        double time = 0;
        for (std::size_t i = 0; i + 1 < found.times.size(); ++i)
            if (found.upper[i] == 0) {
                ++zero;
                time += found.times[i + 1] - found.times[i];
            }
        EXPECT_GT(time, 0.2) << "of two times 1.6 / 12 at least, less what is shallow";
        EXPECT_LT(zero, 60U);
    }
}

/// Round bodies touch while their polyhedra are apart.
/// The lower cube's top and the upper one's bottom lie in one plane, and each cube turns on a pin of its own. A
/// distance of roundings tells no direction.
TEST(Profile, FacesThatSlideInOnePlaneTakeFewSteps) {
    const Polyhedron cube = make_box({1, 1, 1});
    const Motion upper =
        Motion::at_rest(turned({0, 0, 1}, Vector3d::UnitZ(), 0)) * Motion::hinge({0.2, 0, 0}, {0, 0, 1}, {0, 1});
    const Motion lower = Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, -1});
    for (const double tolerance : {0.15, 0.01}) {
        const DistanceProfile found = ask(cube, cube, relative(upper, lower), {.absolute_tolerance = tolerance});
        expect_narrow(found, 0, tolerance);
        expect_holds(
            found, [](double) { return 0; }, 100);
        EXPECT_LT(found.times.size(), 300U) << tolerance;
    }
}

/// Round plates of the thickness 1 about the z-axis.
Polyhedron plates(std::initializer_list<double> bottoms) {
    constexpr std::uint32_t around = 24;
    std::vector<Vector3d> corners;
    std::vector<std::vector<std::uint32_t>> faces;
    for (const double bottom : bottoms) {
        const auto first = std::uint32_t(corners.size());
        std::vector<std::uint32_t> below, above;
        for (std::uint32_t i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            for (const double height : {bottom, bottom + 1})
                corners.emplace_back(std::cos(angle), std::sin(angle), height);
            const std::uint32_t here = first + 2 * i, next = first + 2 * ((i + 1) % around);
            faces.push_back({here, next, next + 1, here + 1});
            below.push_back(first + 2 * (around - 1 - i));
            above.push_back(here + 1);
        }
        faces.push_back(below);
        faces.push_back(above);
    }
    return Polyhedron::from_polygons(corners, faces);
}

/// A plate turns between two others, as a knuckle of a hinge does.
TEST(Profile, EqualGapsOnBothSidesCostWhatOneGapCosts) {
    const Motion turn = Motion::hinge({0, 0, 0}, {0, 0, 1}, {0.1, 3});
    const auto between = [&](double gap) { return ask(plates({0}), plates({-1.01, 1 + gap}), turn); };
    const DistanceProfile equal = between(0.01), unequal = between(0.02);
    expect_narrow(equal, 1e-2, 1e-6);
    expect_holds(
        equal, [](double) { return 0.01; }, 100);
    EXPECT_LT(equal.work.node_pairs, 4 * unequal.work.node_pairs);
}

/// The nearest points run along two edges that cross, while the gap stays or changes evenly.
TEST(Profile, GapsOfEdgesThatCrossTakeFewSteps) {
    const Polyhedron bar = make_box({4, 0.5, 0.5});
    for (const double gap : {1e-6, 1e-3}) {
        for (const double rise : {0.0, 0.25 * gap}) {
            const Pose start = turned({0, 0, 0.5 + gap}, Vector3d::UnitZ(), 0.5);
            const Pose goal = turned({0.3, 0.2, 0.5 + gap + rise}, Vector3d::UnitZ(), 1.5);
            const DistanceProfile found = ask(bar, bar, Motion::velocity(start, goal), {.absolute_tolerance = 1e-8});
            expect_narrow(found, 1e-2, 1e-8);
            expect_holds(
                found, [&](double time) { return gap + rise * time; }, 1000);
            EXPECT_LT(found.times.size(), gap < 1e-4 ? 20000U : 1000U) << gap;
        }
    }
}

TEST(Profile, TellsAnOverlapThatIsAllowedFromTouch) {
    const Polyhedron cube = make_box({1, 1, 1});
    const Motion slide =
        Motion::velocity(turned({1, 0, 0}, Vector3d::UnitZ(), 0), turned({1, 0.5, 0}, Vector3d::UnitZ(), 0));
    const DistanceProfile found = ask(cube.with_radius(-1e-6), cube, slide);
    ASSERT_EQ(found.free().size(), 1U);
    EXPECT_EQ(found.free()[0].lower, 0);
    EXPECT_EQ(found.free()[0].upper, 1);
    expect_holds(
        found, [](double) { return 1e-6; }, 100);
}

TEST(Profile, RoundBodiesAreFreeUntilTheirRadiiMeet) {
    const Polyhedron cube = box({1, 1, 1}).polyhedron().with_radius(0.5);
    const DistanceProfile found = ask(cube, cube, Motion::slider({1, 0, 0}, {-4, 8}));
    EXPECT_TRUE(found.certain);
    const std::vector<Bracket> free = found.free();
    ASSERT_EQ(free.size(), 2U);
    EXPECT_NEAR(free[0].upper, 0.125, 1e-6);
    EXPECT_NEAR(free[1].lower, 0.875, 1e-6);
    expect_holds(
        found, [](double time) { return std::max(0.0, std::abs(8 * time - 4) - 3); }, 200);
}

TEST(Profile, ZonesEndWhereMarginsAreCrossed) {
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    const DistanceProfile found =
        ask(cube, cube, Motion::polynomial({{-6, 2.5, 0}, {12, 0, 0}}), {.margins = {1, 0.75, 3}});
    for (const double margin : {0.75, 1.0, 3.0}) { // the gap is hypot(max(|x| - 2, 0), 0.5)
        const double half = (2 + std::sqrt(margin * margin - 0.25)) / 12;
        const Zones zones = found.zones(margin);
        ASSERT_EQ(zones.inside.size(), 1U) << margin;
        EXPECT_GE(zones.inside[0].lower, 0.5 - half - 1e-12);
        EXPECT_LE(zones.inside[0].lower, 0.5 - half + 1e-6);
        EXPECT_LE(zones.inside[0].upper, 0.5 + half + 1e-12);
        EXPECT_GE(zones.inside[0].upper, 0.5 + half - 1e-6);
        double doubt = 0;
        for (const Bracket& part : zones.doubt)
            doubt += part.upper - part.lower;
        EXPECT_LE(doubt, 4e-6) << margin;
    }
    EXPECT_TRUE(found.zones(0.25).inside.empty());
    EXPECT_TRUE(found.zones(0.25).doubt.empty());
    EXPECT_EQ(found.zones(100).inside.size(), 1U);
}

/// Times of a margin in doubt are as short as asked, but where the distance hardly leaves the margin.
TEST(Profile, CrossingsOfTurningBoxesAreBoundedClosely) {
    Random random(7);
    int crossings = 0;
    for (int i = 0; i < 30; ++i) {
        const auto random_box = [&] {
            return box({random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)}).polyhedron();
        };
        const auto random_pose = [&] { return Pose(eigen(random.vector(4)), random_rotation(random)); };
        const Polyhedron moving = random_box(), fixed = random_box();
        const Motion motion = Motion::velocity(random_pose(), random_pose());
        const auto distance = [&](double time) { return distance_at(moving, fixed, motion.pose_at(time)); };
        const double margin = distance(random.uniform(0.1, 0.9));
        const double tolerance = random.chance(0.5) ? 0.01 : 0.2;
        const DistanceProfile found =
            ask(moving, fixed, motion, {.tolerance = tolerance, .absolute_tolerance = 1e-4, .margins = {margin}});
        if (found.free().size() == 1 && found.free()[0].lower == 0 && found.free()[0].upper == 1)
            expect_narrow(found, tolerance, 1e-4);
        for (const Bracket& part : found.zones(margin).doubt) {
            ++crossings;
            for (int k = 0; k <= 10 && part.upper - part.lower > 4e-6; ++k)
                EXPECT_NEAR(distance(part.lower + 0.1 * k * (part.upper - part.lower)), margin,
                            1e-3 * tolerance * margin + 2e-5);
        }
    }
    EXPECT_GT(crossings, 20);
}

/// A distance that is the margin all along is in doubt all along, in few steps.
TEST(Profile, AMarginThatIsTheDistanceCostsNothing) {
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    const DistanceProfile found = ask(cube, cube, Motion::slider({0, 0, 1}, {-0.5, 1}), {.margins = {0}});
    EXPECT_TRUE(found.zones(0).inside.empty());
    const DistanceProfile beside =
        ask(cube, cube, relative(Motion::slider({0, 0, 1}, {-0.5, 1}), Motion::at_rest(shifted(4, 0, 0))),
            {.margins = {2}});
    EXPECT_LT(beside.times.size(), 1000U);
    EXPECT_EQ(beside.zones(2).doubt.size() + beside.zones(2).inside.size(), 1U);
}

/// What is inside of a solid body is at the distance 0; without a volume it is apart from the surface.
TEST(Profile, OfABodyInsideOfAnotherOne) {
    const Polyhedron small = box({0.25, 0.25, 0.25}).polyhedron();
    const Motion motion = Motion::slider({1, 0, 0}, {-0.5, 1});
    const DistanceProfile solid = ask(small, box({2, 2, 2}).polyhedron(), motion);
    EXPECT_TRUE(solid.free().empty());
    EXPECT_EQ(*std::ranges::max_element(solid.upper), 0);
    const Body shell = box({2, 2, 2});
    const Polyhedron open = Polyhedron::from_polygons(shell.vertices, shell.faces, {.solid = Solid::no});
    const DistanceProfile hollow = ask(small, open, motion);
    expect_holds(
        hollow, [](double time) { return 1.75 - std::abs(time - 0.5); }, 100);
    expect_narrow(hollow, 1e-2, 1e-5);
}

TEST(Profile, AtALimitIsWhatIsProvenSoFar) {
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    const Limit limit(0);
    const DistanceProfile found = ask(cube, cube, Motion::slider({1, 0, 0}, {-6, 3}));
    EXPECT_FALSE(found.certain);
    EXPECT_EQ(found.times.back(), 1);
    expect_holds(
        found, [](double time) { return 4 - 3 * time; }, 50);
    const DistanceProfile of_turns = ask(cube, cube, Motion::hinge({5, 0, 0}, {0, 0, 1}, {0, 300}));
    EXPECT_EQ(of_turns.times.size(), 2U) << "no piece is begun";
    EXPECT_GE(of_turns.upper.front(), 8);
}

TEST(Profile, OptionsOutOfTheirRangeAreRefused) {
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    const auto with = [&](const ProfileOptions& options) {
        return [&cube, options] { (void)ask(cube, cube, Motion::at_rest({}), options); };
    };
    EXPECT_EQ(refusal(with({.tolerance = 1e-5})), "query: tolerance: must be in [1e-4, 1]");
    EXPECT_EQ(refusal(with({.absolute_tolerance = -1})), "query: absolute_tolerance: must be at least 0, and finite");
    EXPECT_EQ(refusal(with({.margins = {0.5, -1}})), "query: margin: must be in [0, 1e30]");
    EXPECT_EQ(refusal(with({.time_tolerance = 0})), "query: time_tolerance: must be in [1e-9, 1]");
    const DistanceProfile found = ask(cube, cube, Motion::at_rest(shifted(5, 0, 0)));
    EXPECT_EQ(refusal([&] { (void)found.zones(-1); }), "query: margin: must be in [0, 1e30]");
}

} // namespace
} // namespace chasles::test
