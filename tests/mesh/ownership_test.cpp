// Every feature has exactly one owner among its faces, and features are distributed evenly.
#include "chasles/mesh/ownership.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace chasles {
namespace {

TEST(Ownership, GivesEachFeatureOnceToAFaceThatHasIt) {
    const unsigned seed = 20240504;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::uint32_t> feature(0, 99);
    FlatLists<std::uint32_t> faces;
    for (int face = 0; face < 60; ++face)
        faces.append(std::vector{feature(random), feature(random), no_feature, feature(random)});
    const FlatLists<std::uint32_t> owned = share_features(faces.offsets, faces.items, std::vector<char>(100));
    std::multiset<std::uint32_t> seen;
    for (std::size_t face = 0; face < faces.size(); ++face)
        for (const std::uint32_t id : owned[face]) {
            EXPECT_TRUE(std::ranges::count(faces[face], id) > 0) << "face " << face << " owns " << id;
            seen.insert(id);
        }
    std::set<std::uint32_t> present(faces.items.begin(), faces.items.end());
    present.erase(no_feature);
    EXPECT_TRUE(std::ranges::equal(seen, present));
}

TEST(Ownership, IsEven) {
    // A fan around feature 0: one greedy face could own several features.
    FlatLists<std::uint32_t> faces;
    for (std::uint32_t i = 1; i <= 8; ++i)
        faces.append(std::vector<std::uint32_t>{0, i, i % 8 + 1});
    const FlatLists<std::uint32_t> owned = share_features(faces.offsets, faces.items, std::vector<char>(9));
    EXPECT_EQ(owned[0].size(), 2U) << "the first face has 0, and 1 or 2";
    for (std::size_t face = 1; face < 8; ++face)
        EXPECT_EQ(owned[face].size(), 1U);
}

} // namespace
} // namespace chasles
