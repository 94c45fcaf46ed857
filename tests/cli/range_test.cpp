// chasles range: the answers are those of the library, and every wrong input gets one line.
#include "tests/cli/cli_test_files.h"

#include "chasles/chasles.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

const std::string two_links = R"(<robot name="arm">
  <link name="base"/>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
</robot>)";

class RangeCommand : public tests::CommandLine {
protected:
    RangeCommand() {
        write("arm.urdf", two_links);
        write("rows.csv", "shoulder,elbow\n0,0.5\n2,1\n");
        write("cell.json", R"({"bodies": [{"name": "cube", "mesh": "cube.obj", "pose": [-0.6, 1.3, -0.5]}]})");
        write("far.json", R"({"bodies": [{"name": "cube", "mesh": "cube.obj", "pose": [4, 1.3, -0.5]}]})");
    }
    [[nodiscard]] Json json(const std::string& arguments) const { return Json::parse(run(arguments + " --json").out); }
};

const std::string both = "range arm.urdf --joints shoulder,elbow ";

TEST_F(RangeCommand, AnswersAsTheLibrary) {
    const Robot robot = Robot::load(path("arm.urdf"));
    Scene scene;
    scene.add({"cube", Polyhedron::load(path("cube.obj")),
               Motion::at_rest(Pose({-0.6, 1.3, -0.5}, Eigen::Quaterniond::Identity()))});
    const std::vector<std::string> joints{"shoulder", "elbow"};
    const RobotRange same =
        RobotChecker(robot, &scene).range(box_of_joints(robot, joints, robot.neutral()), {.tolerance = 0.05});
    const Json answer = json(both + "--scene cell.json --tolerance 0.05");
    EXPECT_EQ(answer["joints"], Json({"shoulder", "elbow"}));
    EXPECT_EQ(answer["verdict"], "contact");
    EXPECT_EQ(answer["clear_share"].get<double>(), same.clear_share);
    EXPECT_EQ(answer["open_share"].get<double>(), same.open_share);
    ASSERT_EQ(answer["boxes"].size(), same.clear.size());
    EXPECT_EQ(answer["boxes"][0]["lower"][1].get<double>(), same.clear[0].lower[1]);
    EXPECT_EQ(answer["boxes"][0]["upper"][0].get<double>(), same.clear[0].upper[0]);
    EXPECT_EQ(answer["contact_boxes"].size(), same.contact.size());
    EXPECT_EQ(answer["witness"]["shoulder"].get<double>(), (*same.witness)[0]);
    EXPECT_EQ(answer["pair"], Json({same.pair->first, same.pair->second}));
    const tests::Finished finished = run(both + "--scene cell.json");
    EXPECT_EQ(finished.status, 1);
    EXPECT_NE(finished.out.find("CONTACT in some configurations"), std::string::npos) << finished.out;
}

TEST_F(RangeCommand, HasTheExitStatusOfItsVerdict) {
    const tests::Finished clear = run(both + "--scene far.json");
    EXPECT_EQ(clear.status, 0) << clear.out << clear.err;
    EXPECT_EQ(clear.out.rfind("CLEAR in all configurations", 0), 0U) << clear.out;
    EXPECT_EQ(json(both + "--scene far.json")["boxes"].size(), 1U);
    EXPECT_EQ(run(both + "--scene cell.json --allow lower,cube --allow upper,cube").status, 0);
    // Nothing is decided in no time.
    EXPECT_EQ(run(both + "--scene cell.json --seconds 1e-9").status, 3);
}

TEST_F(RangeCommand, OtherJointsStayWhereTheRowSays) {
    const std::string one = "range arm.urdf --joints elbow --scene cell.json ";
    const Json at_neutral = json(one), at_second = json(one + "--from rows.csv 1");
    EXPECT_EQ(at_neutral["verdict"], "clear");
    EXPECT_EQ(at_second["verdict"], "contact");
    EXPECT_EQ(at_second["witness"]["shoulder"], 2);
    write("one.csv", "shoulder\n2\n");
    EXPECT_EQ(json(one + "--from one.csv")["verdict"], "contact") << "one row is enough";
    EXPECT_NE(run(one + "--from rows.csv 2").err.find("--from: row 2: rows.csv has the rows 0 to 1"),
              std::string::npos);
}

TEST_F(RangeCommand, FindsTheClearBox) {
    const Json answer = json(both + "--scene cell.json --clear-box --from rows.csv");
    EXPECT_EQ(answer["clear_box"]["verdict"], "clear");
    EXPECT_LT(answer["clear_box"]["lower"][1].get<double>(), 0.5);
    EXPECT_GT(answer["clear_box"]["upper"][1].get<double>(), 0.5);
    EXPECT_GT(answer["clear_box"]["share"].get<double>(), 0.05);
    EXPECT_FALSE(json(both)["clear_box"].is_object());
}

TEST_F(RangeCommand, DrawsTwoJoints) {
    EXPECT_EQ(run(both + "--scene cell.json --plot range.svg").status, 1);
    std::ifstream file(path("range.svg"));
    const std::string picture(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(picture.rfind("<svg", 0), 0U);
    EXPECT_NE(picture.find("contact "), std::string::npos);
    EXPECT_NE(picture.find(">elbow</text>"), std::string::npos);
}

TEST_F(RangeCommand, RefusesInOneLine) {
    const auto why = [&](const std::string& arguments) {
        const tests::Finished finished = run(arguments);
        EXPECT_EQ(finished.status, 2) << arguments;
        return finished.err;
    };
    EXPECT_EQ(why("range arm.urdf --joints wrist"),
              "chasles: --joints: robot: wrist: there is no such variable of a joint\n");
    EXPECT_EQ(why("range arm.urdf --joints elbow,elbow"), "chasles: --joints: range: elbow: comes twice\n");
    EXPECT_EQ(why("range arm.urdf --joints elbow --plot a.svg"),
              "chasles: --plot: draws ranges of two joints, and --joints names 1\n");
    EXPECT_NE(why(both + "--plot a.png").find("pictures are SVG"), std::string::npos);
    EXPECT_NE(why(both + "--tolerance 2").find("tolerance: must be in [0, 1]"), std::string::npos);
    write("moving.json", R"({"bodies": [{"name": "cube", "mesh": "cube.obj", "pose": [4, 0, 0], "goal": [5, 0, 0]}]})");
    EXPECT_NE(
        why(both + "--scene moving.json").find("range: cube: moves, and a range is about a world that stands still"),
        std::string::npos);
    EXPECT_NE(run("range arm.urdf").err.find("--joints is required"), std::string::npos);
}

/// Bases that drive have far limits in their files.
TEST_F(RangeCommand, TakesEndsOfItsOwn) {
    std::string drives = two_links;
    drives.replace(drives.find("\"-3\" upper=\"3\""), 14, "\"-999999\" upper=\"999999\"");
    write("drives.urdf", drives);
    const std::string range = "range drives.urdf --joints shoulder";
    EXPECT_EQ(
        error_line(range + ",elbow"),
        "chasles: --joints: shoulder: the limits of the file, -999999 to 999999, are beyond 1000 in magnitude, the "
        "largest value: give it a smaller range, shoulder=LOWER:UPPER");
    const Robot robot = Robot::load(path("drives.urdf"));
    Scene scene;
    scene.add({"cube", Polyhedron::load(path("cube.obj")),
               Motion::at_rest(Pose({-0.6, 1.3, -0.5}, Eigen::Quaterniond::Identity()))});
    ConfigurationBox box{robot.neutral(), robot.neutral()};
    box.lower << -3, -2;
    box.upper << 3, 2;
    const RobotRange same = RobotChecker(robot, &scene).range(box, {.tolerance = 0.05});
    const Json found = json(range + "=-3:3,elbow --tolerance 0.05 --scene cell.json");
    EXPECT_EQ(found["clear_share"].get<double>(), same.clear_share);
    EXPECT_EQ(found["boxes"][0]["upper"][0].get<double>(), same.clear[0].upper[0]);
    EXPECT_EQ(found["warnings"], Json::array());
    EXPECT_EQ(json("range arm.urdf --joints elbow=-1:2.5")["warnings"][0],
              "--joints: elbow: -1 to 2.5 is beyond the limits [-2, 2]");
    EXPECT_EQ(error_line(range + "=3"), "chasles: --joints: 'shoulder=3' is not of the form NAME or NAME=LOWER:UPPER");
    EXPECT_EQ(error_line(range + "=3:-3"), "chasles: --joints: shoulder: its lower end is not below its upper end");
    EXPECT_EQ(error_line(range + "=-3:3,shoulder"), "chasles: --joints: range: shoulder: comes twice");
    EXPECT_EQ(error_line(range + "=1:3 --clear-box"),
              "chasles: --clear-box: shoulder is 0 in the configuration, outside of its range 1 to 3; --from gives "
              "another configuration");
}

TEST_F(RangeCommand, EndsInTime) {
    EXPECT_EQ(run(both + "--scene cell.json --seconds 0.2 --tolerance 0").status, 1);
}

} // namespace
} // namespace chasles
