// Poses as text: 3, 7 or 16 numbers, separated by blanks or commas. Any other text is refused with a reason.
#include "chasles/io/pose_text.h"
#include "tests/io/message_of.h"

namespace chasles::io {
namespace {

using tests::message_of;

std::string message(const std::string& text) {
    return message_of([&] { (void)parse_pose(text); });
}

TEST(ParsePose, TakesBlanksAndCommas) {
    for (const char* const text : {"-.5 0 1e-3", "-.5,0,1e-3", " -.5 , 0,\t1e-3 ", "-.5\n0\n1e-3\n"})
        EXPECT_EQ(parse_pose(text).translation, Eigen::Vector3d(-0.5, 0, 1e-3)) << text;
}

TEST(ParsePose, TakesPositionAlone) {
    const Pose pose = parse_pose("1 2 3");
    EXPECT_EQ(pose.translation, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(pose.rotation.coeffs(), Eigen::Quaterniond::Identity().coeffs());
}

TEST(ParsePose, TakesQuaternionsOfAnyLengthWithTheRealPartFirst) {
    const Pose pose = parse_pose("1 2 3 0 0 0 2");
    EXPECT_TRUE(pose.rotation.normalized().isApprox(Eigen::Quaterniond(0, 0, 0, 1)));
}

TEST(ParsePose, TakesMatricesRowByRow) {
    const Pose pose = parse_pose("0 -1 0 4  1 0 0 5  0 0 1 6  0 0 0 1");
    EXPECT_EQ(pose.translation, Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(pose.isometry().linear() * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());
}

TEST(ParsePose, RefusesOtherCounts) {
    const std::string allowed = " found; a pose has 3 (x y z), 7 (x y z qw qx qy qz) or 16 (4x4, row by row)";
    EXPECT_EQ(message(""), "0 numbers" + allowed);
    EXPECT_EQ(message("1"), "1 number" + allowed);
    EXPECT_EQ(message("1 2 3 4"), "4 numbers" + allowed);
}

TEST(ParsePose, RefusesWhatIsNoNumber) {
    EXPECT_EQ(message("1 2 z"), "not a number: 'z'");
    EXPECT_EQ(message("1 2 nan"), "not a finite number: 'nan'");
    EXPECT_EQ(message("1 2 -inf"), "not a finite number: '-inf'");
    EXPECT_EQ(message("1 2 1e999"), "not a finite number: '1e999'");
    EXPECT_EQ(message("1,,3"), "a number is missing before or after a comma");
    EXPECT_EQ(message("1,2,3,"), "a number is missing before or after a comma");
    EXPECT_EQ(message(",1,2,3"), "a number is missing before or after a comma");
    EXPECT_EQ(message("1;2;3"), "not a number: '1;2;3'");
}

TEST(ParsePose, RefusesWhatIsNoDisplacement) {
    EXPECT_TRUE(message("0 0 0 0 0 0 0").starts_with("pose: quaternion: "));
    EXPECT_TRUE(message("1 0 0 0  0 2 0 0  0 0 1 0  0 0 0 1").starts_with("pose: matrix: ")) << "stretches";
    EXPECT_TRUE(message("1 0 0 0  0 -1 0 0  0 0 1 0  0 0 0 1").starts_with("pose: matrix: ")) << "mirrors";
    EXPECT_TRUE(message("1 0 0 0  0 1 0 0  0 0 1 0  0 0 1 1").starts_with("pose: matrix: ")) << "last row";
}

TEST(ParsePoint, TakesThreeNumbers) {
    EXPECT_EQ(parse_point("1,-2 3"), Eigen::Vector3d(1, -2, 3));
    EXPECT_EQ(message_of([] { (void)parse_point("1 2"); }), "2 numbers found; a point has 3 (x y z)");
}

} // namespace
} // namespace chasles::io
