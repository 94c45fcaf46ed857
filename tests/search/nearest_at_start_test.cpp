// The features that are nearest at the start, against the distance of all triangles.
#include "chasles/search/nearest_at_start.h"

#include "chasles/search/piece_search.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/search/bodies_in_motion.h"
#include "tests/support/grid.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::search {
namespace {

using test::BodiesInMotion;
using test::uniform;

TEST(NearestAtStart, IsWithinTheMarginWhereTheSurfacesAre) {
    std::mt19937 random(17);
    int apart = 0;
    for (int i = 0; i < 300; ++i) {
        const Pose start = test::random_pose(random, 4, 3);
        BodiesInMotion scene{test::random_octahedron(random).polyhedron(), test::random_octahedron(random).polyhedron(),
                             ScrewMotion::between(start, test::random_pose(random, 4, 2))};
        const double distance = test::distance_at(scene.moving, scene.fixed, start);
        if (distance <= 0)
            continue; // where surfaces cross, features may be apart
        ++apart;
        Work work;
        EXPECT_TRUE(nearest_at_start(scene.context, 0.999 * distance, work).empty());
        const std::vector<contact::FeaturePair> found = nearest_at_start(scene.context, 1.5 * distance, work);
        ASSERT_FALSE(found.empty());
        for (const contact::FeaturePair& features : found) {
            const double apart_by = scene.at(0).nearest(features).apart().norm();
            EXPECT_GE(apart_by, distance - 1e-12) << i;
            EXPECT_LE(apart_by, 1.5 * distance + 1e-12) << i;
        }
    }
    EXPECT_GT(apart, 150);
}

/// A rough ring of slender triangles.
Polyhedron rough_ring(std::mt19937& random) {
    constexpr std::uint32_t count = 500;
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::vector<std::uint32_t>> triangles;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        for (const double radius : {0.1, 1.0})
            vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), uniform(random, -0.01, 0.01));
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % count);
        triangles.push_back({a, a + 1, b + 1});
        triangles.push_back({a, b + 1, b});
    }
    return Polyhedron::from_polygons(vertices, triangles);
}

/// Boxes around slender triangles tell little: without the search for what is nearest, this takes more than 9,000 pairs
/// of faces.
TEST(NearestAtStart, EndsALongSearch) {
    std::mt19937 random(5);
    const Polyhedron ring = rough_ring(random);
    Pose start, goal;
    for (int i = 0; i < 5; ++i) {
        start = test::random_pose(random, 2, 3);
        goal = test::random_pose(random, 2, 3);
    }
    BodiesInMotion scene{ring, ring, ScrewMotion::between(start, goal)};
    const PieceResult found = search_piece(scene.context, {.margin = 1.1 * test::distance_at(ring, ring, start)});
    ASSERT_FALSE(found.candidates.empty());
    EXPECT_EQ(found.candidates[0].tau.upper, 0);
    EXPECT_TRUE(found.candidates[0].tau.certain);
    EXPECT_LT(found.work.face_pairs, 6000U);
}

} // namespace
} // namespace chasles::search
