// URDF and SRDF files: what they say, and one clear error for what they lack.
#include "chasles/robot/urdf_reader.h"

#include "tests/io/message_of.h"

#include <numbers>

namespace chasles::tests {
namespace {

/// A robot of two links and a joint, in which a text is replaced by another one.
class UrdfFile : public FileTest {
protected:
    UrdfFile() {
        write("cube.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                          "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    }
    [[nodiscard]] RobotDescription read(const std::string& text, const std::string& by,
                                        const RobotFiles& files = {}) const {
        std::string content = R"(<?xml version="1.0"?>
<robot name="small" version="1.2">
  <link name="base"/>
  <link name="arm"><visual><geometry><none/></geometry></visual>
    <collision><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><geometry><box size="1 2 3"/></geometry></collision>
  </link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 0 2"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/>
  </joint>
</robot>
)";
        if (const std::size_t at = content.find(text); at != std::string::npos)
            content.replace(at, text.size(), by);
        return robot::read_urdf(write("robot.urdf", content), files);
    }
    [[nodiscard]] std::string refused(const std::string& text, const std::string& by) const {
        return without_folder(message_of([&] { (void)read(text, by); }));
    }
    [[nodiscard]] Polyhedron shape_of(const std::string& geometry, const RobotFiles& files = {}) const {
        return read("<box size=\"1 2 3\"/>", geometry, files).links[1].collisions.at(0).shape;
    }
};

TEST_F(UrdfFile, SaysWhatTheFileSays) {
    const RobotDescription robot = read("", "");
    EXPECT_EQ(robot.name, "small");
    ASSERT_EQ(robot.links.size(), 2U);
    EXPECT_TRUE(robot.links[0].collisions.empty());
    const CollisionDescription& shape = robot.links[1].collisions.at(0);
    EXPECT_EQ(shape.shape.report().upper, Eigen::Vector3d(0.5, 1, 1.5));
    EXPECT_EQ(shape.origin.translation, Eigen::Vector3d(1, 2, 3));
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))
            .toRotationMatrix();
    EXPECT_LT((shape.origin.isometry().linear() - turn).norm(), 1e-15);
    const JointDescription& joint = robot.joints.at(0);
    EXPECT_EQ(joint.type, JointType::revolute);
    EXPECT_EQ(joint.axis, Eigen::Vector3d(0, 0, 2));
    EXPECT_EQ(joint.lower, -1);
    EXPECT_EQ(joint.upper, 2);
    EXPECT_EQ(
        read("rpy=\"0.1 0.2 0.3\"", "quat_xyzw=\"0 0 2 2\"").links[1].collisions[0].origin.isometry().linear()(1, 0),
        1);
}

/// As MoveIt and Pinocchio do: real files misname joints there.
TEST_F(UrdfFile, AJointThatFollowsNoneIsFree) {
    EXPECT_FALSE(read("<axis", "<mimic joint=\"other\"/><axis").joints[0].mimic);
    EXPECT_EQ(refused("<axis", "<mimic joint=\"turn\"/><axis"),
              "robot.urdf:2: <robot small>: robot: turn: mimic: follows itself");
}

TEST_F(UrdfFile, ReadsMeshesWithScales) {
    const Polyhedron mirrored = shape_of("<mesh filename=\"cube.obj\" scale=\"-1 2 3\"/>");
    EXPECT_EQ(mirrored.report().lower, Eigen::Vector3d(-1, 0, 0));
    EXPECT_EQ(mirrored.report().upper, Eigen::Vector3d(0, 2, 3));
    const auto face = mirrored.face(0); // the bottom
    const auto corner = [&](std::size_t i) { return mirrored.vertices()[face[i]]; };
    EXPECT_LT((corner(1) - corner(0)).cross(corner(2) - corner(0)).z(), 0) << "outwards is down";
}

TEST_F(UrdfFile, FindsPackages) {
    std::filesystem::create_directories(path("vendor/arm/meshes"));
    std::filesystem::copy_file(path("cube.obj"), path("vendor/arm/meshes/part.obj"));
    const std::string mesh = "<mesh filename=\"package://arm/meshes/part.obj\"/>";
    EXPECT_EQ(shape_of(mesh, {.packages = {{"arm", path("vendor/arm")}}}).face_count(), 6U);
    std::ofstream(path("vendor/arm/package.xml")) << "<package><name>arm</name></package>";
    EXPECT_NE(refused("<box size=\"1 2 3\"/>", mesh).find("robot.urdf:5: <mesh>: there is no file 'package://arm/"),
              std::string::npos);
    std::filesystem::create_directories(path("arm/meshes"));
    std::filesystem::copy_file(path("cube.obj"), path("arm/meshes/part.obj"));
    EXPECT_EQ(shape_of(mesh).face_count(), 6U) << "a folder of this name beside the file";
    EXPECT_EQ(shape_of("<mesh filename=\"package://other/arm/meshes/part.obj\"/>").face_count(), 6U)
        << "a robot that was copied without the first folder";
    EXPECT_EQ(shape_of("<mesh filename=\"file://" + path("cube.obj").string() + "\"/>").face_count(), 6U);
}

TEST_F(UrdfFile, RefusesWhatIsMissingOrMisnamed) {
    EXPECT_EQ(refused("<robot name", "<machine name").substr(0, 12), "robot.urdf:2");
    EXPECT_EQ(refused("<link name=\"arm\">", "<link>"), "robot.urdf:4: <link>: has no attribute name");
    EXPECT_EQ(refused("name=\"arm\"", "name=\"base\""), "robot.urdf:4: <link base>: there is another one of this name");
    EXPECT_EQ(refused("size=\"1 2 3\"", "size=\"1 2\""), "robot.urdf:5: <box>: size: has 2 numbers instead of 3");
    EXPECT_EQ(refused("size=\"1 2 3\"", "size=\"1 2 nan\""), "robot.urdf:5: <box>: size: 'nan' is not a finite number");
    EXPECT_EQ(refused("size=\"1 2 3\"", "size=\"1 2 0\""),
              "robot.urdf:5: <box>: box: z: must be positive and at most 1e30, and is 0");
    EXPECT_EQ(refused("<box size=\"1 2 3\"/>", "<cone/>"),
              "robot.urdf:5: <cone>: is no mesh, box, cylinder, sphere or capsule");
    EXPECT_EQ(refused("type=\"revolute\"", "type=\"ball\""), "robot.urdf:7: <joint turn>: type: 'ball' is unknown");
    EXPECT_EQ(refused("child link=\"arm\"", "child link=\"leg\""),
              "robot.urdf:7: <joint turn>: child: there is no link 'leg'");
    EXPECT_EQ(refused("<axis xyz=\"0 0 2\"/>", "<axis xyz=\"0 0 0\"/>"), "robot.urdf:7: <joint turn>: axis: is zero");
    EXPECT_EQ(refused("lower=\"-1\"", "lower=\"3\""),
              "robot.urdf:7: <joint turn>: limit: the lower one is above the upper one");
    EXPECT_EQ(refused("</joint>", "").substr(0, 11), "robot.urdf:");
    EXPECT_EQ(refused("<box size=\"1 2 3\"/>", "<mesh filename=\"none.obj\"/>").substr(0, 52),
              "robot.urdf:5: <mesh>: there is no file 'none.obj'; t");
}

TEST_F(UrdfFile, AnSrdfFileSaysWhichPairsAreNotTested) {
    RobotDescription robot = read("", "");
    robot::read_srdf(write("small.srdf", R"(<robot name="small">
  <group name="all"><chain base_link="base" tip_link="arm"/></group>
  <group_state name="up" group="all"><joint name="turn" value="1.5"/></group_state>
  <disable_collisions link1="base" link2="arm" reason="Never"/>
  <disable_collisions link1="base" link2="gripper" reason="Never"/>
</robot>)"),
                     robot);
    ASSERT_EQ(robot.disabled_pairs.size(), 1U) << "this robot has no gripper";
    EXPECT_EQ(robot.disabled_pairs[0].reason, "Never");
    EXPECT_EQ(robot.groups.at(0).joints, std::vector<std::string>{"turn"});
    EXPECT_EQ(Robot(robot).state("up")[0], 1.5);
    EXPECT_EQ(without_folder(message_of([&] {
                  robot::read_srdf(
                      write("bad.srdf", "<robot name=\"small\">\n<disable_collisions link1=\"arm\"/></robot>"), robot);
              })),
              "bad.srdf:2: <disable_collisions>: has no attribute link2");
}

} // namespace
} // namespace chasles::tests
