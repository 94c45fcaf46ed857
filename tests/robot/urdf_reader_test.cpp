// URDF and SRDF files: their contents, and one clear error for each fault.
#include "chasles/robot/urdf_reader.h"

#include "tests/robot/urdf_file.h"

#include <numbers>

namespace chasles::tests {
namespace {

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
    EXPECT_EQ(refused("<axis", "<mimic joint=\"turn\"/><axis"), "robot.urdf:7: <joint turn>: mimic: follows itself");
    EXPECT_EQ(refused("</robot>", R"(<link name="tool"/>
<joint name="held" type="prismatic"><parent link="arm"/><child link="tool"/><limit lower="0" upper="1"/>
<mimic joint="mount"/></joint>
<link name="plate"/><joint name="mount" type="fixed"><parent link="tool"/><child link="plate"/></joint></robot>)"),
              "robot.urdf:12: <joint held>: mimic: 'mount' is fixed: it has no value that a joint can follow");
    EXPECT_EQ(refused("</robot>", R"(<link name="tool"/><link name="plate"/>
<joint name="held" type="prismatic"><parent link="arm"/><child link="tool"/><limit lower="0" upper="1"/>
<mimic joint="free"/></joint>
<joint name="free" type="floating"><parent link="tool"/><child link="plate"/></joint></robot>)"),
              "robot.urdf:12: <joint held>: mimic: 'free' is floating: it has several values, and a joint can follow "
              "only one");
    EXPECT_EQ(refused("type=\"revolute\"", "type=\"floating\"><mimic joint=\"turn\"/"),
              "robot.urdf:7: <joint turn>: mimic: a joint with several variables cannot follow another one");
}

/// A joint may follow one that follows another one, and may be written before it.
TEST_F(UrdfFile, JointsFollowOthersInAnyOrder) {
    const Robot robot(read("<joint name=\"turn\"", R"(<link name="tool"/><link name="tip"/>
  <joint name="last" type="prismatic"><parent link="tool"/><child link="tip"/><axis xyz="1 0 0"/>
    <limit lower="-9" upper="9"/><mimic joint="middle" multiplier="2" offset="0.25"/></joint>
  <joint name="middle" type="prismatic"><parent link="arm"/><child link="tool"/><axis xyz="1 0 0"/>
    <limit lower="-9" upper="9"/><mimic joint="turn" multiplier="-1" offset="0.5"/></joint>
  <joint name="turn")"));
    ASSERT_EQ(robot.variables().size(), 1U);
    const double turned = 0.75, middle = 0.5 - turned, last = 2 * middle + 0.25;
    const Pose arm = robot.link_pose("arm", Configuration::Constant(1, turned));
    const Eigen::Vector3d tip = robot.link_pose("tip", Configuration::Constant(1, turned)).translation;
    EXPECT_LT((tip - arm.isometry() * Eigen::Vector3d(middle + last, 0, 0)).norm(), 1e-15);
}

/// ARMAR-4 has spheres of radius 0, as placeholders.
TEST_F(UrdfFile, ShapesWithoutExtentAreThin) {
    const auto read_shape = [&](const std::string& geometry) {
        return read("<box size=\"1 2 3\"/>", geometry).links[1].collisions.at(0);
    };
    const auto reach = [](const CollisionDescription& c) -> Eigen::Vector3d { return c.shape.report().upper; };
    for (const char* const nothing :
         {"<sphere radius=\"0\"/>", "<box size=\"0 0 0\"/>", "<cylinder radius=\"0\" length=\"0\"/>",
          "<capsule radius=\"0\" length=\"0\"/>"}) {
        const CollisionDescription point = read_shape(nothing);
        EXPECT_GT(reach(point).minCoeff(), 0) << nothing;
        EXPECT_LE(reach(point).maxCoeff(), point.deviation) << nothing;
        EXPECT_LE(point.deviation, 2e-6) << nothing;
    }
    const CollisionDescription plate = read_shape("<box size=\"1 2 0\"/>");
    EXPECT_EQ(reach(plate), Eigen::Vector3d(0.5, 1, 0.5e-6));
    EXPECT_NEAR(plate.deviation, 0.5e-6, 1e-20);
    const CollisionDescription disk = read_shape("<cylinder radius=\"1\" length=\"0\"/>");
    EXPECT_NEAR(reach(disk).z(), 0.5e-6, 1e-17);
    EXPECT_GT(disk.deviation, reach(disk).x() - 1);
    const CollisionDescription wire = read_shape("<capsule radius=\"0\" length=\"1\"/>");
    EXPECT_GE(reach(wire).z(), 0.5);
    EXPECT_LE(reach(wire).z(), 0.5 + wire.deviation);
    EXPECT_EQ(reach(read_shape("<capsule radius=\"1\" length=\"0\"/>")), reach(read_shape("<sphere radius=\"1\"/>")));
}

TEST_F(UrdfFile, EqualShapesShareTheirMemory) {
    const auto vertices_of = [&](const std::string& first, const std::string& second) {
        const auto shapes =
            read("<box size=\"1 2 3\"/></geometry></collision>",
                 first + "</geometry></collision><collision><geometry>" + second + "</geometry></collision>")
                .links[1]
                .collisions;
        return std::pair(shapes.at(0).shape.vertices().data(), shapes.at(1).shape.vertices().data());
    };
    for (const std::string shape : {"<sphere radius=\"1\"/>", "<capsule radius=\"1\" length=\"2\"/>",
                                    "<mesh filename=\"cube.obj\" scale=\"1 2 3\"/>"}) {
        const auto [first, second] = vertices_of(shape, shape);
        EXPECT_EQ(first, second) << shape;
    }
    const auto [long_one, short_one] =
        vertices_of("<cylinder radius=\"1\" length=\"2\"/>", "<cylinder radius=\"1\" length=\"1\"/>");
    EXPECT_NE(long_one, short_one);
}

TEST_F(UrdfFile, LimitsMayBeInfinite) {
    const JointDescription joint = read("lower=\"-1\" upper=\"2\"", "lower=\"-INF\" upper=\"infinity\"").joints[0];
    EXPECT_EQ(joint.lower, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(joint.upper, std::numeric_limits<double>::infinity());
    EXPECT_EQ(read("lower=\"-1\"", "").joints[0].lower, 0) << "left out";
    EXPECT_EQ(refused("lower=\"-1\"", "lower=\"--inf\""),
              "robot.urdf:9: <limit>: lower: '--inf' is not a finite number");
    EXPECT_EQ(refused("lower=\"-1\"", "lower=\"-1e400\""),
              "robot.urdf:9: <limit>: lower: '-1e400' is not a finite number");
}

TEST_F(UrdfFile, ReadsMeshesWithScales) {
    const Polyhedron mirrored = shape_of("<mesh filename=\"cube.obj\" scale=\"-1 2 3\"/>");
    EXPECT_EQ(mirrored.report().lower, Eigen::Vector3d(-1, 0, 0));
    EXPECT_EQ(mirrored.report().upper, Eigen::Vector3d(0, 2, 3));
    const auto face = mirrored.face(0); // the bottom
    const auto corner = [&](std::size_t i) { return mirrored.vertices()[face[i]]; };
    EXPECT_LT((corner(1) - corner(0)).cross(corner(2) - corner(0)).z(), 0) << "outwards is down";
}

/// Programs add elements of their own.
/// Files in the field misspell the axis of fixed joints, which have none.
TEST_F(UrdfFile, AFixedJointNeedsNoAxis) {
    const std::string joint =
        "type=\"revolute\">\n    <parent link=\"base\"/><child link=\"arm\"/><origin xyz=\"0 0 1\"/>"
        "<axis xyz=\"0 0 2\"/>";
    const std::string misspelt = "type=\"fixed\"><parent link=\"base\"/><child link=\"arm\"/><axis xzy=\"0 0 1\"/>";
    EXPECT_TRUE(Robot(read(joint, misspelt)).variables().empty());
    EXPECT_NE(refused("<axis xyz=", "<axis xzy=").find("has no attribute xyz"), std::string::npos);
}

TEST_F(UrdfFile, IgnoresElementsOfNamespacesInGeometry) {
    const std::string mesh = "<mesh filename=\"cube.obj\"/>", extra = "<drake:declare_convex/>";
    EXPECT_EQ(shape_of(mesh + extra).face_count(), 6U);
    EXPECT_EQ(shape_of(extra + mesh).face_count(), 6U);
    EXPECT_NE(refused("<box size=\"1 2 3\"/>", extra).find("<geometry>: has no shape"), std::string::npos);
    EXPECT_NE(refused("<box size=\"1 2 3\"/>", mesh + mesh).find("has another shape already"), std::string::npos);
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
    EXPECT_EQ(refused("size=\"1 2 3\"", "size=\"1 2 -1\""),
              "robot.urdf:5: <box>: z: must be positive and at most 1e30, and is -1");
    EXPECT_EQ(refused("<box size=\"1 2 3\"/>", "<cone/>"),
              "robot.urdf:5: <cone>: is no mesh, box, cylinder, sphere or capsule");
    EXPECT_EQ(refused("type=\"revolute\"", "type=\"ball\""),
              "robot.urdf:7: <joint turn>: type: 'ball' is none of fixed, revolute, continuous, prismatic, planar and "
              "floating");
    EXPECT_EQ(refused("child link=\"arm\"", "child link=\"leg\""),
              "robot.urdf:7: <joint turn>: child: there is no link 'leg'");
    EXPECT_EQ(refused("<axis xyz=\"0 0 2\"/>", "<axis xyz=\"0 0 0\"/>"), "robot.urdf:7: <joint turn>: axis: is zero");
    EXPECT_EQ(refused("<limit lower=\"-1\" upper=\"2\" effort=\"1\" velocity=\"1\"/>", ""),
              "robot.urdf:7: <joint turn>: has no <limit>; a joint without limits is continuous");
    EXPECT_EQ(refused("parent link=\"base\"", "parent link=\"world\""),
              "robot.urdf:7: <joint turn>: parent: there is no link 'world'; add <link name=\"world\"/>");
    EXPECT_EQ(refused("<box size=\"1 2 3\"/>", "<box size=\"1 2 3\"/><sphere radius=\"1\"/>"),
              "robot.urdf:5: <sphere>: <geometry> has another shape already; write a second <collision>");
    EXPECT_EQ(refused("version=\"1.2\"", "version=\"1.3\""),
              "robot.urdf:2: <robot small>: version: '1.3' is none of 1.0, 1.1 and 1.2");
    EXPECT_EQ(refused("</robot>", R"(<link name="c"/><link name="d"/>
<joint name="x" type="fixed"><parent link="c"/><child link="d"/></joint>
<joint name="y" type="fixed"><parent link="d"/><child link="c"/></joint></robot>)"),
              "robot.urdf:11: <link c>: is not connected with the root 'base'");
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
