// Slabs contain all vertices of their faces, and are thin for flat patches.
#include "chasles/hierarchy/slab.h"

#include "chasles/mesh/body.h"
#include "tests/mesh/shapes.h"
#include "tests/support/random.h"

#include <Eigen/Geometry>
#include <functional>
#include <gtest/gtest.h>

namespace chasles {
namespace {

using test::Random;

Eigen::Vector3f random_vector(Random& random, double size) {
    const auto v = random.vector(size);
    return Eigen::Vector3d(v.x, v.y, v.z).cast<float>();
}

TEST(PackedSlab, HeightsAreRoundedOutwardByLessThanAHundredth) {
    Random random(771);
    for (int i = 0; i < 20000; ++i) {
        const Eigen::Vector3f half = random_vector(random, 1).cwiseAbs();
        PackedSlab packed(random_vector(random, 1));
        const float reach = packed.normal().cwiseAbs().dot(half);
        const float a = reach * float(random.uniform(-1, 1));
        const float b = reach * float(random.uniform(-1, 1));
        packed.set_heights(std::min(a, b), std::max(a, b), half);
        const Slab slab = packed.in_box(half);
        EXPECT_EQ(slab.normal, packed.normal());
        const float rounding = 1e-6F * reach;
        EXPECT_LE(slab.lower, std::min(a, b) + rounding);
        EXPECT_GE(slab.upper, std::max(a, b) - rounding);
        EXPECT_GE(slab.lower, std::min(a, b) - 0.0079F * reach);
        EXPECT_LE(slab.upper, std::max(a, b) + 0.0079F * reach);
    }
}

TEST(PackedSlab, NormalsAreNextToWhatTheyStandForUpToTheSign) {
    Random random(772);
    for (int i = 0; i < 20000; ++i) {
        const Eigen::Vector3f given = random_vector(random, std::abs(random.scaled(-30, 30)));
        const Eigen::Vector3f normal = PackedSlab(given).normal();
        EXPECT_NEAR(normal.lpNorm<1>(), 1, 1e-6);
        EXPECT_LT(normal.normalized().cross(given.normalized()).norm(), 0.013);
    }
}

TEST(PackedSlab, WithoutDirectionItIsTheWholeBox) {
    for (const Eigen::Vector3f& along : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0, std::nanf(""), 0)}) {
        const Slab slab = PackedSlab(along).in_box({1, 2, 3});
        EXPECT_EQ(slab.normal, Eigen::Vector3f(0, 0, 1));
        EXPECT_EQ(slab.lower, -3);
        EXPECT_EQ(slab.upper, 3);
    }
}

/// Calls `see` with every node and every vertex of a face below it.
void for_all_vertices(const Polyhedron& body, const std::function<void(const BvhNode&, const Eigen::Vector3d&)>& see) {
    const auto nodes = body.body().bvh().nodes();
    const std::function<void(std::uint32_t, std::vector<std::uint32_t>&)> walk =
        [&](std::uint32_t index, std::vector<std::uint32_t>& below) {
            if (nodes[index].is_leaf()) {
                for (const std::uint32_t vertex : body.face(nodes[index].first))
                    below.push_back(vertex);
            } else {
                walk(nodes[index].first, below);
                std::vector<std::uint32_t> right;
                walk(nodes[index].first + 1U, right);
                below.insert(below.end(), right.begin(), right.end());
            }
            for (const std::uint32_t vertex : below)
                see(nodes[index], body.vertices()[vertex] - body.body().bvh().centre());
        };
    std::vector<std::uint32_t> all;
    walk(0, all);
}

/// The signed distance of a point from the slab of a node; negative inside.
double outside(const BvhNode& node, const Eigen::Vector3d& point) {
    const BoxMiddle middle = middle_of(node);
    const Slab slab = node.slab.in_box(middle.half);
    double height = 0;
    for (int i = 0; i < 3; ++i)
        height += double(slab.normal[i]) * (point[i] - double(middle.centre[i]));
    return std::max(height - double(slab.upper), double(slab.lower) - height);
}

/// Triangles of all sizes, including slivers, far from the origin.
test::Soup random_triangles(Random& random, int count) {
    test::Soup soup;
    for (int i = 0; i < 3 * count; ++i) {
        const auto v = random.vector(random.chance(0.3) ? std::abs(random.scaled(-5, 0)) : 1);
        soup.vertices.emplace_back(100 + v.x, v.y, v.z - 100);
    }
    for (std::uint32_t i = 0; i < std::uint32_t(count); ++i)
        soup.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    return soup;
}

TEST(Slabs, HoldAllVerticesBelowUpToAFewRoundings) {
    Random random(773);
    for (const auto& soup : {test::torus(24, 12), test::cube(), random_triangles(random, 300)}) {
        const Polyhedron body = Polyhedron::from_polygons(soup.vertices, soup.faces, {.triangulate = true});
        const BoxMiddle whole = middle_of(body.body().bvh().nodes()[0]);
        const double size = double(whole.half.lpNorm<1>());
        for_all_vertices(body, [&](const BvhNode& node, const Eigen::Vector3d& point) {
            EXPECT_LE(outside(node, point), 8 * 0x1p-24 * size);
        });
    }
}

/// A sheet that is tilted against all axes: its boxes are cubes, and its slabs are almost flat.
TEST(Slabs, AreThinOnATiltedPlane) {
    const Eigen::Vector3d u = Eigen::Vector3d(1, -1, 0).normalized();
    const Eigen::Vector3d v = Eigen::Vector3d(1, 1, -2).normalized();
    test::Soup soup;
    for (std::uint32_t i = 0; i <= 8; ++i)
        for (std::uint32_t j = 0; j <= 8; ++j)
            soup.vertices.emplace_back(double(i) * u + double(j) * v);
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::uint32_t j = 0; j < 8; ++j) {
            soup.faces.push_back({9 * i + j, 9 * i + j + 1, 9 * i + j + 10});
            soup.faces.push_back({9 * i + j, 9 * i + j + 10, 9 * i + j + 9});
        }
    const Polyhedron sheet = Polyhedron::from_polygons(soup.vertices, soup.faces);
    for (const BvhNode& node : sheet.body().bvh().nodes()) {
        const BoxMiddle middle = middle_of(node);
        const Slab slab = node.slab.in_box(middle.half);
        EXPECT_LT(slab.upper - slab.lower, 0.03F * middle.half.lpNorm<1>() * slab.normal.norm());
    }
}

/// Both sides of a plate: their opposite normals do not cancel.
TEST(Slabs, LieAlongAThinPlate) {
    test::Soup plate = test::cube();
    for (Eigen::Vector3d& vertex : plate.vertices)
        vertex.z() *= 0.01;
    const Polyhedron body = Polyhedron::from_polygons(plate.vertices, plate.faces);
    const Slab slab = body.body().bvh().nodes()[0].slab.in_box(middle_of(body.body().bvh().nodes()[0]).half);
    EXPECT_GT(slab.normal.z(), 0.95F);
    EXPECT_LE(slab.upper - slab.lower, 0.04F);
}

} // namespace
} // namespace chasles
