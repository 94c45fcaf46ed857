// Invalid input of a motion is refused with its name, for every way to pass it.
#include "chasles/motion/motion.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <cfenv>
#include <limits>

namespace chasles {
namespace {

using namespace test;

/// A pose whose members are set without its constructor.
Pose by_hand(const Eigen::Vector3d& translation, const Eigen::Vector4d& xyzw) {
    Pose pose;
    pose.translation = translation;
    pose.rotation.coeffs() = xyzw;
    return pose;
}

TEST(RefusedMotions, PosesFilledInByHandAreCheckedAsWell) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Eigen::Vector4d none(0, 0, 0, 1);
    for (const Pose& bad : {by_hand({0, 0, 0}, {0, 0, 0, 0}), by_hand({0, 0, 0}, {0, nan, 0, 1}),
                            by_hand({nan, 0, 0}, none), by_hand({1e300, 0, 0}, none)}) {
        const Pose good;
        EXPECT_NE(refusal([&] { (void)ScrewMotion::between(bad, good); }), "accepted");
        EXPECT_NE(refusal([&] { (void)ScrewMotion::between(good, bad); }), "accepted");
        EXPECT_NE(refusal([&] { (void)ScrewMotion::relative(good, good, bad, good); }), "accepted");
        EXPECT_NE(refusal([&] { (void)SweepMotion::relative(good, bad, good, good); }), "accepted");
        EXPECT_NE(refusal([&] { (void)SweepMotion::relative(good, good, good, bad); }), "accepted");
    }
}

TEST(RefusedMotions, QuaternionsSetByHandMayHaveAnyLength) {
    Random random(661);
    for (const double length : {1e-320, 1e-300, 1e-160, 1e160, 1e300}) {
        const Pose start = test::random_pose(random, 3);
        const Eigen::Vector4d unit = random_goal(random, start, 0.7, 0).rotation.coeffs().normalized();
        const auto screw = ScrewMotion::between(start, by_hand({1, 2, 3}, unit * length));
        EXPECT_NEAR(screw.angle(), 0.7, length < 1e-310 ? 1e-3 : 1e-14) << length;
    }
}

TEST(RefusedMotions, CentresOfSweepsHaveTheRangeOfMeshes) {
    EXPECT_NE(refusal([] {
                  (void)SweepMotion::between(Pose(), Pose(), {0, 2e30, 0});
              }).find("larger than 1e30"),
              std::string::npos);
    EXPECT_EQ(refusal([] { (void)SweepMotion::between(Pose(), Pose(), {0, 1e30, 0}); }), "accepted");
}

TEST(RefusedMotions, OtherRoundingThanToNearestIsRefused) {
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        const std::string screw = refusal([] { (void)ScrewMotion::between(Pose(), Pose()); });
        const std::string sweep = refusal([] { (void)SweepMotion::between(Pose(), Pose()); });
        std::fesetround(FE_TONEAREST);
        EXPECT_NE(screw.find("must round to nearest"), std::string::npos) << mode;
        EXPECT_NE(sweep.find("must round to nearest"), std::string::npos) << mode;
    }
    EXPECT_EQ(refusal([] { (void)ScrewMotion::between(Pose(), Pose()); }), "accepted");
}

} // namespace
} // namespace chasles
