// A face's normal, its size, and the bound on the distance of its corners from one plane.
#include "chasles/elementary/face_shape.h"

#include "tests/support/elementary_cases.h"

#include <gtest/gtest.h>

namespace chasles::elementary {
namespace {

using namespace test;

void expect_equal(const Point& a, const Point& b) {
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(a[i], b[i]) << "component " << i;
}

/// Newell's sum over the edges, about the origin.
Point newell_normal(const Points& corners) {
    Point normal;
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal = normal + cross(corners[i], corners[(i + 1) % corners.size()]);
    return normal;
}

Point random_place(Random& random) {
    const int x = random.integer(-9, 9);
    const int y = random.integer(-9, 9);
    return point(x, y, random.integer(-9, 9));
}

TEST(FaceShape, NormalIsNewellsSum) {
    Random random(741);
    for (int trial = 0; trial < 50; ++trial) {
        Points corners;
        for (int i = random.integer(3, 7); i > 0; --i)
            corners.push_back(random_place(random));
        expect_equal(face_shape<Rational>(corners, {}).normal, newell_normal(corners));
    }
}

TEST(FaceShape, NormalPointsWhereTheOutlineRunsCounterClockwise) {
    const Points square{point(0, 0, 0), point(1, 0, 0), point(1, 1, 0), point(0, 1, 0)};
    expect_equal(face_shape<Rational>(square, {}).normal, point(0, 0, 2));
    const Points bent_bar{point(0, 0, 0), point(3, 0, 0), point(3, 1, 0),
                          point(1, 1, 0), point(1, 3, 0), point(0, 3, 0)};
    expect_equal(face_shape<Rational>(bent_bar, {}).normal, point(0, 0, 10));
}

TEST(FaceShape, SizeIsAtLeastTheNormal) {
    Random random(742);
    for (int trial = 0; trial < 100; ++trial) {
        Points corners;
        for (int i = random.integer(3, 7); i > 0; --i)
            corners.push_back(random_place(random));
        const auto face = face_shape<Rational>(corners, {});
        EXPECT_GE(face.size, norm1(face.normal));
    }
}

TEST(FaceShape, TriangleHasNoDeviation) {
    const Points corners{point(0, 0, 0), point(1, 2, 3), point(3, 1, 5)};
    EXPECT_EQ(face_shape<Rational>(corners, {}).deviation, 0);
    EXPECT_EQ(face_shape<double>(corners_in<double>(corners), {}).deviation, 0);
}

TEST(FaceShape, DeviationCoversEveryCorner) {
    Random random(743);
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<Vector3<double>> corners;
        for (int i = 0; i < 5; ++i) {
            const Vector3<double> flat = random.vector(1);
            corners.push_back({flat.x, flat.y, 1 + 1e-12 * flat.z});
        }
        const auto face = face_shape<double>(corners, {});
        for (const auto& corner : corners) {
            const Point arm = test::exact(corner) - test::exact(corners[0]);
            EXPECT_LE(test::magnitude(dot(test::exact(face.normal), arm)), Rational(face.deviation));
        }
    }
}

TEST(FaceShape, PlanarPolygonOfRationalsHasNoDeviation) {
    const Points corners{point(0, 0, 0), point(2, 0, 2), point(2, 2, 4), point(0, 2, 2)};
    EXPECT_EQ(face_shape<Rational>(corners, {}).deviation, 0);
}

} // namespace
} // namespace chasles::elementary
