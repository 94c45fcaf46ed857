// Files of other programs through the command line: each format of a path gives the answer of the same motion, and each
// file that can be read in two ways is refused in one line.
#include "tests/cli/cli_test_files.h"

#include "chasles/chasles.h"

#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

/// A robot of two turning links, a finger that slides and one that follows it.
const std::string arm = R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.6 0.1 0.1"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.6 0.1 0.1"/></geometry></collision></link>
  <link name="finger"/><link name="other_finger"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="grip" type="prismatic"><parent link="lower"/><child link="finger"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" velocity="1" effort="1"/></joint>
  <joint name="other_grip" type="prismatic"><parent link="lower"/><child link="other_finger"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.04" velocity="1" effort="1"/><mimic joint="grip"/></joint>
</robot>)";

class TrajectoryFiles : public tests::CommandLine {
protected:
    TrajectoryFiles() {
        write("arm.urdf", arm);
        write("cell.json", R"({"bodies": [{"name": "cube", "mesh": "cube.obj", "pose": [0.6, 1.3, -0.5]}]})");
    }
    [[nodiscard]] Json pose_answer(const std::string& name, const std::string& content) const {
        write(name, content);
        return Json::parse(run("path cube.obj cube.obj --json --poses " + name).out);
    }
    [[nodiscard]] std::string robot_command(const std::string& name, const std::string& content) const {
        write(name, content);
        return "robot arm.urdf --scene cell.json --json --path " + name;
    }
    [[nodiscard]] Json robot_answer(const std::string& name, const std::string& content) const {
        const std::string out = run(robot_command(name, content)).out;
        return Json::parse(out.empty() ? "{}" : out);
    }
    /// The path from (0, 0) to (1.5, 0.5), which meets the cube.
    [[nodiscard]] RobotAnswer expected() const {
        const Robot robot = Robot::load(path("arm.urdf"));
        Scene scene;
        scene.add({"cube", Polyhedron::load(path("cube.obj").string()),
                   Motion::at_rest(Pose({0.6, 1.3, -0.5}, Eigen::Quaterniond::Identity()))});
        const std::vector<Configuration> way = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1.5, 0.5, 0)};
        return RobotChecker(robot, &scene).first_contact(JointPath::straight(robot, way));
    }
    void expect_the_path(const Json& answer, bool has_stamps, const std::string& name) const {
        const RobotAnswer same = expected();
        ASSERT_EQ(same.verdict, Verdict::contact);
        ASSERT_TRUE(answer.contains("time")) << name << ": " << answer;
        const double time = has_stamps ? 10 + 4 * same.contact.time.lower : same.contact.time.lower;
        EXPECT_NEAR(answer["time"].get<double>(), time, 1e-9) << name;
        EXPECT_EQ(answer["pair"], Json({same.pair->first, same.pair->second})) << name;
    }
};

/// The pose path of the field: from (3, 0.2, 0.3) to (-1, 0.2, 0.3), in contact with the unit cube at a half.
TEST_F(TrajectoryFiles, PosesOfEveryFormatAreTheSamePath) {
    const std::vector<std::pair<std::string, std::string>> files = {
        {"comment.csv", "# recorded by me\nx,y,z,qw,qx,qy,qz\n3,0.2,0.3,1,0,0,0\n-1,0.2,0.3,1,0,0,0\n"},
        {"ros.csv", "x,y,z,qx,qy,qz,qw\n3,0.2,0.3,0,0,0,1\n-1,0.2,0.3,0,0,0,1\n"},
        {"semicolon.csv", "x;y;z;qw;qx;qy;qz;\n3;0.2;0.3;1;0;0;0;\n-1;0.2;0.3;1;0;0;0;\n"},
        {"tab.txt", "X\tY\tZ\tQW\tQX\tQY\tQZ\n3\t0.2\t0.3\t1\t0\t0\t0\n-1\t0.2\t0.3\t1\t0\t0\t0\n"},
        {"blanks.txt", "x y  z qx qy qz qw # ROS\n 3 0.2 0.3 0 0 0 1\n-1 0.2 0.3 0 0 0 1 # end\n"},
    };
    for (const auto& [name, content] : files) {
        const Json answer = pose_answer(name, content);
        EXPECT_NEAR(answer["time"].get<double>(), 0.5, 1e-9) << name;
        EXPECT_EQ(answer["motion"]["kind"], "screw") << name;
        EXPECT_FALSE(answer.contains("warnings")) << name;
    }
    const std::vector<std::pair<std::string, std::string>> stamped = {
        {"timestamp.csv", "timestamp,x,y,z,qw,qx,qy,qz\n10,3,0.2,0.3,1,0,0,0\n14,-1,0.2,0.3,1,0,0,0\n"},
        {"last.csv", "x,y,z,qw,qx,qy,qz,TIME\n3,0.2,0.3,1,0,0,0,10\n-1,0.2,0.3,1,0,0,0,14\n"},
        {"tum.txt", "# timestamp tx ty tz qx qy qz qw\n10 3 0.2 0.3 0 0 0 1\n14 -1 0.2 0.3 0 0 0 1\n"},
        {"bare.tum", "10 3 0.2 0.3 0 0 0 1\n14 -1 0.2 0.3 0 0 0 1\n"},
    };
    for (const auto& [name, content] : stamped) {
        const Json answer = pose_answer(name, content);
        EXPECT_NEAR(answer["time"].get<double>(), 12, 1e-9) << name;
        EXPECT_EQ(answer["motion"]["kind"], "screw") << name;
    }
}

TEST_F(TrajectoryFiles, IgnoredColumnsAreNamedInAWarning) {
    write("more.csv", "speed,x,y,z,qw,qx,qy,qz\n1,3,0.2,0.3,1,0,0,0\n1,-1,0.2,0.3,1,0,0,0\n");
    const auto finished = run("path cube.obj cube.obj --json --poses more.csv");
    const std::string warning = "more.csv: line 1: ignored columns: 'speed'; x, y, z, qw, qx, qy, qz and t are read";
    EXPECT_EQ(Json::parse(finished.out)["warnings"], Json::array({warning}));
    EXPECT_EQ(finished.err, "chasles: warning: " + warning + "\n");
    EXPECT_EQ(run("path cube.obj cube.obj --poses more.csv").err, finished.err);
    write("goals.csv", "speed,x,y,z,qw,qx,qy,qz\n1,3,0.2,0.3,1,0,0,0\n1,2.5,0.2,0.3,1,0,0,0\n");
    const auto dragged = run("drag cell.json --body cube --goals goals.csv --out out.csv --json");
    EXPECT_EQ(Json::parse(dragged.out)["warnings"].size(), 1U);
    write("motions.csv", "speed,x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1\n0,3,0,0,1,0,0,0,3,1,0,1,0,0,0\n");
    const auto batch = run("batch cube.obj cube.obj --motions motions.csv --out out.csv");
    EXPECT_EQ(batch.status, 0);
    EXPECT_NE(batch.err.find("ignored columns: 'speed'"), std::string::npos) << batch.err;
}

/// With and without time stamps the motion between two poses is the same, and so are the verdict and the place.
TEST_F(TrajectoryFiles, StampsDoNotChangeTheMotion) {
    const std::string poses[] = {"3,0,0,1,0,0,0", "-3,0,0,0.0001,0,0,1"};
    write("without.csv", "x,y,z,qw,qx,qy,qz\n" + poses[0] + "\n" + poses[1] + "\n");
    write("with.csv", "t,x,y,z,qw,qx,qy,qz\n0," + poses[0] + "\n1," + poses[1] + "\n");
    const std::string ends = " --start=\"" + poses[0] + "\" --goal=\"" + poses[1] + "\"";
    for (const std::string motion :
         {"", " --motion screw", " --motion sweep", " --motion velocity", " --motion twist"}) {
        const auto without = run("path cube.obj cube.obj --json --poses without.csv" + motion);
        const auto with = run("path cube.obj cube.obj --json --poses with.csv" + motion);
        const auto check = run("check cube.obj cube.obj --json" + ends + motion);
        const Json a = Json::parse(without.out), b = Json::parse(with.out), c = Json::parse(check.out);
        EXPECT_EQ(a["verdict"], b["verdict"]) << motion;
        EXPECT_EQ(a["verdict"], c["verdict"]) << motion;
        EXPECT_EQ(a["motion"], b["motion"]) << motion;
        EXPECT_EQ(a["motion"], c["motion"]) << motion;
        EXPECT_NEAR(a.value("time", -1.0), b.value("time", -1.0), 1e-9) << motion;
        const std::string kind = a["motion"]["kind"];
        EXPECT_EQ(kind, motion.empty() ? "screw" : motion.substr(motion.rfind(' ') + 1));
        for (const std::string file : {"without.csv", "with.csv"}) {
            const std::string text = run("path cube.obj cube.obj --poses " + file + motion).out;
            EXPECT_NE(text.substr(0, text.find('\n')).find("; motion: " + kind), std::string::npos) << text;
        }
    }
}

/// The first line of every report names the motion, and so does the JSON.
TEST_F(TrajectoryFiles, EveryAnswerNamesItsMotion) {
    write("poses.csv", "x,y,z,qw,qx,qy,qz\n3,0.2,0.3,1,0,0,0\n-1,0.2,0.3,1,0,0,0\n");
    write("joints.csv", "shoulder\n0\n1\n");
    write("moving.json", R"({"bodies": [{"name": "a", "mesh": "cube.obj"},
        {"name": "b", "mesh": "cube.obj", "pose": [3, 0, 0], "goal": [-1, 0, 0]},
        {"name": "c", "mesh": "cube.obj", "pose": [0, 3, 0], "goal": [0, 2, 0], "motion": "twist"}]})");
    const std::string ends = " --start '3 0 0' --goal '-1 0 0'";
    const std::vector<std::pair<std::string, std::string>> commands = {
        {"check cube.obj cube.obj" + ends, "screw"},
        {"check cube.obj cube.obj --motion sweep" + ends, "sweep"},
        {"check cube.obj cube.obj --motion twist --start '3 0 0' --goal '3 1 0'", "twist"},
        {"check cube.obj cube.obj --start '.5 0 0' --goal '3 1 0'", "screw"},
        {"clearance cube.obj cube.obj --motion velocity --start '3 0 0' --goal '3 1 0'", "velocity"},
        {"clearance cube.obj cube.obj" + ends, "screw"},
        {"path cube.obj cube.obj --poses poses.csv", "screw"},
        {"scene moving.json", "velocity and twist"},
        {"scene moving.json --all", "velocity and twist"},
        {"scene cell.json", "rest"},
        {"robot arm.urdf --path joints.csv", "straight in joint space"},
        {"robot arm.urdf --path joints.csv --scene cell.json", "straight in joint space"},
        {"robot arm.urdf --path joints.csv --clearance", "straight in joint space"},
        {"drag cell.json --body cube --goals poses.csv --out out.csv", "dragged"},
    };
    for (const auto& [command, motion] : commands) {
        const std::string text = run(command).out;
        EXPECT_TRUE(text.substr(0, text.find('\n')).ends_with("; motion: " + motion)) << command << "\n" << text;
        EXPECT_EQ(Json::parse(run(command + " --json").out)["motion"]["kind"], motion) << command;
    }
}

TEST_F(TrajectoryFiles, JointPathsOfEveryFormatAreTheSamePath) {
    const std::vector<std::pair<std::string, std::string>> plain = {
        {"names.csv", "shoulder,elbow\n0,0\n1.5,0.5\n"},
        {"turned.csv", "# made by hand\nElbow; Shoulder;\n0;0;\n0.5;1.5;\n"},
        {"degrees.txt", "elbow_deg shoulder\n0 0\n28.64788975654116 1.5\n"},
        {"plan.json",
         R"({"joint_names": ["elbow", "shoulder"], "points": [{"positions": [0, 0]}, {"positions": [0.5, 1.5]}]})"},
        {"untimed.yaml",
         "joint_names: [shoulder, elbow]\npoints:\n- {positions: [0, 0], time_from_start: {sec: 0, nanosec: 0}}\n"
         "- {positions: [1.5, 0.5], time_from_start: {sec: 0, nanosec: 0}}\n"},
    };
    for (const auto& [name, content] : plain)
        expect_the_path(robot_answer(name, content), false, name);
    const std::vector<std::pair<std::string, std::string>> stamped = {
        {"stamps.csv", "elbow,timestamp,shoulder\n0,10,0\n0.5,14,1.5\n"},
        {"seconds.json",
         R"({"joint_names": ["shoulder", "elbow"], "points": [{"positions": [0, 0], "time_from_start": 10},
                             {"positions": [1.5, 0.5], "time_from_start": 14}]})"},
        {"ros2.yaml", "joint_names:\n- shoulder\n- elbow\npoints:\n- positions: [0.0, 0.0]\n  velocities: []\n"
                      "  time_from_start:\n    sec: 10\n    nanosec: 0\n- positions:\n  - 1.5\n  - 0.5\n"
                      "  time_from_start: {sec: 13, nanosec: 1000000000}\n"},
        {"ros1.yml", "joint_names: [shoulder, elbow]\npoints: \n  - \n    positions: [0, 0]\n    time_from_start: \n"
                     "      secs: 10\n      nsecs:         0\n  - \n    positions: [1.5, 0.5]\n    time_from_start: \n"
                     "      secs: 14\n      nsecs: 0\n"},
        {"echo.txt",
         "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: base\njoint_names:\n- shoulder\n- elbow\n"
         "points:\n- positions:\n  - 0.0\n  - 0.0\n  time_from_start:\n    sec: 10\n    nanosec: 0\n"
         "- positions:\n  - 1.5\n  - 0.5\n  time_from_start:\n    sec: 14\n    nanosec: 0\n---\n"},
        {"moveit.yaml", "joint_trajectory:\n  joint_names: [shoulder, elbow]\n  points:\n"
                        "  - {positions: [0, 0], time_from_start: {sec: 10, nanosec: 0}}\n"
                        "  - {positions: [1.5, 0.5], time_from_start: {sec: 14, nanosec: 0}}\n"
                        "multi_dof_joint_trajectory: {joint_names: [], points: []}\n"},
        {"display.json",
         R"({"model_id": "arm", "trajectory": [{"joint_trajectory": {"joint_names": ["shoulder", "elbow"],
                             "points": [{"positions": [0, 0], "time_from_start": {"secs": 10, "nsecs": 0}},
                                        {"positions": [1.5, 0.5], "time_from_start": {"secs": 14, "nsecs": 0}}]}}]})"},
        {"goal.json", R"({"trajectory": {"joint_names": ["shoulder", "elbow"], "points": [
                          {"positions": [0, 0], "time_from_start": {"sec": 10, "nanosec": 0}},
                          {"positions": [1.5, 0.5], "time_from_start": {"sec": 14, "nanosec": 0}}]}})"},
        {"one_part.yaml",
         "joint_names: [shoulder, elbow]\npoints:\n- {positions: [0, 0], time_from_start: {secs: 10}}\n"
         "- {positions: [1.5, 0.5], time_from_start: {sec: 14}}\n"},
        {"lists.yaml", "joint_names: [shoulder, elbow]\npoints:\n- {positions: [0, 0], time_from_start: [10.0, 0.0]}\n"
                       "- {positions: [1.5, 0.5], time_from_start: [14, 0]}\n"},
        {"lone_cr.yaml", "joint_names: [shoulder, elbow]\rpoints:\r- {positions: [0, 0], time_from_start: 10}\r"
                         "- {positions: [1.5, 0.5], time_from_start: 14}\r"},
        {"aliases.yaml",
         "joint_names: &names [shoulder, elbow]\npoints:\n- {positions: &zero [0, 0], velocities: *zero, "
         "time_from_start: 10}\n- {positions: [1.5, 0.5], velocities: *zero, time_from_start: 14}\n"},
    };
    for (const auto& [name, content] : stamped)
        expect_the_path(robot_answer(name, content), true, name);
}

TEST_F(TrajectoryFiles, JointPathsNameWhatIsNotUsed) {
    const Json more = robot_answer("more.csv", "shoulder,elbow,wheel,effort\n0,0,0,3\n1.5,0.5,0,3\n");
    expect_the_path(more, false, "more.csv");
    EXPECT_EQ(more["warnings"][0],
              "more.csv: line 1: ignored columns: 'wheel, effort'; the robot has no variables of these names");
    const Json rates =
        robot_answer("rates.yaml", "joint_names: [shoulder, elbow, wheel]\npoints:\n- {positions: [0, 0, 0], "
                                   "velocities: [1, 1, 1]}\n- {positions: [1.5, 0.5, 0]}\n");
    expect_the_path(rates, false, "rates.yaml");
    ASSERT_EQ(rates["warnings"].size(), 3U);
    EXPECT_NE(rates["warnings"][0].get<std::string>().find("velocities and accelerations are not used"),
              std::string::npos);
    EXPECT_NE(rates["warnings"][1].get<std::string>().find("ignored joints: 'wheel'"), std::string::npos);
    EXPECT_EQ(rates["warnings"][2], "rates.yaml: joint_names: no values for 'grip': they stay at their neutral values");
}

TEST_F(TrajectoryFiles, TrajectoriesOfRosAreRefusedInOneLine) {
    const std::string point = "{positions: [0, 0], time_from_start: 0}";
    std::string deep, bomb = "joint_names: [shoulder]\na: &a [1,1,1,1,1,1,1,1,1,1]\n";
    for (int i = 0; i < 100000; ++i)
        deep += "[";
    for (char c = 'b'; c < 'k'; ++c) {
        const std::string before = "*" + std::string(1, static_cast<char>(c - 1));
        bomb += std::string(1, c) + ": &" + c + " [";
        for (int i = 0; i < 10; ++i)
            bomb += before + (i < 9 ? "," : "]\n");
    }
    const std::vector<std::pair<std::string, std::string>> files = {
        {"joint_names: [shoulder, elbow]\n",
         "has no trajectory: no object has the keys joint_names and points, or name and position"},
        {"joint_names: [shoulder, elbow]\npoints: 3\n", "points: must be a list"},
        {"joint_names: shoulder\npoints: []\n", "joint_names: must be a list"},
        {"joint_names: [shoulder, elbow]\npoints: [" + point + "]\n",
         "points: a path needs at least two, and there are 1; the state before it is missing: write it as the first "
         "point, or repeat the point with a later time to ask about it at rest"},
        {"joint_names: [shoulder, elbow]\npoints: [{positions: [0, 0], time_from_start: [1, 5]}]\n",
         "points: point 1: time_from_start: a list is read only as [SECONDS, 0]; write {sec: SECONDS, nanosec: "
         "NANOSECONDS}, or the seconds"},
        {"joint_names: [shoulder, elbow]\npoints: [{positions: [0]}, {positions: [0, 1]}]\n",
         "points: point 1: positions: 1 found, and joint_names has 2"},
        {"joint_names: [shoulder, elbow]\npoints: [{positions: [0, .nan]}]\n",
         "points: point 1: positions: joint 2: not a finite number: '.nan'"},
        {"joint_names: [shoulder, elbow]\npoints: [{}]\n", "points: point 1: positions: is missing"},
        {"joint_names: [shoulder, elbow]\npoints: [" + point + ", " + point + "," + point +
             ", {positions: [0, 1], "
             "time_from_start: {seconds: 1}}]\n",
         "points: point 4: time_from_start: unknown key 'seconds'; a time has sec or secs, and nanosec, nanosecs, nsec "
         "or nsecs"},
        {"joint_names: [shoulder, elbow]\npoints: [{positions: [0, 0], time_from_start: 1}, {positions: [0, 1], "
         "time_from_start: 1}]\n",
         "points: point 2: time_from_start: must increase, but is 1 after 1"},
        {"joint_names: [shoulder, elbow]\npoints: [{positions: [0, 0], time_from_start: 1}, {positions: [0, 1]}]\n",
         "points: 1 of 2 have time_from_start"},
        {"joint_names: [shoulder, shoulder]\npoints: []\n",
         "joint_names: the column 'shoulder' comes twice in the header 'shoulder, shoulder'"},
        {"joint_names: [hip]\npoints: []\n",
         "joint_names: the header 'hip' names no variable of the robot, which has "
         "'shoulder, elbow, grip'; fixed joints and joints that follow others have none"},
        {"joint_names: [shoulder_deg]\npoints: []\n",
         "joint_names: the header 'shoulder_deg' names no variable of the "
         "robot, which has 'shoulder, elbow, grip'; fixed joints and joints "
         "that follow others have none"},
        {"a: {joint_names: [shoulder], points: []}\nb: {joint_names: [shoulder], points: []}\n",
         "has 2 trajectories (objects with the keys joint_names and points): leave one in the file"},
        {"joint_names: [shoulder]\npoints: []\n---\njoint_names: [shoulder]\npoints: []\n---\n",
         "has 2 trajectories (objects with the keys joint_names and points): leave one in the file"},
        {"multi_dof_joint_trajectory: {joint_names: [base], points: []}\n",
         "multi_dof_joint_trajectory: is not read; a table of columns can hold its joints"},
        {"joint_names: [shoulder]\njoint_names: [elbow]\npoints: []\n", "the key 'joint_names' comes twice in one map"},
        {"a: &a [*a]\n", "is nested more than 32 deep"},
        {deep, "is nested more than 32 deep"},
        {bomb, "has aliases (*NAME) that make much more than the file has"},
        {", joint_names: [shoulder]\n", "is not YAML: line 1: no value begins here"}, // yaml-cpp alone makes no end
        {"joint_names: [shoulder\n", ""},
        {"joint_names: *unknown\n", ""},
    };
    for (const auto& [content, message] : files) {
        const std::string line = error_line(robot_command("bad.yaml", content));
        EXPECT_TRUE(line.starts_with("chasles: bad.yaml: ")) << line;
        EXPECT_GT(line.size(), std::string("chasles: bad.yaml: ").size() + 3) << "a reason";
        EXPECT_TRUE(message.empty() || line == "chasles: bad.yaml: " + message) << line;
    }
    EXPECT_EQ(error_line(robot_command("bad.json", R"({"joint_names": ["elbow"], "points": [], "points": []})")),
              "chasles: bad.json: the key 'points' comes twice in one object");
    EXPECT_TRUE(error_line(robot_command("bad.json", deep)).starts_with("chasles: bad.json: is not JSON: parse error"));
    EXPECT_TRUE(
        error_line(robot_command("bad.json", "shoulder\n0\n1\n")).starts_with("chasles: bad.json: is not JSON: "));
}

/// A controller moves the robot to the first point, from wherever it is.
TEST_F(TrajectoryFiles, NameTheWayToAFirstPointThatComesLater) {
    const auto warnings = [&](const std::string& time) {
        return robot_answer("late.yaml",
                            "joint_names: [shoulder, elbow]\npoints:\n- {positions: [0, 0], time_from_start: " + time +
                                "}\n- {positions: [1.5, 0.5], time_from_start: 14}\n")["warnings"];
    };
    ASSERT_EQ(warnings("3").size(), 2U);
    EXPECT_EQ(warnings("3")[0],
              "late.yaml: points: the first one comes at 3 s: the way to it, from wherever the robot is then, "
              "is not tested");
    EXPECT_EQ(warnings("0").size(), 1U) << "a joint has no column";
}

TEST_F(TrajectoryFiles, SayWhatASceneFileIs) {
    for (const char* const text : {"(noname)+\n* Box0\n1\nbox\n", "name: scene\nbodies: []\n", "<sdf/>"})
        EXPECT_EQ(error_line((write("moveit.scene", text), "scene moveit.scene")),
                  "chasles: moveit.scene: is no scene file: that is a JSON object with \"bodies\"; scenes of MoveIt "
                  "and worlds of "
                  "Gazebo are not read");
}

TEST_F(TrajectoryFiles, SayThatJsonHasNoComments) {
    const auto said = [&](const std::string& text) { return error_line((write("c.json", text), "scene c.json")); };
    const std::string scene = "{\"bodies\": [], \"margin\": 0}";
    EXPECT_EQ(said("// c\n" + scene), "chasles: c.json: line 1: '// c' is a comment, and JSON has none");
    EXPECT_EQ(said("\n# c\r\n" + scene), "chasles: c.json: line 2: '# c' is a comment, and JSON has none");
    EXPECT_EQ(said("/* c\n */ // d\n" + scene), "chasles: c.json: line 1: '/* c' is a comment, and JSON has none");
    EXPECT_EQ(said("{\n\"bodies\": [], // none\n}"),
              "chasles: c.json: line 2: '// none' is a comment, and JSON has none");
    EXPECT_TRUE(said("# a comment\nname: scene\n").starts_with("chasles: c.json: is no scene file"));
    EXPECT_EQ(said("/* endless"), "chasles: c.json: line 1: '/* endless' is a comment, and JSON has none");
}

/// In a scene file the later of two equal keys would count in silence.
TEST_F(TrajectoryFiles, ScenesRefuseAKeyThatComesTwice) {
    write("twice.json", R"({"bodies": [{"name": "a", "mesh": "cube.obj", "pose": [0, 0, 0], "pose": [9, 9, 9]}]})");
    EXPECT_EQ(error_line("scene twice.json"), "chasles: twice.json: the key 'pose' comes twice in one object");
    write("twice.json", R"({"bodies": [], "margin": 0, "bodies": []})");
    EXPECT_EQ(error_line("scene twice.json"), "chasles: twice.json: the key 'bodies' comes twice in one object");
}

/// The files of the field that were refused or read in two ways.
TEST_F(TrajectoryFiles, OfTheFieldAreRead) {
    const std::filesystem::path field = std::filesystem::path(CHASLES_DATA_DIR) / "field";
    if (std::string(CHASLES_DATA_DIR).empty() || !std::filesystem::exists(field))
        GTEST_SKIP() << "skipped: there is no data from the field";
    const std::string folder = (field / "10-trajectory-files").string() + "/";
    for (const std::string name : {"comment.csv", "semicolon.csv", "timestamp.csv", "tum.txt", "xyzw.csv"}) {
        const auto finished = run("path " + folder + "c.obj " + folder + "c.obj --json --poses " + folder + name);
        ASSERT_EQ(finished.status, 1) << name << finished.err;
        EXPECT_NEAR(Json::parse(finished.out)["time"].get<double>(), 0.5, 1e-9) << name;
    }
    for (const std::string name : {"rdeg.csv", "jt.json", "jt.yaml"}) {
        const auto finished = run("robot " + folder + "arm.urdf --json --path " + folder + name);
        ASSERT_LE(finished.status, 1) << name << finished.err;
        const double waist = Json::parse(finished.out)["configuration"]["waist"];
        EXPECT_NEAR(waist, name == "rdeg.csv" ? 30 * 3.14159265358979 / 180 : 0.5, 1e-12) << name << finished.out;
    }
    const std::string stamps = (field / "15-with-and-without-stamps").string() + "/";
    const auto with = run("path " + stamps + "c.obj " + stamps + "c.obj --json --poses " + stamps + "wi.csv");
    const auto without = run("path " + stamps + "c.obj " + stamps + "c.obj --json --poses " + stamps + "wo.csv");
    EXPECT_EQ(Json::parse(with.out)["verdict"], Json::parse(without.out)["verdict"]);
    EXPECT_EQ(error_line("scene " + (field / "25-duplicate-keys/scene.json").string()),
              "chasles: " + (field / "25-duplicate-keys/scene.json").string() +
                  ": the key 'pose' comes twice in one object");
}

} // namespace
} // namespace chasles
