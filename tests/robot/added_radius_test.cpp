// Radii that are added: never below the exact sum, and never 0 for what has no faces.
#include "chasles/robot/added_radius.h"

#include "chasles/mesh/primitives.h"
#include "tests/support/refusal.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace chasles::test {
namespace {

TEST(AddedRadius, IsTheSumRoundedUp) {
    EXPECT_EQ(added_radius(0.5, 0.25), 0.75);
    EXPECT_EQ(added_radius(1, 0x1p-60), std::nextafter(1.0, 2.0));
    EXPECT_EQ(added_radius(1, -0x1p-60), 1);
    EXPECT_EQ(added_radius(0, -0.5), -0.5);
}

TEST(AddedRadius, GrowsAndShrinksRoundBodies) {
    EXPECT_EQ(with_added_radius(make_sphere(0.5), 0.25).radius(), 0.75);
    EXPECT_EQ(with_added_radius(make_capsule(0.5, 1), -0.25).radius(), 0.25);
    EXPECT_EQ(with_added_radius(make_box({1, 1, 1}).with_radius(0.5), 0.25).radius(), 0.75);
    EXPECT_EQ(with_added_radius(make_box({1, 1, 1}), -0.25).report().moved_inwards, 0.25);
    const Polyhedron ball = make_sphere(0.5);
    EXPECT_EQ(with_added_radius(ball, 0).vertices().data(), ball.vertices().data());
}

TEST(AddedRadius, MustStayAboveZeroWhereThereAreNoFaces) {
    for (const double added : {-0.06, -0.09})
        EXPECT_TRUE(refusal([&] {
                        (void)with_added_radius(make_capsule(0.06, 1), added);
                    }).starts_with("radius: that of the shape, 0.06, and the added one, -0.0"));
    EXPECT_TRUE(refusal([] { (void)with_added_radius(make_sphere(1), std::nan("")); }).starts_with("radius: "));
}

} // namespace
} // namespace chasles::test
