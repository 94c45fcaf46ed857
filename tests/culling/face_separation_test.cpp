// Directions between faces: they separate what they say, and are found where faces are farther apart than asked.
#include "chasles/culling/face_separation.h"

#include "chasles/motion/any_trajectory.h"
#include "tests/query/bodies.h"
#include "tests/support/surface_distance.h"

#include <gtest/gtest.h>

namespace chasles::culling {
namespace {

using test::random_vector;
using test::uniform;

/// A long triangle of any shape.
test::Body random_triangle(std::mt19937& random) {
    const Eigen::Vector3d corner = random_vector(random, 1);
    const Eigen::Vector3d along = random_vector(random, uniform(random, 0.1, 5));
    return test::triangle(corner, corner + along, corner + uniform(random, 0, 1) * along + random_vector(random, 0.2));
}

Eigen::Vector3d eigen(const Vector3<double>& v) {
    return {v.x, v.y, v.z};
}

IntervalEnds at_rest(const Eigen::Isometry3d& pose) {
    MatrixPose matrix;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            matrix.rotation.row[i][j] = pose(i, j);
        matrix.translation[i] = pose(i, 3);
    }
    return IntervalEnds(matrix);
}

/// How far two triangles are apart along a direction; negative where they are not.
double gap_along(const Eigen::Vector3d& direction, const test::Vertices& moved, const test::Vertices& fixed) {
    double nearest = 1e300, farthest = -1e300;
    for (const Eigen::Vector3d& v : moved)
        nearest = std::min(nearest, direction.normalized().dot(v));
    for (const Eigen::Vector3d& v : fixed)
        farthest = std::max(farthest, direction.normalized().dot(v));
    return nearest - farthest;
}

TEST(FaceSeparation, ADirectionKeepsTheFacesApartByTheDistance) {
    std::mt19937 random(2);
    int apart = 0, found = 0;
    for (int i = 0; i < 3000; ++i) {
        const test::Body moving = random_triangle(random);
        const test::Body fixed = random_triangle(random);
        const Polyhedron mover = moving.polyhedron();
        const Polyhedron target = fixed.polyhedron();
        const Eigen::Isometry3d pose = test::random_pose(random, 2, 3).isometry();
        test::Vertices moved;
        for (const Eigen::Vector3d& v : moving.vertices)
            moved.emplace_back(pose * v);
        const test::Triangle3<double> a{moved[0], moved[1], moved[2]};
        const test::Triangle3<double> b{fixed.vertices[0], fixed.vertices[1], fixed.vertices[2]};
        const double distance = std::sqrt(test::squared_distance_of_triangles<double>(a, b));
        FaceSeparation separation(mover.body(), target.body());
        separation.use(at_rest(pose));
        const double asked = uniform(random, 0, 1.5) * distance;
        const auto direction = separation.direction(0, 0, 0.5, asked);
        apart += asked < 0.9 * distance ? 1 : 0;
        found += direction && asked < 0.9 * distance ? 1 : 0;
        if (direction) {
            EXPECT_GT(gap_along(eigen(*direction), moved, fixed.vertices), asked - 1e-12) << i;
        }
    }
    EXPECT_GT(apart, 1500);
    EXPECT_GT(found, 0.95 * apart);
}

/// Beyond the distance where the faces are clearly that far apart.
TEST(FaceSeparation, ADirectionBeyondADistanceIsFoundWhereTheFacesAre) {
    std::mt19937 random(4);
    int beyond = 0, apart = 0;
    for (int i = 0; i < 3000; ++i) {
        const test::Body moving = random_triangle(random);
        const test::Body fixed = random_triangle(random);
        const Polyhedron mover = moving.polyhedron();
        const Polyhedron target = fixed.polyhedron();
        const Eigen::Isometry3d pose = test::random_pose(random, 2, 3).isometry();
        test::Vertices moved;
        for (const Eigen::Vector3d& v : moving.vertices)
            moved.emplace_back(pose * v);
        const test::Triangle3<double> a{moved[0], moved[1], moved[2]};
        const test::Triangle3<double> b{fixed.vertices[0], fixed.vertices[1], fixed.vertices[2]};
        const double distance = std::sqrt(test::squared_distance_of_triangles<double>(a, b));
        FaceSeparation separation(mover.body(), target.body());
        separation.use(at_rest(pose));
        const double asked = uniform(random, 0, 2) * distance;
        const auto direction = separation.beyond(0, 0, 0.5, asked);
        const double gap = direction ? gap_along(eigen(*direction), moved, fixed.vertices) : 0;
        if (direction) {
            EXPECT_NEAR(length(*direction), 1, 1e-14);
            EXPECT_GT(gap, 0);
        }
        apart += asked < 0.9 * distance ? 1 : 0;
        beyond += asked < 0.9 * distance && gap > asked ? 1 : 0;
    }
    EXPECT_GT(apart, 1000);
    EXPECT_GT(beyond, 0.9 * apart);
}

/// The axis of the widest gap gives the same direction again, and still separates when the body has moved a little.
TEST(FaceSeparation, AnAxisIsFoundAgainWhereTheFacesAreThen) {
    std::mt19937 random(5);
    int axes = 0, still_apart = 0;
    for (int i = 0; i < 3000; ++i) {
        const test::Body moving = random_triangle(random), fixed = random_triangle(random);
        const Polyhedron mover = moving.polyhedron(), target = fixed.polyhedron();
        FaceSeparation separation(mover.body(), target.body());
        const Eigen::Isometry3d pose = test::random_pose(random, 2, 3).isometry();
        separation.use(at_rest(pose));
        const auto widest = separation.widest(0, 0, 0.5);
        if (!widest || widest->axis == FaceSeparation::no_axis)
            continue;
        ++axes;
        const auto again = separation.along(widest->axis, 0, 0, 0.5);
        ASSERT_TRUE(again);
        EXPECT_EQ(eigen(*again), eigen(widest->along));

        const Eigen::Isometry3d later =
            pose * test::turned(random_vector(random, 0.05), {0.6, 0, 0.8}, uniform(random, -0.05, 0.05)).isometry();
        separation.use(at_rest(later));
        const auto direction = separation.along(widest->axis, 0, 0, 0.5);
        if (!direction)
            continue;
        ++still_apart;
        test::Vertices moved;
        for (const Eigen::Vector3d& v : moving.vertices)
            moved.emplace_back(later * v);
        EXPECT_NEAR(length(*direction), 1, 1e-14);
        EXPECT_GT(gap_along(eigen(*direction), moved, fixed.vertices), 0);
    }
    EXPECT_GT(axes, 500);
    EXPECT_GT(still_apart, 0.8 * axes);
}

TEST(FaceSeparation, FindsNothingBetweenFacesThatCross) {
    const Polyhedron a = test::triangle({-1, 0, -1}, {1, 0, -1}, {0, 0, 2}).polyhedron();
    const Polyhedron b = test::triangle({-1, -1, 0}, {1, -1, 0}, {0, 2, 0}).polyhedron();
    FaceSeparation separation(a.body(), b.body());
    separation.use(at_rest(Eigen::Isometry3d::Identity()));
    EXPECT_FALSE(separation.direction(0, 0, 0, 0));
}

/// The time counts within the interval of the maps.
TEST(FaceSeparation, IsAskedAtATimeOfTheInterval) {
    const Polyhedron a = test::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).polyhedron();
    const Motion motion = ScrewMotion::between(test::shifted(0, 0, 0), test::shifted(0, 0, 2));
    const auto piece = motion.trajectory().pieces()->at(0);
    const auto maps = motion::double_maps(piece->cubic());
    FaceSeparation separation(a.body(), a.body());
    separation.use(IntervalEnds(maps));
    EXPECT_FALSE(separation.direction(0, 0, 0.2, 0.5));
    EXPECT_TRUE(separation.direction(0, 0, 0.3, 0.5));
}

} // namespace
} // namespace chasles::culling
