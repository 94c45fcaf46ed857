// Pairs that may meet on a helix against the distances of all pairs of triangles at sampled times.
#include "chasles/memory/orbit_pairs.h"

#include "chasles/culling/body_ball.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/motion.h"
#include "scenes/nut_motions.h"
#include "scenes/threaded_fastener.h"
#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"
#include "tests/support/surface_distance.h"

#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace chasles::memory {
namespace {

using culling::ball_around;
using culling::NodePair;
using culling::Window;
using Eigen::Vector3d;
using test::uniform;

constexpr std::size_t no_limit = 1 << 30;

struct Trees {
    motion::Orbit orbit;
    OrbitTree moving;
    OrbitTree fixed;

    Trees(const motion::Orbit& of, const Polyhedron& a, const Polyhedron& b)
        : orbit(of), moving(a.body(), of.moving, of.pitch), fixed(b.body(), of.fixed, of.pitch) {}
};

using Faces = std::pair<std::uint32_t, std::uint32_t>;

std::multimap<Faces, Window> pairs_of(const Trees& trees, const motion::Orbit& orbit, const Polyhedron& a,
                                      const Polyhedron& b, double margin) {
    const OrbitWay way = way_along(orbit, trees.orbit, ball_around(a.body().bvh()), margin);
    std::uint64_t tests = 0;
    const auto found = orbit_pairs(trees.moving, trees.fixed, way, no_limit, tests);
    EXPECT_GT(tests, 0U);
    std::multimap<Faces, Window> pairs;
    for (const NodePair& pair : found.value())
        pairs.insert({{std::uint32_t(a.body().bvh().nodes()[pair.moving].first),
                       std::uint32_t(b.body().bvh().nodes()[pair.fixed].first)},
                      pair.when});
    return pairs;
}

test::Triangle3<double> triangle_at(const Polyhedron& shape, std::uint32_t face, const Pose& pose) {
    const auto corners = shape.body().face(face);
    const auto point = [&](std::size_t i) {
        return test::Point3<double>(pose.isometry() * shape.body().vertices()[corners[i]]);
    };
    return {point(0), point(1), point(2)};
}

/// Two rings of triangles, in each other's way.
struct Rings {
    Polyhedron moving = ring(15, 7);
    Polyhedron fixed = ring(16, 6);

    static Polyhedron ring(std::uint32_t around, std::uint32_t across) {
        const test::Soup soup = test::torus(around, across);
        std::vector<std::vector<std::uint32_t>> triangles;
        for (const auto& face : soup.faces)
            for (std::size_t i = 2; i < face.size(); ++i)
                triangles.push_back({face[0], face[i - 1], face[i]});
        return Polyhedron::from_polygons(soup.vertices, triangles);
    }
};

/// Returns how many pairs were near.
int expect_what_is_near(const Rings& rings, const motion::AnyPiece& piece, const std::multimap<Faces, Window>& pairs,
                        double margin) {
    int near = 0;
    for (const double tau : {0.0, 0.1, 0.45, 0.8, 1.0})
        for (std::uint32_t f = 0; f < rings.moving.face_count(); ++f)
            for (std::uint32_t g = 0; g < rings.fixed.face_count(); ++g) {
                const auto a = triangle_at(rings.moving, f, piece.pose_at(tau));
                const auto b = triangle_at(rings.fixed, g, piece.fixed_pose_at(tau));
                if (test::squared_distance_of_triangles<double>(a, b) > margin * margin * (1 - 1e-9))
                    continue;
                ++near;
                const auto [first, last] = pairs.equal_range({f, g});
                EXPECT_TRUE(
                    std::any_of(first, last,
                                [&](const auto& pair) { return pair.second.lower <= tau && tau <= pair.second.upper; }))
                    << "faces " << f << ", " << g << " at tau " << tau;
            }
    return near;
}

TEST(OrbitPairs, HoldAllThatComesNear) {
    const Rings rings;
    std::mt19937 random(11);
    int near = 0;
    std::size_t listed = 0, all = 0;
    for (int i = 0; i < 12; ++i) {
        const Pose start = test::turned({1.3, 0.1 * (i % 5), 0}, Vector3d::UnitX(), 1.5);
        const Pose goal = test::composed(start, test::random_pose(random, 0.3, i % 2 == 0 ? 0.5 : 3));
        const Motion motion = i % 3 == 0 ? Motion(SweepMotion::between(start, goal, Vector3d::Zero()))
                                         : Motion(ScrewMotion::between(start, goal, std::numbers::pi));
        const auto piece = motion.trajectory().pieces()->at(0);
        const double margin = i % 4 == 0 ? 0.05 : 1e-9;
        const auto orbit = motion::orbit_of(piece->cubic(), 1);
        ASSERT_TRUE(orbit);
        const auto pairs =
            pairs_of(Trees(*orbit, rings.moving, rings.fixed), *orbit, rings.moving, rings.fixed, margin);
        near += expect_what_is_near(rings, *piece, pairs, margin);
        listed += pairs.size();
        all += rings.moving.face_count() * rings.fixed.face_count();
    }
    EXPECT_GT(near, 500);
    EXPECT_LT(listed, all / 3);
}

/// Later pieces on nearly the same axis, in both directions, with the trees of the first one.
TEST(OrbitPairs, HoldAllThatComesNearOnAnotherTurnAboutTheAxis) {
    const Rings rings;
    std::mt19937 random(12);
    int near = 0;
    for (int i = 0; i < 10; ++i) {
        const Vector3d along = test::random_vector(random, 1).normalized();
        const Vector3d through = test::random_vector(random, 1);
        const double pitch = uniform(random, -0.2, 0.2);
        const Pose home = test::turned({1.3, 0, 0}, Vector3d::UnitX(), 1.5);
        const auto at = [&](double turn) {
            const Eigen::AngleAxisd about(turn, along);
            const Pose screw{through - about * through + pitch * turn * along, Eigen::Quaterniond(about)};
            return test::composed(screw, home);
        };
        const auto screw = [&](double from, double to) {
            const Motion way = ScrewMotion::between(at(from), at(to), std::numbers::pi);
            return way.trajectory().pieces()->at(0);
        };
        const auto first = motion::orbit_of(screw(0, 0.2)->cubic(), 1);
        const Trees trees(first.value(), rings.moving, rings.fixed);
        const double from = uniform(random, -3, 3);
        const auto piece = screw(from, from + (i % 2 == 0 ? 1 : -1) * uniform(random, 0.1, 0.5));
        const auto orbit = motion::orbit_of(piece->cubic(), 1);
        const OrbitWay way = way_along(*orbit, trees.orbit, ball_around(rings.moving.body().bvh()), 0);
        EXPECT_LT(way.reach, orbit->deviation + 1e-9);
        near += expect_what_is_near(rings, *piece, pairs_of(trees, *orbit, rings.moving, rings.fixed, 0.02), 0.02);
    }
    EXPECT_GT(near, 100);
}

/// The trees of an axis that is a little off: the reach makes up for it.
TEST(OrbitPairs, ReachAsFarAsTheAxesAreApart) {
    const Rings rings;
    std::mt19937 random(13);
    int near = 0;
    for (int i = 0; i < 10; ++i) {
        const Pose start = test::turned({1.3, 0, 0}, Vector3d::UnitX(), 1.5);
        const Pose goal = test::composed(start, test::random_pose(random, 0.3, 1));
        const Pose other = test::composed(goal, test::random_pose(random, 0.01, 0.01));
        const auto piece_to = [&](const Pose& end) {
            const Motion way = ScrewMotion::between(start, end, std::numbers::pi);
            return way.trajectory().pieces()->at(0);
        };
        const Trees trees(motion::orbit_of(piece_to(other)->cubic(), 1).value(), rings.moving, rings.fixed);
        const auto piece = piece_to(goal);
        const auto orbit = motion::orbit_of(piece->cubic(), 1);
        near += expect_what_is_near(rings, *piece, pairs_of(trees, *orbit, rings.moving, rings.fixed, 0), 1e-12);
    }
    EXPECT_GT(near, 30);
}

/// The trees of a body that starts elsewhere on the same axis: likewise.
TEST(OrbitPairs, ReachAsFarAsTheBodiesAreApartAtTheStart) {
    const Rings rings;
    const Pose start = test::turned({1.3, 0, 0}, Vector3d::UnitX(), 1.5);
    std::mt19937 random(14);
    int near = 0;
    for (int i = 0; i < 10; ++i) {
        const Pose screw = test::random_pose(random, 0.3, 1);
        const auto piece_from = [&](const Pose& from) {
            const Motion way = ScrewMotion::between(from, test::composed(screw, from), std::numbers::pi);
            return way.trajectory().pieces()->at(0);
        };
        Pose shifted = start;
        shifted.translation += test::random_vector(random, 1).normalized() * 0.05;
        const Trees trees(motion::orbit_of(piece_from(shifted)->cubic(), 1).value(), rings.moving, rings.fixed);
        const auto piece = piece_from(start);
        const auto orbit = motion::orbit_of(piece->cubic(), 1);
        near += expect_what_is_near(rings, *piece, pairs_of(trees, *orbit, rings.moving, rings.fixed, 0), 1e-12);
    }
    EXPECT_GT(near, 30);
}

/// In the plane x = 1 the image of a slender rectangle is an arc, off the line between its ends towards the axis and
/// downwards.
TEST(OrbitPairs, HoldWhatIsBetweenTheCornersOfAPolygon) {
    const auto slender = [](double from, double to) {
        const double height = 1e-5;
        const std::vector<Vector3d> corners{{1, from, 0}, {1, to, 0}, {1, to, height}, {1, from, height}};
        return Polyhedron::from_polygons(corners, std::vector<std::vector<std::uint32_t>>{{0, 1, 2, 3}});
    };
    const Polyhedron rectangle = slender(0.45, 0.55);
    const Polyhedron middle = slender(0.49999, 0.50001);
    for (const double pitch : {-1.0, 0.0, 1.0}) {
        const motion::AxisFrame axis{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const motion::Orbit orbit{.start = {algebra::identity_matrix<double>(), {}},
                                  .moving = axis,
                                  .fixed = axis,
                                  .pitch = pitch,
                                  .turn = 0.001};
        EXPECT_EQ(pairs_of(Trees(orbit, rectangle, middle), orbit, rectangle, middle, 0).size(), 1U) << pitch;
        EXPECT_EQ(pairs_of(Trees(orbit, middle, rectangle), orbit, middle, rectangle, 0).size(), 1U) << pitch;
    }
}

TEST(OrbitPairs, HardlyAnythingOfANutMeetsItsBoltOnTheThread) {
    const scenes::ThreadedFastener fastener;
    const Polyhedron nut = scenes::nut(fastener);
    const Polyhedron bolt = scenes::bolt(fastener);
    const Pose start = scenes::nut_pose({.height = 10}, 0);
    const Motion turn = ScrewMotion::between(start, scenes::nut_pose({.height = 10}, 1.0 / 36));
    const auto orbit = motion::orbit_of(turn.trajectory().pieces()->at(0)->cubic(), 1);
    ASSERT_TRUE(orbit);
    const Trees trees(*orbit, nut, bolt);
    EXPECT_LT(pairs_of(trees, *orbit, nut, bolt, 0).size(), nut.face_count() * bolt.face_count() / 10000);
    const OrbitWay way = way_along(*orbit, *orbit, ball_around(nut.body().bvh()), 0);
    std::uint64_t tests = 0;
    EXPECT_FALSE(orbit_pairs(trees.moving, trees.fixed, way, 10, tests));
    EXPECT_EQ(tests, 11U);
}

} // namespace
} // namespace chasles::memory
