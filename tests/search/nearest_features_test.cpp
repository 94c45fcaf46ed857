// The nearest features at rest against the distance of all triangles.
#include "chasles/search/nearest_features.h"

#include "chasles/search/descent.h"
#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/search/bodies_in_motion.h"

#include <gtest/gtest.h>

namespace chasles::search {
namespace {

using test::BodiesInMotion;
using test::random_vector;
using test::uniform;

double distance_at(const BodiesInMotion& scene, double tau) {
    return test::distance_at(scene.moving, scene.fixed, scene.context.piece().pose_at(tau));
}

BodiesInMotion random_scene(std::mt19937& random) {
    const auto body = [&] {
        test::Body shape = test::random_octahedron(random);
        const double stretch = uniform(random, 0.1, 4);
        for (Eigen::Vector3d& v : shape.vertices)
            v.x() *= stretch;
        return shape.polyhedron();
    };
    const Pose start = test::random_pose(random, 4, 3);
    return {body(), body(), ScrewMotion::between(start, test::random_pose(random, 4, 2))};
}

TEST(NearestFeatures, AreAtTheDistanceOfTheSurfaces) {
    std::mt19937 random(9);
    int apart = 0;
    for (int i = 0; i < 400; ++i) {
        const BodiesInMotion scene = random_scene(random);
        const double tau = uniform(random, 0, 1);
        const double distance = distance_at(scene, tau);
        if (distance <= 0)
            continue; // where surfaces cross, features may be apart
        ++apart;
        Work work;
        const auto found = nearest_features(scene.at(tau), {1e300, 1}, work);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->distance, distance, 1e-12) << i;
        EXPECT_GT(work.node_pairs, 0u);
        EXPECT_FALSE(nearest_features(scene.at(tau), {0.999 * distance, 1}, work));
        EXPECT_TRUE(nearest_features(scene.at(tau), {1.001 * distance, 1}, work));
        const auto rough = nearest_features(scene.at(tau), {1e300, 0.5}, work);
        ASSERT_TRUE(rough);
        EXPECT_LE(rough->distance, 2 * distance * (1 + 1e-9));
        EXPECT_GE(rough->distance, distance - 1e-12);
    }
    EXPECT_GT(apart, 200);
}

/// Also where the foot of a vertex is outside the face: no point of the face is nearer than the rim.
TEST(NearestFeatures, PointsAreOnTheFeatures) {
    std::mt19937 random(4);
    for (int i = 0; i < 300; ++i) {
        const test::Body face =
            test::triangle(random_vector(random, 1), random_vector(random, 1), random_vector(random, 1));
        const BodiesInMotion scene{test::random_octahedron(random).polyhedron(), face.polyhedron(),
                                   ScrewMotion::between(test::random_pose(random, 2, 3), Pose())};
        const contact::RelativeConfiguration bodies = scene.at(0);
        NearestAtRest nearest;
        for (std::uint32_t vertex = 0; vertex < 6; ++vertex) {
            const contact::FeaturePair pair{ContactKind::vertex_face, {vertex, vertex}, {0, 0}};
            const Eigen::Vector3d point = bodies.moved(scene.moving.vertices()[vertex]);
            const test::Triangle3<double> at_point{point, point, point};
            const test::Triangle3<double> triangle{face.vertices[0], face.vertices[1], face.vertices[2]};
            const double distance = std::sqrt(test::squared_distance_of_triangles<double>(at_point, triangle));
            EXPECT_NEAR(nearest.points(bodies, pair).distance, distance, 1e-9 * (1 + distance)) << i;
        }
    }
}

TEST(Descent, EndsWhereTheDistanceIsLeastNearby) {
    std::mt19937 random(21);
    int inside = 0;
    for (int i = 0; i < 600; ++i) {
        const BodiesInMotion scene = random_scene(random);
        const double tau = uniform(random, 0, 1);
        Work work;
        const auto near = nearest_features(scene.at(tau), {1e300, 1}, work);
        ASSERT_TRUE(near);
        const NearMoment found = local_minimum(scene.context, tau, near->features, work);
        EXPECT_LE(found.near.distance, near->distance);
        if (distance_at(scene, found.tau) <= 1e-9)
            continue;
        EXPECT_NEAR(found.near.distance, distance_at(scene, found.tau), 1e-12);
        for (const double beside : {found.tau - 1e-4, found.tau + 1e-4})
            if (beside >= 0 && beside <= 1) {
                EXPECT_GE(distance_at(scene, beside), found.near.distance * (1 - 1e-9)) << i;
            }
        inside += found.tau > 0 && found.tau < 1 ? 1 : 0;
    }
    EXPECT_GT(inside, 20);
}

TEST(Descent, SamplesFindTheNearerEnd) {
    const Polyhedron cube = test::box({1, 1, 1}).polyhedron();
    const BodiesInMotion scene{cube, cube, ScrewMotion::between(test::shifted(9, 0, 0), test::shifted(4, 0, 0))};
    Work work;
    const auto near = nearest_of_samples(scene.context, 1e300, work);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->tau, 1);
    EXPECT_NEAR(near->near.distance, 2, 1e-12);
    EXPECT_FALSE(nearest_of_samples(scene.context, 1.9, work));
}

} // namespace
} // namespace chasles::search
