// Gears are closed, have teeth of the right thickness, mesh with their play, and refuse wrong sizes.
#include "scenes/spur_gear.h"

#include "chasles/base/invalid_input.h"
#include "chasles/query/first_contact.h"
#include "tests/scenes/mesh_measures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::scenes {
namespace {

using std::numbers::pi;

TEST(SpurGear, IsClosedAndAsThickAsItsPitchCircleSays) {
    for (const SpurGear& size : {SpurGear{}, SpurGear{17, 2, 5, 0.1, 3}, SpurGear{60, 0.5, 1, 0, 0}}) {
        const Polyhedron gear = spur_gear(size);
        EXPECT_EQ(unpaired_edges(gear), 0);
        // half of the pitch circle is teeth, less the play; a tooth has about the area of a strip of this thickness
        const double tooth = 0.5 * (pi * size.module - size.play) * 2.25 * size.module;
        const double root = size.pitch_radius() - 1.25 * size.module;
        const double bore = size.bore_radius == 0 ? 0.5 * size.pitch_radius() : size.bore_radius;
        const double expected = size.width * (pi * (root * root - bore * bore) + double(size.teeth) * tooth);
        EXPECT_NEAR(volume(gear), expected, 0.06 * expected);
        EXPECT_NEAR(gear.report().upper.x(), size.pitch_radius() + size.module, 0.02 * size.module);
    }
}

/// The second gear beside the first one, turned by an angle about its axis.
Pose beside(const SpurGear& first, const SpurGear& second, double angle) {
    return {Eigen::Vector3d(first.pitch_radius() + second.pitch_radius(), 0, 0),
            Eigen::Quaterniond(Eigen::AngleAxisd(meshing_angle(second) + angle, Eigen::Vector3d::UnitZ()))};
}

FirstContact turned(const SpurGear& first, const SpurGear& second, double from, double to) {
    return first_contact(
        {.moving = spur_gear(second),
         .fixed = spur_gear(first),
         .motion = ScrewMotion::between(beside(first, second, from).isometry(), beside(first, second, to).isometry())});
}

TEST(SpurGear, MeshesWithItsPlay) {
    const SpurGear first{.teeth = 20};
    for (const SpurGear& second : {SpurGear{.teeth = 20}, SpurGear{.teeth = 31}}) {
        // each gear gives half of the play to both flanks
        const double play = 0.5 * second.play / second.pitch_radius();
        EXPECT_EQ(turned(first, second, -0.9 * play, 0.9 * play).verdict, Verdict::clear);
        EXPECT_EQ(turned(first, second, 0, 1.6 * play).verdict, Verdict::contact);
        EXPECT_EQ(turned(first, second, 0, -1.6 * play).verdict, Verdict::contact);
    }
}

TEST(SpurGear, RefusesWrongSizes) {
    EXPECT_THROW((void)spur_gear({.teeth = 16}), InvalidInput);
    EXPECT_THROW((void)spur_gear({.module = -1}), InvalidInput);
    EXPECT_THROW((void)spur_gear({.width = 0}), InvalidInput);
    EXPECT_THROW((void)spur_gear({.play = 2}), InvalidInput);
    EXPECT_THROW((void)spur_gear({.bore_radius = 9}), InvalidInput);
    EXPECT_THROW((void)spur_gear({.module = std::nan("")}), InvalidInput);
}

} // namespace
} // namespace chasles::scenes
