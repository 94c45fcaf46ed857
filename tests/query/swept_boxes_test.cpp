// Boxes that are told apart never meet, at any time: sampled poses may only refute.
#include "chasles/query/swept_boxes.h"

#include "chasles/motion/screw_motion.h"
#include "chasles/query/time_tree.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

BoxNode random_node(std::mt19937& random, double size) {
    BoxNode node{};
    for (int i = 0; i < 3; ++i) {
        const double middle = uniform(random, -size, size);
        const double half = uniform(random, 0, size);
        node.lower[i] = float(middle - half);
        node.upper[i] = float(middle + half);
    }
    return node;
}

Eigen::Vector3d corner(const BoxNode& node, const Eigen::Vector3d& centre, int i) {
    return centre + Eigen::Vector3d(i & 1 ? node.upper[0] : node.lower[0], i & 2 ? node.upper[1] : node.lower[1],
                                    i & 4 ? node.upper[2] : node.lower[2]);
}

/// Whether some plane normal to one of the six axes separates the boxes at one pose: exact for a pose up to rounding.
bool are_apart_at(const BoxNode& a, const BoxNode& b, const Eigen::Isometry3d& pose, const Eigen::Vector3d& a_centre,
                  const Eigen::Vector3d& b_centre) {
    for (int axis = 0; axis < 6; ++axis) {
        const Eigen::Vector3d direction = axis < 3 ? Eigen::Vector3d::Unit(axis) : pose.linear().col(axis - 3).eval();
        double low[2] = {1e300, 1e300};
        double high[2] = {-1e300, -1e300};
        for (int i = 0; i < 8; ++i) {
            const double heights[2] = {direction.dot(pose * corner(a, a_centre, i)),
                                       direction.dot(corner(b, b_centre, i))};
            for (int body = 0; body < 2; ++body) {
                low[body] = std::min(low[body], heights[body]);
                high[body] = std::max(high[body], heights[body]);
            }
        }
        if (low[0] > high[1] || low[1] > high[0])
            return true;
    }
    return false;
}

TEST(SweptBoxes, BoxesToldApartAreApartAtEverySampledPose) {
    std::mt19937 random(31);
    int apart = 0;
    int still_apart = 0;
    for (int i = 0; i < 2000; ++i) {
        const Eigen::Vector3d a_centre = random_vector(random, 1);
        const Eigen::Vector3d b_centre = random_vector(random, 1);
        const ScrewMotion screw = ScrewMotion::between(random_pose(random, 2, 0.3), random_pose(random, 2, 0.3));
        const auto maps = motion::rounded(motion::control_maps(screw.frame().motion));
        const query::TimeTree times(maps, a_centre, b_centre, elementary::error_scale(maps, 5, 5));
        const double lower = uniform(random, 0, 0.9);
        const double upper = uniform(random, lower, 1);
        const query::TimeInterval interval = times.interval(lower, upper);
        const BoxNode a = random_node(random, 1);
        const BoxNode b = random_node(random, 1);
        if (!interval.boxes.relation(a, b).apart)
            continue;
        ++apart;
        for (int k = 0; k <= 20; ++k) {
            const double time = screw.time_at(lower + (upper - lower) * k / 20);
            if (!are_apart_at(a, b, screw.pose_at(time).isometry(), a_centre, b_centre))
                ADD_FAILURE() << "seed 31, case " << i << ": the boxes meet at time " << time;
            else
                ++still_apart;
        }
    }
    EXPECT_GT(apart, 300);
    EXPECT_LT(apart, 1900);
    EXPECT_EQ(still_apart, 21 * apart);
}

TEST(SweptBoxes, StandingBoxesAreToldApartExactlyWhenTheyAre) {
    std::mt19937 random(32);
    const auto maps = motion::rounded(motion::control_maps(ScrewMotion::between(Pose(), Pose()).frame().motion));
    const query::TimeTree times(maps, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                elementary::error_scale(maps, 5, 5));
    const query::TimeInterval interval = times.interval(0, 1);
    int apart = 0;
    for (int i = 0; i < 2000; ++i) {
        const BoxNode a = random_node(random, 1);
        const BoxNode b = random_node(random, 1);
        bool expected = false;
        for (int k = 0; k < 3; ++k)
            expected = expected || a.lower[k] > b.upper[k] || b.lower[k] > a.upper[k];
        EXPECT_EQ(interval.boxes.relation(a, b).apart, expected) << "seed 32, case " << i;
        EXPECT_EQ(interval.boxes.relation(a, b).travel, 0);
        apart += expected ? 1 : 0;
    }
    EXPECT_GT(apart, 300);
    EXPECT_LT(apart, 1900);
}

TEST(SweptBoxes, TravelIsThatOfTheBoxAndOfItsSpin) {
    const auto relation_under = [](const ScrewMotion& screw) {
        const auto maps = motion::rounded(motion::control_maps(screw.frame().motion));
        const query::TimeTree times(maps, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                    elementary::error_scale(maps, 5, 5));
        const BoxNode node{{-1, -1, -1}, {1, 1, 1}, 0, 1};
        return times.interval(0, 1).boxes.relation(node, node);
    };
    const auto straight = relation_under(ScrewMotion::between(Pose(), shifted(0.5, 0, 0)));
    EXPECT_NEAR(straight.travel, 0.5, 1e-15);
    EXPECT_NEAR(straight.size, 2, 1e-15);
    const auto spin = relation_under(ScrewMotion::between(Pose(), turned({0, 0, 0}, {0, 0, 1}, 0.3)));
    EXPECT_GT(spin.travel, 0.29);
    EXPECT_LT(spin.travel, 0.4);
}

} // namespace
} // namespace chasles::test
