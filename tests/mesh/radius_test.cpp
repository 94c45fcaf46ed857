// Bodies with a radius: what is round, and faces that have moved inwards.
#include "chasles/mesh/moved_inwards.h"
#include "chasles/mesh/primitives.h"
#include "tests/mesh/shapes.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

Polyhedron with(const Soup& soup, double radius) {
    return made_from(soup, {.radius = radius});
}

/// The normals of the faces around each vertex, by cross products of the first corners.
std::vector<std::vector<Vector3d>> normals_around(const Polyhedron& body) {
    std::vector<std::vector<Vector3d>> around(body.vertex_count());
    for (std::size_t i = 0; i < body.face_count(); ++i) {
        const auto face = body.face(i);
        const auto corner = [&](std::size_t k) { return body.vertices()[face[k]]; };
        for (const std::uint32_t vertex : face)
            around[vertex].push_back((corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized());
    }
    return around;
}

/// How far the planes around a vertex move along their normals: least and most.
std::pair<double, double> moves_at(std::span<const Vector3d> normals, const Vector3d& shift) {
    std::pair moves(1e300, -1e300);
    for (const Vector3d& normal : normals)
        moves = {std::min(moves.first, normal.dot(shift)), std::max(moves.second, normal.dot(shift))};
    return moves;
}

TEST(MovedInwards, PlanesOfABoxMoveByTheRadius) {
    for (const double radius : {0.0625, 1e-9}) {
        const Polyhedron body = with(cube(), -radius);
        EXPECT_EQ(body.radius(), 0);
        EXPECT_EQ(body.report().moved_inwards, radius);
        EXPECT_EQ(body.report().polygons, 6U);
        EXPECT_EQ(body.report().solid_parts, 1U);
        for (std::size_t i = 0; i < 8; ++i)
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(body.vertices()[i][axis], (i >> axis & 1) != 0 ? 1 - radius : radius, 1e-15);
    }
}

TEST(MovedInwards, NoPlaneMovesFartherAndNoneOutwards) {
    Random random(4403);
    const Soup round = torus(24, 16);
    for (int round_number = 0; round_number < 40; ++round_number) {
        Soup soup = round;
        for (Vector3d& vertex : soup.vertices) // uneven, with saddles
            vertex += random_point(random, 0.01);
        const double radius = std::pow(10.0, random.uniform(-9, -3));
        const Polyhedron given = made_from(soup), body = with(soup, -radius);
        const auto around = normals_around(given);
        for (std::size_t i = 0; i < body.vertex_count(); ++i) {
            const auto [least, most] = moves_at(around[i], body.vertices()[i] - given.vertices()[i]);
            EXPECT_NEAR(least, -radius, 1e-6 * radius + 1e-15);
            EXPECT_LT(most, -0.5 * radius);
        }
    }
}

/// A rounded rim of a step: normals within a right angle, of which some are between others.
TEST(MovedInwards, SmallestCapIsThatOfAllPairsAndTriples) {
    Random random(4404);
    for (int round = 0; round < 2'000; ++round) {
        const Vector3d axis = random_point(random, 1).normalized();
        std::vector<Vector3d> normals;
        for (int count = random.integer(1, 9); count > 0; --count)
            normals.push_back((axis + random_point(random, random.chance(0.3) ? 0.01 : 0.8)).normalized());
        if (random.chance(0.3))
            normals.push_back(normals.front());
        double best = -1;
        const auto try_middle = [&](const Vector3d& middle) {
            double least = 1;
            for (const Vector3d& normal : normals)
                least = std::min(least, normal.dot(middle));
            best = std::max(best, least);
        };
        for (const Vector3d& a : normals) {
            try_middle(a);
            for (const Vector3d& b : normals) {
                if ((a + b).norm() > 1e-9)
                    try_middle((a + b).normalized());
                for (const Vector3d& c : normals)
                    if (const Vector3d across = (b - a).cross(c - a); across.norm() > 1e-9)
                        try_middle(across.dot(a) < 0 ? Vector3d(-across.normalized()) : Vector3d(across.normalized()));
            }
        }
        EXPECT_NEAR(smallest_cap(normals).cosine, std::max(best, 0.0), 1e-9) << round;
    }
}

/// A cone with so many sides that steps by pairs would take minutes.
TEST(MovedInwards, AVertexMayHaveManyFaces) {
    const std::uint32_t sides = 50'000;
    Soup soup{{{0, 0, 1}, {0, 0, 0}}, {}};
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        soup.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
        soup.faces.push_back({0, 2 + i, 2 + (i + 1) % sides});
        soup.faces.push_back({1, 2 + (i + 1) % sides, 2 + i});
    }
    const Polyhedron body = with(soup, -1e-6);
    EXPECT_NEAR(body.vertices()[0].z(), 1 - std::sqrt(2.0) * 1e-6, 1e-12);
    EXPECT_NEAR(body.vertices()[1].z(), 1e-6, 1e-15);
}

TEST(MovedInwards, AVertexStaysWhereNoShiftMovesAllPlanes) {
    // Two cubes that have one vertex in common, at opposite corners.
    Soup soup = cube();
    const Soup second = cube();
    for (const Vector3d& vertex : second.vertices)
        soup.vertices.push_back(vertex - Vector3d::Ones());
    for (std::vector<std::uint32_t> face : second.faces) {
        for (std::uint32_t& corner : face)
            corner += 8;
        soup.faces.push_back(face);
    }
    const Polyhedron body = with(soup, -0.125);
    EXPECT_EQ(body.vertices()[0], Vector3d::Zero());
    EXPECT_EQ(body.vertices()[15], Vector3d::Zero()) << "the same place";
    EXPECT_TRUE(body.vertices()[7].isApprox(Vector3d::Constant(0.875), 1e-15));
}

TEST(MovedInwards, RefusesWhatHasNoInsideOrNoRoom) {
    Soup open = cube();
    open.faces.pop_back();
    EXPECT_EQ(
        refusal([&] { (void)with(open, -0.1); }),
        "mesh: radius: -0.1 moves the faces of a closed body inwards, and this surface is not closed, or its faces "
        "are not turned the same way, along 4 edges; mend the mesh, or leave its radius at 0");
    Soup turned = cube();
    std::ranges::reverse(turned.faces[3]);
    EXPECT_NE(refusal([&] { (void)with(turned, -0.1); }), "accepted");
    EXPECT_EQ(
        refusal([&] { (void)with(cube(), -0.6); }),
        "mesh: radius: -0.6 turns face 0 over: the body is too thin there, or the face too small; a radius nearer to "
        "0, or a mesh without such faces, may do");
    EXPECT_EQ(refusal([&] { (void)with(cube(), std::nan("")); }), "mesh: radius: nan must be in [-1e30, 1e30]");
    EXPECT_EQ(refusal([&] { (void)with(cube(), 2e30); }), "mesh: radius: 2e+30 must be in [-1e30, 1e30]");
}

/// An L whose ends are polygons, or cut into triangles of which one is thinner than the overlap. A plate that is thin
/// itself has no room.
TEST(MovedInwards, SliversInFlatFacesMayTurnOver) {
    Soup bracket;
    for (const double height : {0.0, 5.0})
        for (const auto& [x, y] :
             {std::pair(0.0, 0.0), {8.0, 0.0}, {8.0, 4.001}, {4.001, 4.001}, {4.001, 8.0}, {0.0, 8.0}})
            bracket.vertices.emplace_back(x, y, height);
    for (std::uint32_t i = 0; i < 6; ++i)
        bracket.faces.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
    Soup cut = bracket;
    bracket.faces.insert(bracket.faces.end(), {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}});
    cut.faces.insert(cut.faces.end(),
                     {{5, 1, 0}, {6, 7, 11}, {5, 3, 1}, {7, 9, 11}, {3, 2, 1}, {7, 8, 9}, {5, 4, 3}, {9, 10, 11}});
    for (const double radius : {-0.002, -0.1, -1.0})
        for (std::size_t i = 0; i < 12; ++i)
            EXPECT_TRUE(with(cut, radius).vertices()[i].isApprox(with(bracket, radius).vertices()[i], 1e-12)) << radius;
    Soup plate = cut;
    for (Vector3d& vertex : plate.vertices)
        vertex.z() *= 0.0002;
    EXPECT_NE(refusal([&] { (void)with(plate, -0.002); }), "accepted");
}

/// A vertex in the middle of an edge, joined to the face beyond by a face without area.
TEST(MovedInwards, RefusesWhatOpens) {
    Soup soup = cube();
    soup.vertices.emplace_back(0.5, 0, 0);
    soup.faces[2] = {0, 8, 1, 5, 4};
    soup.faces.push_back({0, 1, 8});
    EXPECT_TRUE(made_from(soup).report().closed);
    EXPECT_EQ(made_from(soup).report().solid_parts, 1U);
    EXPECT_NE(refusal([&] { (void)with(soup, -0.01); }).find("opens the surface along 3 edges"), std::string::npos)
        << refusal([&] { (void)with(soup, -0.01); });
}

TEST(MovedInwards, FacesKeepTheirNames) {
    Soup soup = cube();
    soup.faces[2] = {0, 1, 5};
    soup.faces.push_back({0, 5, 4});
    soup.faces.insert(soup.faces.begin(), {0, 1, 1}); // dropped
    const Polyhedron given = made_from(soup), body = with(soup, -0.01);
    ASSERT_EQ(given.face_count(), body.face_count());
    for (std::size_t i = 0; i < body.face_count(); ++i)
        EXPECT_EQ(body.source_face(i), given.source_face(i));
    EXPECT_EQ(given.with_radius(-0.01).vertices()[7], body.vertices()[7]);
}

TEST(Round, ASphereIsAPointWithARadius) {
    const Polyhedron sphere = make_sphere(2);
    EXPECT_EQ(sphere.radius(), 2);
    EXPECT_EQ(sphere.face_count(), 1U);
    EXPECT_EQ(sphere.report().lower, Vector3d::Constant(-2));
    EXPECT_EQ(sphere.report().upper, Vector3d::Constant(2));
    const Polyhedron capsule = make_capsule(0.5, 3);
    EXPECT_EQ(capsule.report().lower, Vector3d(-0.5, -0.5, -2));
    EXPECT_EQ(capsule.report().segments, 1U);
    const std::array points{Vector3d(1, 2, 3), Vector3d(0, 0, 0), Vector3d(1, 2, 3)};
    const Polyhedron cloud = make_points(points, 0.25);
    EXPECT_EQ(cloud.report().distinct_vertices, 2U);
    EXPECT_EQ(cloud.report().upper, Vector3d(1.25, 2.25, 3.25));
}

TEST(Round, RefusesSizesThatNoBodyHas) {
    EXPECT_EQ(refusal([] { (void)make_sphere(0); }), "sphere: radius: must be positive and at most 1e30, and is 0");
    EXPECT_EQ(refusal([] { (void)make_capsule(1, -1); }),
              "capsule: length: must be positive and at most 1e30, and is -1");
    EXPECT_EQ(refusal([] { (void)make_points({}, 1); }), "points: needs at least one point");
    EXPECT_EQ(refusal([] {
                  (void)Polyhedron::from_polygons(std::vector{Vector3d(0, 0, 0)},
                                                  std::vector<std::vector<std::uint32_t>>{{0, 0, 0}});
              }),
              "mesh: all vertices lie within 0 of each other, which is too small to compute with (at least 1e-30); a "
              "point needs a radius above 0");
}

/// A sphere has no faces that could move.
TEST(Round, PointsAndSegmentsNeedARadiusAboveZero) {
    const std::string below_zero = "mesh: radius: -0.05 moves the faces of a closed body inwards, and points and "
                                   "segments have none; their radius must be above 0";
    for (const Polyhedron& body : {make_sphere(1), make_capsule(1, 2)}) {
        EXPECT_EQ(refusal([&] { (void)body.with_radius(-0.05); }), below_zero);
        EXPECT_TRUE(refusal([&] { (void)body.with_radius(0); }).ends_with("a radius above 0"));
    }
}

TEST(Round, WithRadiusKeepsEverythingElse) {
    const Polyhedron box = make_box({1, 2, 3});
    const Polyhedron round = box.with_radius(0.5);
    EXPECT_EQ(round.radius(), 0.5);
    EXPECT_EQ(round.report().solid_parts, 1U);
    EXPECT_EQ(round.vertices()[3], box.vertices()[3]);
    EXPECT_EQ(round.with_radius(0).report().upper, box.report().upper);
}

} // namespace
} // namespace chasles::test
