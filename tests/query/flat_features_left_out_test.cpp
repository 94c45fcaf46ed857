// Triangles of flat sides change no answer: bodies whose faces are cut into coplanar triangles against the bodies as
// they were.
#include "tests/query/bodies.h"
#include "tests/support/grid.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// A box with n by n cells of two triangles on each side, at multiples of a power of two.
Polyhedron cut_box(const Eigen::Vector3d& half, std::uint32_t n) {
    Body body;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const double sign = side % 2 == 0 ? 1 : -1;
        const auto first = static_cast<std::uint32_t>(body.vertices.size());
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t j = 0; j <= n; ++j) {
                Eigen::Vector3d at;
                at[axis] = sign * half[axis];
                at[(axis + 1) % 3] = half[(axis + 1) % 3] * (2.0 * i / n - 1);
                at[(axis + 2) % 3] = half[(axis + 2) % 3] * (2.0 * j / n - 1);
                body.vertices.push_back(at);
            }
        for (std::vector<std::uint32_t> face : grid_triangles(n, n)) {
            for (std::uint32_t& corner : face)
                corner += first;
            body.faces.push_back(face);
        }
    }
    return body.polyhedron();
}

class FlatFeaturesLeftOut : public testing::TestWithParam<double> {};

TEST_P(FlatFeaturesLeftOut, TimesAreThoseOfTheBodiesBefore) {
    std::mt19937 random(19);
    const Eigen::Vector3d half(0.5, 1, 0.75);
    const Polyhedron plain = box(half).polyhedron();
    const Polyhedron cut = cut_box(half, 4);
    EXPECT_EQ(cut.report().distinct_vertices, 98U);
    int contacts = 0, at_start = 0;
    for (int i = 0; i < 300; ++i) {
        const Motion motion = ScrewMotion::between(random_pose(random, 3, 3), random_pose(random, 1, 3));
        const QueryOptions options{.margin = GetParam()};
        const FirstContact before =
            first_contact({.moving = plain, .fixed = plain, .motion = motion, .options = options});
        for (const auto& [moving, fixed] : {std::pair(cut, plain), std::pair(plain, cut), std::pair(cut, cut)}) {
            const FirstContact found =
                first_contact({.moving = moving, .fixed = fixed, .motion = motion, .options = options});
            EXPECT_EQ(found.verdict, before.verdict) << i;
            EXPECT_TRUE(found.certain || !before.certain) << i;
            EXPECT_NEAR(found.time.lower, before.time.lower, 3e-12) << i;
        }
        contacts += before.verdict == Verdict::contact ? 1 : 0;
        at_start += before.verdict == Verdict::contact_at_start ? 1 : 0;
    }
    EXPECT_GT(contacts, 60);
    EXPECT_GT(at_start, 5);
}
INSTANTIATE_TEST_SUITE_P(TouchAndMargin, FlatFeaturesLeftOut, testing::Values(0.0, 0.05));

/// A triangle in the plane of the diagonal crosses the plate on this flat edge only.
TEST(FlatFeaturesLeftOutAtTheStart, AnEdgeThroughAFlatEdgeIsAnOverlap) {
    const Polyhedron plate =
        Body{{{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}}.polyhedron();
    const Polyhedron needle = triangle({0, 0, -1}, {0, 0, 1}, {0.5, 0.5, 3}).polyhedron();
    for (const double margin : {0.0, 0.01}) {
        const FirstContact found = first_contact({.moving = needle,
                                                  .fixed = plate,
                                                  .motion = ScrewMotion::between(shifted(1, 1, 0), shifted(2, 2, 0)),
                                                  .options = {.margin = margin}});
        EXPECT_EQ(found.verdict, Verdict::contact_at_start);
        EXPECT_TRUE(found.certain);
        EXPECT_TRUE(found.overlap);
    }
}

} // namespace
} // namespace chasles::test
