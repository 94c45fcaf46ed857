// Groups contain each face once, in order, and do not depend on the number of threads.
#include "chasles/hierarchy/group_faces.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace chasles {
namespace {

PackedBox point(float x, float y, float z) {
    return {{x, y, z, 0}, {x, y, z, 0}};
}

std::vector<PackedBox> random_points(std::size_t count) {
    std::mt19937 random(20240601);
    const auto draw = [&] { return float(random()) * 0x1p-32F; };
    std::vector<PackedBox> points;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back(point(draw(), draw(), draw()));
    return points;
}

/// Faces of one vertex each.
FlatLists<std::uint32_t> one_face_each(std::size_t count) {
    FlatLists<std::uint32_t> outlines;
    for (std::uint32_t i = 0; i < count; ++i)
        outlines.append(std::array{i});
    return outlines;
}

TEST(PlaneTree, WithoutASampleIsOneGroup) {
    const PlaneTree planes{{}};
    EXPECT_EQ(planes.group_count(), 1U);
    EXPECT_EQ(planes.group_of(point(1, 2, 3)), 0U);
}

TEST(PlaneTree, EveryGroupHoldsAPartOfTheSample) {
    const std::vector<PackedBox> sample = random_points(10'000);
    const PlaneTree planes(sample);
    EXPECT_GT(planes.group_count(), 10'000U / 256);
    std::vector<std::size_t> held(planes.group_count(), 0);
    for (const PackedBox& box : sample)
        ++held[planes.group_of(box)];
    EXPECT_GT(std::ranges::min(held), 0U);
    EXPECT_LE(std::ranges::max(held), 256U);
}

TEST(PlaneTree, OfEqualCentresIsOneGroup) {
    const PlaneTree planes(std::vector<PackedBox>(10'000, point(1, 2, 3)));
    EXPECT_EQ(planes.group_count(), 1U);
}

TEST(GroupFaces, FewAreOneGroup) {
    const std::vector<PackedBox> points = random_points(fewest_to_group - 1);
    const FlatLists<std::uint32_t> outlines = one_face_each(points.size());
    EXPECT_EQ(group_faces({outlines, points}, 0).faces.size(), 1U);
}

TEST(GroupFaces, EachIsInTheGroupOfItsBoxAndGroupsAreInOrder) {
    const std::vector<PackedBox> points = random_points(3 * fewest_to_group + 17);
    const FlatLists<std::uint32_t> outlines = one_face_each(points.size());
    const FaceGroups groups = group_faces({outlines, points}, 2);
    ASSERT_GT(groups.faces.size(), 1U);
    EXPECT_EQ(groups.faces.items.size(), points.size());
    for (std::uint32_t group = 0; group < groups.faces.size(); ++group) {
        const auto faces = groups.faces[group];
        EXPECT_TRUE(std::ranges::is_sorted(faces, std::ranges::less_equal()));
        for (const std::uint32_t face : faces)
            EXPECT_EQ(groups.planes.group_of(points[face]), group);
    }
}

/// A grid whose rows have as many faces as lie between two samples. With regular samples, all samples would be in one
/// column.
TEST(GroupFaces, SamplesAreDrawnFromAllColumnsOfAGrid) {
    std::vector<PackedBox> points;
    for (std::size_t i = 0; i < 4 * fewest_to_group; ++i)
        points.push_back(point(float(i % 16), 1e-6F * float(i / 16), 0));
    const FlatLists<std::uint32_t> outlines = one_face_each(points.size());
    const FaceGroups groups = group_faces({outlines, points}, 1);
    EXPECT_NE(groups.planes.group_of(points[0]), groups.planes.group_of(points[15]));
}

} // namespace
} // namespace chasles
