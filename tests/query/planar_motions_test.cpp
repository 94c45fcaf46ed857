// Plates that slide over each other in parallel planes, on motions that are only enclosed: the heights over the planes
// are known, however small the gap is. Note 36.
#include "chasles/base/limit.h"
#include "chasles/chasles.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

/// A regular prism, 0.25 high above the plane z = bottom, turned with all its corners.
Polyhedron plate(std::uint32_t corners, const Eigen::Quaterniond& turn, double bottom = 0) {
    std::vector<Vector3d> vertices;
    std::vector<std::vector<std::uint32_t>> faces(2);
    for (const double z : {bottom, bottom + 0.25})
        for (std::uint32_t i = 0; i < corners; ++i) {
            const double angle = 2 * std::numbers::pi * i / corners;
            vertices.push_back(turn * Vector3d(std::cos(angle), std::sin(angle), z));
        }
    for (std::uint32_t i = 0; i < corners; ++i) {
        const std::uint32_t next = (i + 1) % corners;
        faces[0].push_back(corners - 1 - i);
        faces[1].push_back(corners + i);
        faces.push_back({i, next, corners + next, corners + i});
    }
    return Polyhedron::from_polygons(vertices, faces);
}

/// Two plates, one on the other, and the direction of the way from one to the other.
struct Plates {
    Polyhedron moving, fixed;
    Vector3d up, beside;

    Plates(Random& random, bool is_tilted)
        : Plates(is_tilted ? random_pose(random, 1).rotation.normalized() : Eigen::Quaterniond::Identity(),
                 std::uint32_t(random.integer(5, 20)), std::uint32_t(random.integer(5, 20))) {}

private:
    Plates(const Eigen::Quaterniond& turn, std::uint32_t first, std::uint32_t second)
        : moving(plate(first, turn)), fixed(plate(second, turn)), up(turn * Vector3d::UnitZ()),
          beside(turn * Vector3d::UnitX()) {}
};

/// A turn and a way across the axis, which is no turn about one axis, at the heights that a polynomial gives.
Motion sliding(Random& random, const Plates& plates, const std::vector<double>& heights) {
    const auto turn = [&] { return Motion::hinge(Vector3d::Zero(), plates.up, {0, random.uniform(-1.5, 1.5)}); };
    const Motion across = Motion::slider(plates.beside, {0, random.uniform(-0.5, 0.5)});
    const Motion moving = turn() * across * Motion::slider(plates.up, heights);
    return random.chance(0.5) ? moving : relative(moving, turn());
}

FirstContact ask(const Plates& plates, const Motion& motion, double margin) {
    return first_contact(
        {.moving = plates.moving, .fixed = plates.fixed, .motion = motion, .options = {.margin = margin}});
}

TEST(PlanarMotions, PlatesThatSlideAtATinyGapAreClearAtOnce) {
    Random random(3621);
    std::uint64_t most = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const bool is_tilted = random.chance(0.5);
        const Plates plates(random, is_tilted);
        const double margin = random.chance(0.5) ? 0 : 0.125,
                     gap = std::pow(10, random.uniform(is_tilted ? -9 : -11, 0));
        const FirstContact found = ask(plates, sliding(random, plates, {0.25 + margin + gap}), margin);
        EXPECT_EQ(found.verdict, Verdict::clear) << gap << " beyond " << margin;
        most = std::max(most, found.work.elementary_tests);
    }
    std::cout << "at most " << most << " elementary tests\n";
    EXPECT_LT(most, 20000U) << "each pair of features is told apart in few parts";
}

/// The upper plate's bottom is at the gap, the lower one's top at 0. Double-double tells them apart at once: before it
/// knew the axis, each pair of features divided the motion into as many parts as the gap is small.
TEST(PlanarMotions, PlatesThatSlideEvenlyAreClearAtGapsFarBelowRounding) {
    Random random(3624);
    const Polyhedron upper = plate(12, Eigen::Quaterniond::Identity());
    const Polyhedron lower = plate(9, Eigen::Quaterniond::Identity(), -0.25);
    for (int trial = 0; trial < 12; ++trial) {
        const double gap = std::pow(10, random.uniform(-24, -16));
        const auto pose = [&] {
            const Vector3d place(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), gap);
            return turned(place, Vector3d::UnitZ(), random.uniform(0, 1.5));
        };
        const Motion track = TimedPoses::through({0, 0.4, 1}, {pose(), pose(), pose()});
        for (const Motion& motion :
             {Motion::velocity(pose(), pose(), random_point(random, 1)), track, track.reversed()}) {
            const Limit limit(10); // seconds, of which a hundredth is enough
            const FirstContact found = first_contact({.moving = upper, .fixed = lower, .motion = motion});
            EXPECT_EQ(found.verdict, Verdict::clear) << gap;
        }
    }
}

/// Both overlap, seen along the axis, whatever the turn is.
TEST(PlanarMotions, PlatesThatComeDownTouchWhenTheirHeightsMeet) {
    Random random(3622);
    int certain = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Plates plates(random, random.chance(0.5));
        const double margin = random.chance(0.5) ? 0 : 0.125, gap = std::pow(10, random.uniform(-4, 0));
        const double time = random.uniform(0.1, 0.9);
        const FirstContact found = ask(plates, sliding(random, plates, {0.25 + margin + gap, -gap / time}), margin);
        ASSERT_EQ(found.verdict, Verdict::contact) << gap << " beyond " << margin;
        const double rounding = 1e-14 * time / gap;
        EXPECT_LE(found.time.lower, time + rounding);
        EXPECT_GE(found.time.upper, time - rounding);
        EXPECT_LE(found.time.upper - found.time.lower, 1e-9 + 4 * rounding);
        certain += found.certain ? 1 : 0;
    }
    EXPECT_GT(certain, 190);
}

/// The lower cube's top and the upper one's bottom meet at 2/3 of the time, from where on the upper one stands still.
/// It comes down as the cube of the time left, and turns until then.
TEST(PlanarMotions, ASplineThatStopsAtTouchIsFollowedToTheStop) {
    const Polyhedron cube = make_box({1, 1, 1});
    const auto lands = [&](double gap) {
        const auto pose = [&](double x, double z, double turn) {
            return turned({x, 0, z + gap}, Vector3d::UnitZ(), turn);
        };
        const Pose goal = pose(0, 1, 0);
        const Motion motion = Motion::b_spline({pose(0.3, 2, 0.5), pose(0.2, 1.5, 0.2), goal, goal, goal});
        return first_contact({.moving = cube, .fixed = cube, .motion = motion});
    };
    const FirstContact touch = lands(0);
    EXPECT_EQ(touch.verdict, Verdict::contact);
    EXPECT_GT(touch.time.lower, 2.0 / 3 - 1e-8);
    EXPECT_LE(touch.time.lower, 2.0 / 3);
    for (const double gap : {1e-15, 1e-12}) {
        const FirstContact clear = lands(gap);
        EXPECT_EQ(clear.verdict, Verdict::clear) << gap;
        EXPECT_TRUE(clear.certain) << gap;
    }
}

} // namespace
} // namespace chasles::test
