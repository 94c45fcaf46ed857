// Polyhedra that enclose round bodies: no point of the body is outside of any face, and no vertex is too far away.
#include "chasles/mesh/primitives.h"

#include "tests/support/random.h"
#include "tests/support/refusal.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using Long = Eigen::Matrix<long double, 3, 1>;

/// How far a point is beyond the plane of the face that it is farthest beyond, in long double.
long double beyond_faces(const Polyhedron& shape, const Long& point) {
    long double most = -1e30L;
    for (std::size_t i = 0; i < shape.face_count(); ++i) {
        const auto face = shape.face(i);
        const auto corner = [&](std::size_t k) { return Long(shape.vertices()[face[k]].cast<long double>()); };
        const Long normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        most = std::max(most, normal.dot(point - corner(0)));
    }
    return most;
}

/// A point on the surface of all points within `radius` of the segment of this length along z.
Long on_capsule(Random& random, double radius, double length) {
    const Vector3d way = Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const Long middle(0, 0, random.uniform(-0.5, 0.5) * length);
    Long out = way.cast<long double>();
    if (way.z() * double(middle.z()) < 0 || std::abs(double(middle.z())) < length / 2)
        out.z() = random.chance(0.5) ? 0 : out.z();
    return Long(0, 0, (out.z() > 0 ? 0.5L : -0.5L) * length) + radius * out.normalized();
}

void expect_closed(const Polyhedron& shape) {
    EXPECT_TRUE(shape.report().closed);
    EXPECT_EQ(shape.report().nonmanifold_edges, 0U);
    EXPECT_LT(double(beyond_faces(shape, Long(0, 0, 0))), 0) << "faces look outwards";
}

TEST(Primitives, SpheresAndCapsulesAreEnclosed) {
    Random random(2401);
    for (const double deviation : {0.5, 0.1, 0.01, 0.002})
        for (const double length : {0.0, 0.3, 4.0}) {
            const double radius = random.uniform(0.1, 3);
            const EnclosingPolyhedron body = length == 0 ? enclosing_sphere(radius, deviation * radius)
                                                         : enclosing_capsule(radius, length, deviation * radius);
            expect_closed(body.shape);
            EXPECT_LE(body.deviation, deviation * radius * (1 + 1e-9));
            for (const Vector3d& v : body.shape.vertices()) {
                const double z = std::max(0.0, std::abs(v.z()) - length / 2);
                EXPECT_LE(std::hypot(v.x(), v.y(), z) - radius, body.deviation * (1 + 1e-9));
            }
            for (int i = 0; i < 300; ++i)
                EXPECT_LE(double(beyond_faces(body.shape, on_capsule(random, radius, length))), 0);
        }
}

TEST(Primitives, CylindersAreEnclosed) {
    Random random(2402);
    for (const double deviation : {0.5, 0.1, 0.01, 1e-4}) {
        const double radius = random.uniform(0.1, 3), length = random.uniform(0.1, 3);
        const EnclosingPolyhedron body = enclosing_cylinder(radius, length, deviation * radius);
        expect_closed(body.shape);
        EXPECT_LE(body.deviation, deviation * radius * (1 + 1e-9));
        for (const Vector3d& v : body.shape.vertices())
            EXPECT_LE(std::hypot(v.x(), v.y()) - radius, body.deviation);
        for (int i = 0; i < 300; ++i) {
            const long double angle = random.uniform(0, 2 * std::numbers::pi);
            const Long rim(radius * std::cos(angle), radius * std::sin(angle), (i % 2 ? 0.5L : -0.5L) * length);
            EXPECT_LE(double(beyond_faces(body.shape, rim)), 0);
        }
    }
}

TEST(Primitives, ABoxIsExact) {
    const Polyhedron box = make_box({1, 2, 3});
    expect_closed(box);
    EXPECT_EQ(box.report().lower, Vector3d(-0.5, -1, -1.5));
    EXPECT_EQ(box.report().upper, Vector3d(0.5, 1, 1.5));
}

TEST(Primitives, RefuseSizesThatAreNone) {
    EXPECT_EQ(refusal([] { (void)make_box({1, 0, 1}); }), "box: y: must be positive and at most 1e30, and is 0");
    EXPECT_EQ(refusal([] { (void)enclosing_sphere(-1, 0.1); }),
              "sphere: radius: must be positive and at most 1e30, and is -1");
    EXPECT_EQ(refusal([] { (void)enclosing_cylinder(1, std::nan(""), 0.1); }),
              "cylinder: length: must be positive and at most 1e30, and is nan");
    EXPECT_EQ(refusal([] { (void)enclosing_capsule(1, 1, 1e-9); }),
              "capsule: deviation: must be at least 0.001, or the polyhedron has too many faces");
}

} // namespace
} // namespace chasles::test
