// A radius below 0: bodies with narrow faces move inwards, or are refused.
#include "chasles/mesh/face_directions.h"
#include "chasles/mesh/inwards_check.h"
#include "chasles/mesh/make_body.h"
#include "tests/mesh/shapes.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <optional>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using Exact = Eigen::Matrix<long double, 3, 1>;
using Triangle = std::array<Exact, 3>;

std::vector<Triangle> triangles_of(const Polyhedron& body, std::span<const Vector3d> vertices) {
    std::vector<Triangle> all;
    for (std::size_t face = 0; face < body.face_count(); ++face)
        for (const auto& [a, b, c] : body.triangles(face))
            all.push_back(
                {vertices[a].cast<long double>(), vertices[b].cast<long double>(), vertices[c].cast<long double>()});
    return all;
}

/// By solid angles.
bool is_outside(std::span<const Triangle> surface, const Exact& point) {
    long double sum = 0;
    for (const Triangle& triangle : surface) {
        const Exact a = triangle[0] - point, b = triangle[1] - point, c = triangle[2] - point;
        const long double x = a.norm(), y = b.norm(), z = c.norm();
        sum += std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
    }
    return sum < std::numbers::pi_v<long double>;
}

long double distance_from_segment(const Exact& a, const Exact& b, const Exact& point) {
    const long double square = (b - a).squaredNorm();
    const long double share = square > 0 ? std::clamp((point - a).dot(b - a) / square, 0.0L, 1.0L) : 0;
    return (point - a - share * (b - a)).norm();
}

long double distance_from(const Triangle& triangle, const Exact& point) {
    const Exact normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    long double least = 1e30L;
    bool is_above = normal.norm() > 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Exact &a = triangle[i], &b = triangle[(i + 1) % 3];
        least = std::min(least, distance_from_segment(a, b, point));
        is_above = is_above && (b - a).cross(point - a).dot(normal) >= 0;
    }
    return is_above ? std::min(least, std::abs((point - triangle[0]).dot(normal)) / normal.norm()) : least;
}

/// How far the moved vertices are outside of the given body.
long double farthest_outside(const Polyhedron& given, const Polyhedron& moved) {
    const std::vector<Triangle> surface = triangles_of(given, given.vertices());
    long double farthest = 0;
    for (const Vector3d& vertex : moved.vertices()) {
        const Exact point = vertex.cast<long double>();
        if (!is_outside(surface, point))
            continue;
        long double least = 1e30L;
        for (const Triangle& triangle : surface)
            least = std::min(least, distance_from(triangle, point));
        farthest = std::max(farthest, least);
    }
    return farthest;
}

/// How far the corners of a face move along a direction: least and most; nothing if the face is thicker along it.
std::optional<std::pair<long double, long double>> moves_along(const Exact& normal, const Triangle& before,
                                                               const Triangle& after, long double thickness) {
    long double least = 1e30L, most = -1e30L, low = 0, high = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        least = std::min(least, (after[i] - before[i]).dot(normal));
        most = std::max(most, (after[i] - before[i]).dot(normal));
        low = std::min(low, (before[i] - before[0]).dot(normal));
        high = std::max(high, (before[i] - before[0]).dot(normal));
    }
    return high - low > thickness ? std::nullopt : std::optional(std::pair(least, most));
}

/// Whether each face moves inwards by at most the distance, against its own normal or that of a face in whose plane it
/// lies up to a thousandth of the distance.
bool all_move_inwards(const Polyhedron& given, const Polyhedron& moved, long double distance) {
    const std::vector<Triangle> before = triangles_of(given, given.vertices());
    const std::vector<Triangle> after = triangles_of(given, moved.vertices());
    std::vector<Exact> normals;
    for (const Triangle& triangle : before)
        normals.push_back((triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized());
    const long double rounding = 1e-6L * distance + 1e-15L;
    const auto fits = [&](std::size_t face, const Exact& normal, long double thickness) {
        const auto moves = moves_along(normal, before[face], after[face], thickness);
        return moves && moves->first >= -distance - rounding && moves->second <= rounding;
    };
    for (std::size_t face = 0; face < before.size(); ++face)
        if (!fits(face, normals[face], 1e30L) && std::ranges::none_of(normals, [&](const Exact& normal) {
                return fits(face, normal, 1.001e-3L * distance);
            }))
            return false;
    return true;
}

/// A prism over an outline. Its sides are cut into triangles; its ends are polygons, or cones to points on the axis.
Soup prism(const Outline& outline, double height, const std::optional<double>& tip) {
    Soup soup;
    const auto count = static_cast<std::uint32_t>(outline.size());
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const double z : {0.0, height})
        for (const Eigen::Vector2d& corner : outline) {
            soup.vertices.emplace_back(corner.x(), corner.y(), z);
            middle += corner / (2 * count);
        }
    std::vector<std::uint32_t> lower, upper;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        soup.faces.push_back({i, next, count + next});
        soup.faces.push_back({i, count + next, count + i});
        lower.insert(lower.begin(), i);
        upper.push_back(count + i);
        if (tip) {
            soup.faces.push_back({next, i, 2 * count});
            soup.faces.push_back({count + i, count + next, 2 * count + 1});
        }
    }
    if (!tip) {
        soup.faces.insert(soup.faces.end(), {lower, upper});
        return soup;
    }
    soup.vertices.emplace_back(middle.x(), middle.y(), -*tip);
    soup.vertices.emplace_back(middle.x(), middle.y(), height + *tip);
    return soup;
}

/// With all polygons cut into triangles, as an STL file has them.
Soup cut(const Soup& soup) {
    const Polyhedron body = made_from(soup, {.triangulate = true});
    Soup all{soup.vertices, {}};
    for (std::size_t face = 0; face < body.face_count(); ++face)
        for (const auto& [a, b, c] : body.triangles(face))
            all.faces.push_back({a, b, c});
    return all;
}

/// Points of an ellipse, many of them near each other.
Outline crowded_ellipse(Random& random) {
    std::vector<double> angles{0, 2.1, 4.2};
    for (int count = random.integer(0, 6); count > 0; --count)
        angles.push_back(random.chance(0.5) ? angles.back() + std::abs(random.scaled(-5, -1)) : random.uniform(0, 6.2));
    std::ranges::sort(angles);
    const double width = random.chance(0.3) ? random.uniform(0.02, 0.2) : 1;
    Outline outline;
    for (const double angle : angles)
        outline.emplace_back(std::cos(angle), width * std::sin(angle));
    return outline;
}

/// A wedge that a narrow face makes blunt.
Outline blunt_wedge(Random& random) {
    const double half = std::abs(random.scaled(-5, -1));
    return {{0, -half},
            {1, -half - std::tan(random.uniform(0.05, 1.5))},
            {1, half + std::tan(random.uniform(0.05, 1.5))},
            {0, half}};
}

/// A plate with slits and steps, whose rim is nearly straight between them.
Outline slit_plate(Random& random) {
    Outline outline{{0, 0}, {4, 0}, {4, 2 + (random.chance(0.5) ? std::abs(random.scaled(-6, -1)) : 0)}};
    for (double right = 4; right > 1;) {
        const double begin = right - random.uniform(0.2, 0.5), end = begin - std::abs(random.scaled(-4, -0.5));
        const double depth = random.chance(0.5) ? random.uniform(0.1, 1.5) : random.scaled(-6, -1);
        const double rim = 2 + (random.chance(0.3) ? random.scaled(-7, -2) : 0);
        const double slant = random.chance(0.5) ? random.uniform(-0.1, 0.1) * depth : 0;
        outline.insert(outline.end(), {{begin, rim}, {begin - slant, 2 - depth}, {end, 2 - depth}, {end, rim}});
        right = end;
    }
    outline.emplace_back(0, 2 + (random.chance(0.3) ? random.scaled(-7, -2) : 0));
    return outline;
}

Soup random_body(Random& random) {
    const double kind = random.uniform(0, 1), tip = random.chance(0.5) ? random.uniform(0.01, 1) : 0;
    const Outline outline = kind < 0.3   ? crowded_ellipse(random)
                            : kind < 0.6 ? blunt_wedge(random)
                                         : slit_plate(random);
    return kind < 0.6 && random.chance(0.7) ? prism(outline, 1, tip) : cut(prism(outline, 1, std::nullopt));
}

/// Turned, of another size, and often rounded to single precision, as an STL file is.
void place(Soup& soup, double size, Random& random) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(random.uniform(0, 6), random_point(random, 1).normalized()).toRotationMatrix();
    const bool is_turned = random.chance(0.5), is_rounded = random.chance(0.4);
    for (Vector3d& vertex : soup.vertices) {
        vertex *= size;
        if (is_turned)
            vertex = turn * vertex;
        if (is_rounded)
            vertex = vertex.cast<float>().cast<double>();
    }
}

TEST(InwardsCheck, WhatIsAcceptedHasMovedInwardsByAtMostTheRadius) {
    const int rounds = std::getenv("CHASLES_LONG") != nullptr ? 300'000 : 3'000;
    Random random(4711);
    int accepted = 0;
    for (int round = 0; round < rounds; ++round) {
        const double size = random.chance(0.5) ? 1 : std::pow(10.0, random.uniform(-3, 3));
        Soup soup = random_body(random);
        place(soup, size, random);
        const double distance = std::pow(10.0, random.uniform(-5, -1)) * size;
        const Polyhedron given = made_from(soup);
        std::optional<Polyhedron> moved;
        if (refusal([&] { moved = given.with_radius(-distance); }) != "accepted")
            continue;
        ++accepted;
        ASSERT_LT(farthest_outside(given, *moved), 1e-3L * distance + 1e-14L * size) << round;
        ASSERT_TRUE(all_move_inwards(given, *moved, distance)) << round;
    }
    EXPECT_GT(accepted, rounds / 4);
    EXPECT_LT(accepted, rounds * 3 / 4);
}

/// Its highest point is y = 0.0005, on a face 0.004 wide between two long ones.
TEST(InwardsCheck, ABluntWedgeDoesNotGrow) {
    Soup wedge = prism({{0, 0}, {1, -1}, {1, 0.0005}, {0.004, 0.0005}}, 1, 1.0);
    wedge.vertices[8] = {0.6, -0.4, -1};
    wedge.vertices[9] = {0.6, -0.4, 2};
    const Polyhedron given = made_from(wedge);
    for (const double radius : {0.001, 0.002, 0.003, 0.004, 0.005, 0.01, 0.02, 0.05}) {
        std::optional<Polyhedron> moved;
        if (refusal([&] { moved = given.with_radius(-radius); }) != "accepted")
            continue;
        EXPECT_LE(farthest_outside(given, *moved), 0) << radius;
        EXPECT_TRUE(all_move_inwards(given, *moved, radius)) << radius;
    }
    EXPECT_EQ(refusal([&] { (void)given.with_radius(-0.001); }), "accepted");
    EXPECT_NE(refusal([&] { (void)given.with_radius(-0.01); }), "accepted");
}

/// A face 0.0084 wide and 1 long between two others, at an angle to both: its plane counts though it is narrow.
TEST(InwardsCheck, ANarrowFaceMovesByAtMostTheRadius) {
    for (const double angle : {0.1, 0.5, 1.0}) {
        const double x = 0.0084 * std::sin(angle), y = 0.0084 * std::cos(angle);
        const Polyhedron given = made_from(prism({{0, 0}, {2, 0}, {2, 1}, {x, 1}, {0, 1 - y}}, 1, 0.3));
        for (const double radius : {0.001, 0.005, 0.01}) {
            std::optional<Polyhedron> moved;
            if (refusal([&] { moved = given.with_radius(-radius); }) == "accepted") {
                EXPECT_TRUE(all_move_inwards(given, *moved, radius)) << radius;
            }
        }
    }
}

constexpr const char* ending = ": the body is too thin there, or the face too small; a radius nearer to 0, or a mesh "
                               "without such faces, may do";

/// Faces that meet at 0.008 radians lie on each other.
TEST(InwardsCheck, RefusesFolds) {
    const Soup needle = prism({{0, 0}, {1, -0.004}, {1, 0.004}}, 1, std::nullopt);
    EXPECT_EQ(refusal([&] { (void)made_from(needle, {.radius = -0.001}); }),
              std::string("mesh: radius: -0.001 finds no room between face 1 and face 4") + ending);
}

/// A cube with a vertex in the middle of its top, which goes down to a height.
std::string refusal_of_dent(double height, double distance) {
    Soup soup = cube();
    soup.vertices.emplace_back(0.5, 0.5, 1);
    soup.faces.pop_back();
    soup.faces.insert(soup.faces.end(), {{4, 5, 8}, {5, 7, 8}, {7, 6, 8}, {6, 4, 8}});
    const chasles::Body body(make_body(
        soup.vertices, std::vector<std::span<const std::uint32_t>>(soup.faces.begin(), soup.faces.end()), {}));
    std::vector<Vector3d> moved = soup.vertices;
    moved[8].z() = height;
    const std::vector<Vector3d> directions = face_directions(body, 0.001);
    return refusal([&] { require_inwards({body, directions, moved, distance, 0.001}); });
}

TEST(InwardsCheck, DoesNotTrustWhatMovedTheVertices) {
    const std::string start = "mesh: radius: -2 moves ";
    EXPECT_EQ(refusal_of_dent(0.5, 2), "accepted");
    EXPECT_EQ(refusal_of_dent(1.001, 2), start + "face 5 outwards or too far" + ending);
    EXPECT_EQ(refusal_of_dent(-1.001, 2), start + "face 5 outwards or too far" + ending);
    EXPECT_EQ(refusal_of_dent(-0.5, 2), start + "vertex 8 out of the body through face 4" + ending);
}

} // namespace
} // namespace chasles::test
