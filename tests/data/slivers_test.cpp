// Slivers of real gears on motions that are only enclosed: nothing touches, in either order of the bodies. Note 34.
#include "chasles/chasles.h"
#include "tests/data/shared_data.h"

#include <Eigen/Geometry>
#include <numbers>
#include <random>

namespace chasles::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Pose pose_of(const Isometry3d& placed) {
    return {placed.translation(), Eigen::Quaterniond(placed.linear())};
}

/// Each turns about its own axis near a tooth. The distance of the two bodies barely changes.
TEST(RealSlivers, ASliverAndATriangleOnTheirOwnTwists) {
    CHASLES_REQUIRE_DATA("field/16-sliver-on-a-twist");
    const Polyhedron sliver = Polyhedron::load(shared_data("field/16-sliver-on-a-twist/sliver.obj"));
    const Polyhedron triangle = Polyhedron::load(shared_data("field/16-sliver-on-a-twist/triangle.obj"));
    std::mt19937 random(4121);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto any = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
    for (int i = 0; i < 200; ++i) {
        // The same motion for both, up to a slide of a tenth of their distance.
        const Eigen::AngleAxisd turn(unit(random), any().normalized());
        const Isometry3d start = Eigen::Translation3d(any()) * Eigen::AngleAxisd(unit(random), any().normalized());
        const Isometry3d goal = start * Eigen::Translation3d(any()) * turn;
        const Isometry3d near_goal = Eigen::Translation3d(1e-5 * any().normalized()) * goal;
        const Motion first = Motion::twist(pose_of(start), pose_of(goal));
        const Motion second = Motion::twist(pose_of(start), pose_of(near_goal));
        const FirstContact found =
            first_contact({.moving = sliver, .fixed = triangle, .motion = relative(first, second)});
        const FirstContact swapped =
            first_contact({.moving = triangle, .fixed = sliver, .motion = relative(second, first)});
        EXPECT_EQ(found.verdict, Verdict::clear) << i << ", at " << found.time.lower;
        EXPECT_EQ(swapped.verdict, Verdict::clear) << i << ", at " << swapped.time.lower;
    }
}

/// Two equal gears of 20 teeth with a distance of 20.2 mm between their axes, which turn against each other.
TEST(RealSlivers, MeshingGearsStayApartInEitherOrder) {
    CHASLES_REQUIRE_DATA("assembly-factory");
    const Polyhedron gear = Polyhedron::load(shared_data("assembly-factory/factory_gear_small_space_5e-4.obj"));
    constexpr double degree = std::numbers::pi / 180;
    const auto placed = [](double axis, double angle) {
        return pose_of(Eigen::Translation3d(axis, 0, 0) * Eigen::AngleAxisd(angle, Vector3d::UnitZ()) *
                       Eigen::Translation3d(-0.0505, 0, 0));
    };
    std::mt19937 random(4122);
    std::uniform_real_distribution<double> turns(0, 360 * degree);
    for (int i = 0; i < 12; ++i) {
        const double angle = turns(random), next = angle + 5 * degree;
        const Motion one = Motion::twist(placed(0, angle), placed(0, next));
        const Motion other = Motion::twist(placed(0.0202, 189 * degree - angle), placed(0.0202, 189 * degree - next));
        for (const Motion& motion : {relative(one, other), relative(other, one)}) {
            const FirstContact found = first_contact({.moving = gear, .fixed = gear, .motion = motion});
            EXPECT_EQ(found.verdict, Verdict::clear) << "from " << angle << ", at " << found.time.lower;
        }
        if (i > 0)
            continue;
        const LeastDistance least = least_distance({.moving = gear, .fixed = gear, .motion = relative(one, other)});
        EXPECT_GT(least.distance.lower, 50e-6);
        EXPECT_LT(least.distance.upper, 90e-6);
    }
}

} // namespace
} // namespace chasles::test
