// Vertices are equal if their bits are equal; +0 and -0 are equal too.
#include "chasles/mesh/merge_vertices.h"

#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tuple>

namespace chasles {
namespace {

TEST(MergeVertices, NamesTheFirstOfEqualOnes) {
    const std::vector<Eigen::Vector3d> vertices = {{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {0, -0.0, 0}, {1, 2, 3}};
    EXPECT_EQ(first_equal_vertices(vertices), (std::vector<std::uint32_t>{0, 1, 0, 1, 0}));
}

TEST(MergeVertices, KeepsTheNearestNeighboursApart) {
    const std::vector<Eigen::Vector3d> vertices = {{1, 2, 3}, {std::nextafter(1.0, 2.0), 2, 3}};
    EXPECT_EQ(first_equal_vertices(vertices), (std::vector<std::uint32_t>{0, 1}));
}

TEST(MergeVertices, TakesNoVertices) {
    EXPECT_TRUE(first_equal_vertices({}).empty());
}

TEST(MergeVertices, AgreesWithAnOrderedMapOnAGrid) {
    const unsigned seed = 20240503;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> place(-6, 6);
    std::vector<Eigen::Vector3d> vertices;
    for (int i = 0; i < 5000; ++i)
        vertices.emplace_back(0.1 * place(random), 0.1 * place(random), 0.1 * place(random));
    std::map<std::tuple<double, double, double>, std::uint32_t> first;
    const std::vector<std::uint32_t> merged = first_equal_vertices(vertices);
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        const auto& v = vertices[i];
        ASSERT_EQ(merged[i], first.try_emplace({v.x(), v.y(), v.z()}, i).first->second) << "vertex " << i;
    }
    EXPECT_LT(first.size(), vertices.size());
}

} // namespace
} // namespace chasles
