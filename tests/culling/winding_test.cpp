// Winding numbers by rays, against sums of solid angles and by hand.
#include "chasles/culling/winding.h"

#include "chasles/algebra/double_double.h"
#include "chasles/algebra/exact_number.h"
#include "chasles/culling/nested_boxes.h"
#include "tests/mesh/shapes.h"
#include "tests/support/random_poses.h"
#include "tests/support/solid_angle.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

template <class S>
std::optional<int> winding(const Polyhedron& body, const Eigen::Vector3d& point, double error, int ray) {
    const culling::WeightedPoint<S> place{{S(2 * point.x()), S(2 * point.y()), S(2 * point.z())}, S(2), S(error)};
    return culling::winding_around(body.body(), place, point, error, ray);
}

/// A prism over an outline that is not convex; its ends are polygons.
Polyhedron prism(const Outline& outline) {
    Soup soup;
    const auto count = std::uint32_t(outline.size());
    for (const double z : {0.0, 1.0})
        for (const Eigen::Vector2d& point : outline)
            soup.vertices.emplace_back(point.x(), point.y(), z);
    std::vector<std::uint32_t> bottom, top;
    for (std::uint32_t i = 0; i < count; ++i) {
        bottom.insert(bottom.begin(), i);
        top.push_back(count + i);
        soup.faces.push_back({i, (i + 1) % count, count + (i + 1) % count, count + i});
    }
    soup.faces.insert(soup.faces.end(), {bottom, top});
    return made_from(soup);
}

TEST(Winding, AgreesWithSolidAngles) {
    Random random(4403);
    Outline star;
    for (int i = 0; i < 14; ++i)
        star.emplace_back((i % 2 ? 1 : 0.35) * std::cos(2 * std::numbers::pi * i / 14),
                          (i % 2 ? 1 : 0.35) * std::sin(2 * std::numbers::pi * i / 14));
    int inside = 0, given_up = 0;
    for (const Polyhedron& body : {made_from(torus(30, 17)), prism(star), made_from(cube())})
        for (int i = 0; i < 3000; ++i) {
            const Eigen::Vector3d point = random_point(random, 1.4);
            const double expected = winding_by_solid_angles(body, point);
            for (int ray = 0; ray < culling::ray_count; ++ray) {
                const auto found = winding<double>(body, point, 1e-13, ray);
                given_up += !found;
                EXPECT_NEAR(found.value_or(std::lround(expected)), expected, 1e-6) << point.transpose();
                if (i < 100) {
                    EXPECT_EQ(winding<algebra::DoubleDouble>(body, point, 1e-28, ray), found);
                    EXPECT_EQ(winding<algebra::ExactNumber>(body, point, 0, ray), found);
                }
            }
            inside += expected > 0.5;
        }
    EXPECT_GT(inside, 500);
    EXPECT_LT(given_up, 3);
}

TEST(Winding, IsNotToldNextToTheSurface) {
    const Polyhedron body = made_from(cube());
    for (const double x : {-1e-14, 0.0, 1e-14})
        for (int ray = 0; ray < culling::ray_count; ++ray) {
            const Eigen::Vector3d point(x, 0.25, 0.5);
            const auto in_double = winding<double>(body, point, 1e-13, ray);
            EXPECT_TRUE(!in_double || *in_double == (x > 0)) << "behind the origin, a face does not matter";
            const auto exact = winding<algebra::ExactNumber>(body, point, 0, ray);
            if (x != 0) {
                EXPECT_EQ(exact, x > 0 ? 1 : 0);
            }
        }
}

/// What is near the line of a ray, in front or behind, is never counted wrongly: points next to edges and corners.
TEST(Winding, OfPointsBesideEdgesIsRightOrNotTold) {
    Random random(4404);
    const Polyhedron body = made_from(torus(12, 7));
    int told = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto& vertices = body.vertices();
        const Eigen::Vector3d corner = vertices[std::size_t(random.integer(0, int(vertices.size()) - 1))];
        const Eigen::Vector3d point = corner + random_point(random, 1) * std::abs(random.scaled(-12, -3));
        for (int ray = 0; ray < culling::ray_count; ++ray) {
            const auto exact = winding<algebra::ExactNumber>(body, point, 0, ray);
            const auto found = winding<double>(body, point, 1e-14, ray);
            told += found.has_value();
            EXPECT_TRUE(!found || !exact || *found == *exact);
            EXPECT_NEAR(exact.value_or(0), std::lround(winding_by_solid_angles(body, point)), exact ? 0 : 1);
        }
    }
    EXPECT_GT(told, 7000);
}

TEST(NestedBoxes, AskForEachPartInTheBox) {
    Soup soup;
    for (int i = 0; i < 100; ++i) {
        const Soup one = cube();
        const auto first = std::uint32_t(soup.vertices.size());
        for (const Eigen::Vector3d& vertex : one.vertices)
            soup.vertices.emplace_back(0.1 * vertex + Eigen::Vector3d(i, 0.3, 0.3));
        for (std::vector<std::uint32_t> face : one.faces) {
            for (std::uint32_t& corner : face)
                corner += first;
            soup.faces.push_back(face);
        }
    }
    const Polyhedron row = made_from(soup), box = made_from(cube());
    for (int i = 0; i < 100; ++i) {
        const culling::Placement place{Eigen::Matrix3d::Identity(), row.body().bvh().centre() -
                                                                        box.body().bvh().centre() -
                                                                        Eigen::Vector3d(i - 0.4, 0, 0)};
        const culling::PlacedPair pair{row.body(), box.body(), place, 1e-12};
        std::vector<std::uint32_t> asked;
        for (const std::uint32_t vertex : points_to_ask(pair))
            asked.push_back(vertex / 8);
        EXPECT_EQ(asked, std::vector{std::uint32_t(i)});
        EXPECT_TRUE(culling::may_be_nested(pair));
        EXPECT_TRUE(culling::may_be_nested(pair.swapped()));
    }
    const culling::Placement beside{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 2, 0)};
    EXPECT_FALSE(culling::may_be_nested({row.body(), box.body(), beside, 1e-12}));
}

} // namespace
} // namespace chasles::test
