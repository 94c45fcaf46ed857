#include "scenes/nut_motions.h"

#include "chasles/motion/motion.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::scenes {
namespace {

using std::numbers::pi;

TEST(NutMotions, APathTurnsAndSlidesInEqualSteps) {
    const auto poses = nut_path({.height = 5, .turns = 2, .slide_per_turn = 1.5});
    ASSERT_EQ(poses.size(), 2 * steps_per_turn + 1);
    EXPECT_EQ(poses.front().translation, Eigen::Vector3d(0, 0, 5));
    EXPECT_EQ(poses.back().translation, Eigen::Vector3d(0, 0, 8));
    for (std::size_t step = 0; step + 1 < poses.size(); ++step) {
        const ScrewMotion motion = ScrewMotion::between(poses[step], poses[step + 1]);
        EXPECT_NEAR(motion.angle(), 2 * pi / steps_per_turn, 1e-14);
        EXPECT_NEAR(motion.slide() * motion.axis_direction().z(), 1.5 / steps_per_turn, 1e-14);
        EXPECT_NEAR(motion.axis_direction().z(), 1, 1e-14) << "a positive turn is counter-clockwise seen from the tip";
    }
}

TEST(NutMotions, TheOtherWayRoundThePathGoesBack) {
    const auto poses = nut_path({.turns = -0.5, .slide_per_turn = 2});
    ASSERT_EQ(poses.size(), steps_per_turn / 2 + 1);
    EXPECT_EQ(poses.back().translation.z(), -1);
}

TEST(NutMotions, TheSlideOfAPieceStraysByLessThanAThousandthOfIt) {
    const double max_turn = pi / 18;
    const double stray = slide_deviation(2, max_turn);
    double sampled = 0;
    const ScrewMotion piece = ScrewMotion::between(nut_pose({}, 0), nut_pose({}, 1.0 / 36));
    for (double time = 0; time <= 1; time += 1e-3) {
        sampled = std::max(sampled, std::abs(piece.pose_at(time).translation.z() - time * 2 / 36));
    }
    EXPECT_NEAR(stray, sampled, 1e-9);
    EXPECT_LT(stray, 1e-3 * 2 / 36);
}

} // namespace
} // namespace chasles::scenes
