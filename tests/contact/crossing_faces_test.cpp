// Faces that pass through each other, against exact rationals: the ends of the common segment of two triangles, and
// whether its middle is inside both.
#include "chasles/contact/crossing_faces.h"

#include "chasles/motion/any_trajectory.h"
#include "tests/query/bodies.h"
#include "tests/support/random.h"
#include "tests/support/rational.h"

#include <array>
#include <gtest/gtest.h>

namespace chasles::contact {
namespace {

using test::Rational;
using Point = algebra::Vector3<Rational>;
using Corners = std::array<Eigen::Vector3d, 3>;
using ExactCorners = std::array<Point, 3>;

ExactCorners exact(const Corners& corners) {
    const auto point = [](const Eigen::Vector3d& v) {
        return Point{Rational(v.x()), Rational(v.y()), Rational(v.z())};
    };
    return {point(corners[0]), point(corners[1]), point(corners[2])};
}

Point normal_of(const ExactCorners& t) {
    return cross(t[1] - t[0], t[2] - t[0]);
}

/// 1 inside of the outline, 0 on it, -1 outside, for a point in the plane.
int place_in(const ExactCorners& t, const Point& point) {
    int place = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point side = t[(i + 1) % 3] - t[i];
        const Rational height = dot(cross(normal_of(t), side), point - t[i]);
        place = std::min(place, height > 0 ? 1 : height < 0 ? -1 : 0);
    }
    return place;
}

/// Adds the points at which sides of one triangle come through the plane of the other one, within it.
void add_points(const ExactCorners& a, const ExactCorners& b, std::vector<Point>& points) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Point from = a[i], way = a[(i + 1) % 3] - from;
        const Rational height = dot(normal_of(b), from - b[0]), slope = dot(normal_of(b), way);
        if (slope == 0)
            continue;
        const Rational share = -height / slope;
        if (share < 0 || share > 1)
            continue;
        const Point point = from + scale(way, share);
        if (place_in(b, point) >= 0)
            points.push_back(point);
    }
}

bool are_crossing_exactly(const ExactCorners& a, const ExactCorners& b) {
    std::vector<Point> points;
    add_points(a, b, points);
    add_points(b, a, points);
    if (points.empty())
        return false;
    Point sum = points[0];
    for (std::size_t i = 1; i < points.size(); ++i)
        sum = sum + points[i];
    const Point middle = scale(sum, Rational(1) / Rational(int(points.size())));
    return place_in(a, middle) > 0 && place_in(b, middle) > 0;
}

bool are_crossing_in_double(const Corners& a, const Corners& b) {
    const Polyhedron moving = test::triangle(a[0], a[1], a[2]).polyhedron();
    const Polyhedron fixed = test::triangle(b[0], b[1], b[2]).polyhedron();
    const Motion motion = ScrewMotion::between(Pose{}, Pose{});
    const auto piece = motion.trajectory().pieces()->at(0);
    const motion::ControlMaps<double> maps = motion::double_maps(piece->cubic());
    const RelativeConfiguration bodies(moving.body(), fixed.body(), maps, 0);
    return are_crossing(bodies, 0, 0, 1e-13);
}

TEST(CrossingFaces, AgreeWithExactRationalsOnAGrid) {
    test::Random random(5);
    const auto corner = [&] {
        return Eigen::Vector3d(random.integer(-2, 2), random.integer(-2, 2), random.integer(-2, 2));
    };
    int crossing = 0, touching = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        const Corners a{corner(), corner(), corner()}, b{corner(), corner(), corner()};
        const auto area = [](const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]).norm(); };
        if (area(a) == 0 || area(b) == 0)
            continue;
        const bool expected = are_crossing_exactly(exact(a), exact(b));
        std::vector<Point> points;
        add_points(exact(a), exact(b), points);
        add_points(exact(b), exact(a), points);
        crossing += expected;
        touching += !expected && !points.empty();
        ASSERT_EQ(are_crossing_in_double(a, b), expected) << "trial " << trial;
    }
    EXPECT_GT(crossing, 400);
    EXPECT_GT(touching, 400) << "triangles that meet at a rim only";
}

TEST(CrossingFaces, FacesInOnePlaneDoNotCross) {
    EXPECT_FALSE(are_crossing_in_double({Eigen::Vector3d(0, 0, 0), {4, 0, 0}, {0, 4, 0}},
                                        {Eigen::Vector3d(1, 1, 0), {5, 1, 0}, {1, 5, 0}}));
}

TEST(CrossingFaces, LessThanTheErrorIsNoProof) {
    const Corners flat{Eigen::Vector3d(-1, -1, 0), {3, -1, 0}, {-1, 3, 0}};
    const auto needle = [](double depth) { return Corners{Eigen::Vector3d(0, 0, -depth), {1, 0, 1}, {-1, 0, 1}}; };
    EXPECT_TRUE(are_crossing_in_double(flat, needle(1e-6)));
    EXPECT_FALSE(are_crossing_in_double(flat, needle(1e-13)));
    EXPECT_FALSE(are_crossing_in_double(flat, needle(0)));
    EXPECT_FALSE(are_crossing_in_double(flat, needle(-1e-6)));
}

} // namespace
} // namespace chasles::contact
