// What files and configurations of a robot get warnings for.
#include "tests/robot/urdf_file.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

class RobotWarnings : public tests::UrdfFile {
protected:
    [[nodiscard]] std::vector<std::string> of_srdf(const std::string& content) const {
        RobotDescription robot = read("", "");
        robot::read_srdf(write("robot.srdf", "<robot name=\"small\">\n" + content + "\n</robot>"), robot);
        const Robot made(robot);
        std::vector<std::string> warnings;
        for (const std::string& warning : made.warnings())
            warnings.push_back(without_folder(warning));
        return warnings;
    }
    using Texts = std::vector<std::string>;
};

/// Other programs may cut them otherwise.
TEST_F(RobotWarnings, PolygonsWithoutAPlaneAreCounted) {
    write("bent.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0.25\nv 0 2 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n");
    const std::string mesh = R"(<mesh filename="bent.obj"/>)";
    const RobotDescription robot = read("<box size=\"1 2 3\"/>", mesh);
    ASSERT_EQ(robot.warnings.size(), 1U);
    EXPECT_NE(robot.warnings[0].find("bent.obj: 1 polygon leaves its plane by 0.06"), std::string::npos)
        << robot.warnings[0];
    const Polyhedron& shape = robot.links[1].collisions.at(0).shape;
    for (std::size_t face = 0; face < shape.face_count(); ++face)
        EXPECT_EQ(std::ranges::count(shape.face(face), 0U), 1) << "the first corner is in each triangle";
    write("bent.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0.000001\nv 0 2 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n");
    EXPECT_TRUE(read("<box size=\"1 2 3\"/>", mesh).warnings.empty()) << "six digits in a file";
}

TEST_F(RobotWarnings, ThereAreNoneForARobotThatIsRight) {
    EXPECT_TRUE(Robot(read("", "")).warnings().empty());
    EXPECT_EQ(of_srdf(R"(<virtual_joint name="floor" type="fixed" parent_frame="world" child_link="base"/>
        <group name="all"><joint name="turn"/><joint name="floor"/><link name="base"/>
        <chain base_link="base" tip_link="arm"/></group><group name="more"><group name="all"/></group>
        <group_state name="home" group="all"><joint name="turn" value="0"/><joint name="floor" value="0"/></group_state>
        <disable_collisions link1="base" link2="arm"/>)"),
              Texts());
}

TEST_F(RobotWarnings, NameWhatTheRobotHasNot) {
    const std::string by = "robot.srdf:2: <";
    EXPECT_EQ(of_srdf(R"(<disable_collisions link1="base" link2="table"/>)"),
              Texts({by + "disable_collisions>: there is no link 'table'"}));
    EXPECT_EQ(of_srdf(R"(<disable_collisions link1="a" link2="b"/><disable_collisions link1="a" link2="arm"/>)"),
              Texts({by + "disable_collisions>: there is no link 'a'; it is named 2 times",
                     by + "disable_collisions>: there is no link 'b'"}));
    EXPECT_EQ(of_srdf(R"(<disable_default_collisions link="x"/>)"),
              Texts({by + "disable_default_collisions>: there is no link 'x'"}));
    EXPECT_EQ(of_srdf(R"(<group name="g"><joint name="spin"/><link name="leg"/><group name="h"/>
<chain base_link="base" tip_link="foot"/></group>)"),
              Texts({by + "group h>: there is no group 'h'", by + "joint spin>: there is no joint 'spin'",
                     "robot.srdf:3: <chain>: there is no link 'foot'", by + "link leg>: there is no link 'leg'"}));
    EXPECT_EQ(
        of_srdf(R"(<group_state name="home" group="none"><joint name="knee" value="1"/></group_state>)"),
        Texts({by + "group_state home>: there is no group 'none'", by + "joint knee>: there is no joint 'knee'"}));
}

/// Robots of one maker have links of the same names.
TEST_F(RobotWarnings, TheSRDFFileOfAnotherRobotIsNamed) {
    RobotDescription robot = read("", "");
    robot::read_srdf(
        write("robot.srdf", "<robot name=\"large\"><disable_collisions link1=\"base\" link2=\"arm\"/></robot>"), robot);
    ASSERT_EQ(robot.warnings.size(), 1U);
    EXPECT_EQ(without_folder(robot.warnings[0]),
              "robot.srdf:1: <robot large>: is the file of another robot: this one is named 'small'");
    EXPECT_EQ(robot.disabled_pairs.size(), 1U);
    RobotDescription unnamed = read("", "");
    robot::read_srdf(write("robot.srdf", "<robot/>"), unnamed);
    EXPECT_TRUE(unnamed.warnings.empty());
}

TEST_F(RobotWarnings, AMisspeltElementOfAnSRDFFileIsRefused) {
    for (const char* const wrong :
         {"disable_collision", "Disable_collisions", "enable_colisions", "groups", "goup_state"})
        EXPECT_EQ(without_folder(refusal([&] {
                      (void)of_srdf(std::string("<") + wrong + " link1=\"base\" link2=\"arm\"/>");
                  })).find("is not read; if <"),
                  std::string("robot.srdf:2: <>: ").size() + std::string(wrong).size());
}

/// Its root has the same name, and it has no pair.
TEST_F(RobotWarnings, AURDFFileIsNoSRDFFile) {
    EXPECT_EQ(without_folder(refusal([&] { (void)of_srdf("<link name=\"a\"><visual/></link>"); })),
              "robot.srdf:2: <link a>: is a link of a URDF file, and the SRDF file is needed");
    const std::string joint = R"(<joint name="j"><parent link="a"/><child link="b"/></joint>)";
    EXPECT_EQ(without_folder(refusal([&] { (void)of_srdf("<link name=\"a\"/>" + joint); })),
              "robot.srdf:2: <joint j>: is a joint of a URDF file, and the SRDF file is needed");
}

TEST_F(RobotWarnings, LimitsInTheWrongOrderAreNone) {
    const RobotDescription robot = read("lower=\"-1\"", "lower=\"3\"");
    EXPECT_EQ(robot.joints[0].lower, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(robot.joints[0].upper, std::numeric_limits<double>::infinity());
    ASSERT_EQ(robot.warnings.size(), 1U);
    EXPECT_EQ(
        without_folder(robot.warnings[0]),
        "robot.urdf:7: <joint turn>: limit: the lower one, 3, is above the upper one, 2: the joint has no limits");
    EXPECT_EQ(Robot(robot).neutral()[0], 0);
}

TEST_F(RobotWarnings, LimitsOfJointsWithSeveralVariablesAreNotRead) {
    for (const char* const type : {"planar", "floating"}) {
        const RobotDescription robot = read("revolute", type);
        ASSERT_EQ(robot.warnings.size(), 1U) << type;
        EXPECT_EQ(without_folder(robot.warnings[0]),
                  "robot.urdf:7: <joint turn>: limit: is not read: the joint has several variables");
    }
}

TEST_F(RobotWarnings, AJointThatFollowsNoneIsNamed) {
    const RobotDescription robot = read("<axis xyz=\"0 0 2\"/>", "<axis xyz=\"0 0 2\"/><mimic joint=\"knee\"/>");
    ASSERT_EQ(robot.warnings.size(), 1U);
    EXPECT_EQ(without_folder(robot.warnings[0]),
              "robot.urdf:7: <joint turn>: mimic: there is no joint 'knee': the joint follows none");
}

TEST_F(RobotWarnings, AFileOfAMissingPackageIsNamed) {
    std::filesystem::create_directories(path("meshes"));
    std::filesystem::copy_file(path("cube.obj"), path("meshes/a.obj"));
    std::filesystem::copy_file(path("cube.obj"), path("meshes/b.obj"));
    const std::string collision = "</geometry></collision><collision><geometry>";
    const std::string a = R"(<mesh filename="package://other/meshes/a.obj"/>)",
                      b = R"(<mesh filename="package://other/meshes/b.obj"/>)";
    const RobotDescription robot = read("<box size=\"1 2 3\"/>", a + collision + a + collision + b);
    ASSERT_EQ(robot.warnings.size(), 1U);
    EXPECT_EQ(
        without_folder(robot.warnings[0]),
        "robot.urdf:5: <mesh>: there is no package 'other': took the file meshes/a.obj, and 1 more; say where the "
        "package is by --packages other=FOLDER (in Python: packages={'other': FOLDER})");
    const RobotFiles files = {.packages = {{"other", path("")}}};
    EXPECT_EQ(read("<box size=\"1 2 3\"/>", a, files).warnings, Texts());
}

TEST_F(RobotWarnings, AGivenPackageThatNoMeshIsOfIsNamed) {
    const RobotFiles files = {.packages = {{"foo", "none"}, {"small", path("")}}};
    EXPECT_EQ(read("", "", files).warnings,
              Texts({"packages: no collision shape has a mesh of 'foo', and there is no folder none",
                     "packages: no collision shape has a mesh of 'small'"}));
}

TEST_F(RobotWarnings, LimitsThatAreLeftOutLockAJoint) {
    const std::string both = "lower=\"-1\" upper=\"2\"";
    const RobotDescription robot = read(both, "");
    ASSERT_EQ(robot.warnings.size(), 1U);
    EXPECT_EQ(without_folder(robot.warnings[0]),
              "robot.urdf:9: <limit>: has no lower and no upper: both are 0, as URDF says");
    EXPECT_EQ(robot.joints[0].upper, 0);
    EXPECT_EQ(read(both, "upper=\"2\"").warnings, Texts()) << "a range from 0";
}

TEST_F(RobotWarnings, ConfigurationsBeyondLimitsAndInDegrees) {
    const auto about = [](const RobotDescription& robot, const std::vector<double>& values) {
        std::vector<Configuration> rows;
        for (const double value : values)
            rows.emplace_back(Configuration::Constant(1, value));
        return Robot(robot).warnings_about(rows);
    };
    const RobotDescription turning = read("", "");
    EXPECT_EQ(about(turning, {-1, 0, 2, 2.0000001}), Texts());
    EXPECT_EQ(about(turning, {0, 2.5, 0}), Texts({"turn: 2.5 in configuration 1 is beyond the limits [-1, 2]"}));
    EXPECT_EQ(about(turning, {-3, 2.5, -4}),
              Texts({"turn: -4 in configuration 2 is beyond the limits [-1, 2], as 2 more"}));
    EXPECT_EQ(about(turning, {0, 45, 90}),
              Texts({"turn: 90 in configuration 2 looks like degrees; angles are in radians, as 1 more"}));
    const RobotDescription wheel = read("type=\"revolute\"", "type=\"continuous\"");
    EXPECT_EQ(about(wheel, {0, 7, -12}), Texts()) << "nearly two turns";
    EXPECT_EQ(about(wheel, {180}), Texts({"turn: 180 in configuration 0 looks like degrees; angles are in radians"}));
    const RobotDescription slide = read("type=\"revolute\"", "type=\"prismatic\"");
    EXPECT_EQ(about(slide, {90}), Texts({"turn: 90 in configuration 0 is beyond the limits [-1, 2]"}));
    const RobotDescription far = read("upper=\"2\"", "upper=\"50\"");
    EXPECT_EQ(about(far, {45}), Texts()) << "a winch";
    EXPECT_EQ(refusal([&] { (void)Robot(turning).warnings_about(std::array{Configuration(Configuration::Zero(2))}); }),
              "robot: configuration: has 2 values, and the robot has 1 variables");
}

} // namespace
} // namespace chasles::test
