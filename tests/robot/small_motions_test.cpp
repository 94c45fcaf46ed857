// What is proven of two bodies near one configuration holds for samples of the motions, and directions count.
#include "chasles/robot/small_motions.h"

#include "chasles/mesh/primitives.h"
#include "chasles/query/first_contact.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using robot::OverlapSurface;
using robot::SmallMotion;

bool touch(const Polyhedron& moving, const Polyhedron& fixed, const Eigen::Isometry3d& place, double margin) {
    const Pose pose(place.translation(), Eigen::Quaterniond(place.linear()));
    QueryOptions options;
    options.margin = margin;
    return first_contact({.moving = moving, .fixed = fixed, .motion = Motion::at_rest(pose), .options = options})
               .verdict != Verdict::clear;
}

/// An open surface in the plane z = 0.
Polyhedron sheet(double width, double height) {
    const double x = width / 2, y = height / 2;
    const std::vector<Vector3d> vertices{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
    return Polyhedron::from_polygons(vertices, std::vector<std::vector<std::uint32_t>>{{0, 1, 2, 3}});
}

/// One turn and one slide, of a moving body with this radius around its origin.
struct TurnAndSlide {
    Vector3d axis, origin, direction;
    double turn, slide;

    [[nodiscard]] SmallMotion motion(const Eigen::Isometry3d& place, double radius, double size_of_fixed) const {
        SmallMotion motion;
        motion.steps = {{direction, Vector3d::Zero(), slide, false}, {axis, origin, turn, true}};
        const double reach = (place.translation() - origin).norm() + radius;
        motion.way_of_moving = turn * reach + slide;
        motion.rest_of_moving = 0.5 * turn * turn * reach;
        const double back = origin.norm() + size_of_fixed + slide;
        motion.way_of_fixed = slide + turn * back;
        motion.rest_of_fixed = turn * (slide + 0.5 * turn * back);
        return motion;
    }
    /// The slide is nearer to the fixed body.
    [[nodiscard]] Eigen::Isometry3d at(double angle, double way) const {
        return Eigen::Translation3d(way * direction) * Eigen::Translation3d(origin) * Eigen::AngleAxisd(angle, axis) *
               Eigen::Translation3d(-origin);
    }
};

TEST(SmallMotions, SamplesRefuteNeitherProof) {
    Random random(4004);
    int apart = 0, together = 0;
    std::mt19937 shapes(4004);
    for (int round = 0; round < 1500; ++round) {
        const auto shape = [&] {
            return random.chance(0.3)   ? make_sphere(random.uniform(0.2, 0.6))
                   : random.chance(0.2) ? sheet(random.uniform(0.5, 3), random.uniform(0.5, 3))
                   : random.chance(0.5)
                       ? random_octahedron(shapes).polyhedron()
                       : make_box({random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2)});
        };
        const Polyhedron moving = shape(), fixed = shape();
        const OverlapSurface first(moving), second(fixed);
        const Pose pose = random_pose(random, 1.5);
        const Eigen::Isometry3d place = Pose(pose.translation, pose.rotation.normalized()).isometry();
        const TurnAndSlide joints{random_point(random, 1).normalized(), random_point(random, 1),
                                  random_point(random, 1).normalized(), random.uniform(0, 0.3), random.uniform(0, 0.2)};
        const double radius = moving.body().bvh().centre().norm() + moving.body().ball_radius();
        const SmallMotion motion =
            joints.motion(place, radius, fixed.body().bvh().centre().norm() + fixed.body().ball_radius());
        const double margin = random.chance(0.3) ? random.uniform(0, 0.2) : 0;
        const robot::PairAtRest pair{first, second, place, motion, margin};
        const bool are_apart = !robot::near_faces(pair), are_together = robot::stay_in_touch(pair);
        apart += are_apart;
        together += are_together;
        for (int i = 0; i < 12 && (are_apart || are_together); ++i) {
            const auto share = [&] {
                return random.chance(0.5) ? (random.chance(0.5) ? 1 : -1) : random.uniform(-1, 1);
            };
            const Eigen::Isometry3d moved = joints.at(share() * joints.turn, share() * joints.slide) * place;
            EXPECT_EQ(touch(moving, fixed, moved, margin), are_together) << round;
        }
    }
    EXPECT_GT(apart, 200);
    EXPECT_GT(together, 150);
}

/// A plate slides a long way over another one, at a small gap.
TEST(SmallMotions, OnlyTheDirectionOfTheGapCounts) {
    const Polyhedron plate = make_box({1, 1, 0.1});
    const OverlapSurface surface(plate);
    const auto apart = [&](double gap, const Vector3d& direction) {
        SmallMotion motion;
        motion.steps = {{direction, Vector3d::Zero(), 5, false}};
        motion.way_of_moving = motion.way_of_fixed = 5;
        return !robot::near_faces({surface, surface, shifted(0.2, 0.1, 0.1 + gap).isometry(), motion});
    };
    EXPECT_TRUE(apart(1e-3, Vector3d::UnitX()));
    EXPECT_FALSE(apart(1e-3, Vector3d::UnitZ()));
    EXPECT_FALSE(apart(1e-3, Vector3d(1, 0, 1e-3).normalized()));
    EXPECT_TRUE(apart(1e-3, Vector3d(1, 0, 1e-4).normalized()));
}

/// Surfaces far from each other say nothing of what is inside.
TEST(SmallMotions, WhatIsInsideTouches) {
    const Polyhedron inner = make_box({0.1, 0.1, 0.1}), outer = make_box({2, 2, 2});
    const OverlapSurface first(inner), second(outer);
    const SmallMotion motion{.steps = {}, .rest_of_moving = 0.3, .rest_of_fixed = 0.3};
    const Eigen::Isometry3d place = shifted(0.2, 0, 0).isometry();
    EXPECT_TRUE(robot::near_faces({first, second, place, motion}));
    EXPECT_TRUE(robot::near_faces({second, first, place.inverse(), motion}));
    EXPECT_TRUE(robot::stay_in_touch({first, second, place, motion}));
    EXPECT_TRUE(robot::stay_in_touch({second, first, place.inverse(), motion}));
}

/// Neither sheet has a point inside of the other one. The second one stands across the first one.
TEST(SmallMotions, AnEdgeStaysInTheFaceThatItPassesThrough) {
    const Polyhedron lying = sheet(1, 1), standing = sheet(1, 1);
    const OverlapSurface first(standing), second(lying);
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity(); // x = 0, y in [-0.4, 0.6], z in [-0.3, 0.7]
    place.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    place.translation() = Vector3d(0, 0.1, 0.2);
    const auto touch = [&](const Vector3d& direction, double way) {
        SmallMotion motion;
        motion.steps = {{direction, Vector3d::Zero(), way, false}};
        motion.way_of_moving = motion.way_of_fixed = way;
        SmallMotion back = motion;
        back.steps[0].axis = place.linear().transpose() * direction;
        const bool found = robot::stay_in_touch({first, second, place, motion});
        EXPECT_EQ(robot::stay_in_touch({second, first, place.inverse(), back}), found);
        return found;
    };
    EXPECT_TRUE(touch(Vector3d::UnitZ(), 0.29));
    EXPECT_FALSE(touch(Vector3d::UnitZ(), 0.31));
    EXPECT_TRUE(touch(Vector3d::UnitX(), 0.49));
    EXPECT_FALSE(touch(Vector3d::UnitX(), 0.51));
    EXPECT_TRUE(touch(Vector3d::UnitY(), 0.09)); // an edge at y = -0.4 stays above the face
    EXPECT_FALSE(touch(Vector3d::UnitY(), 0.91));
}

} // namespace
} // namespace chasles::test
