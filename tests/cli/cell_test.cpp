// chasles robot with several robots: NAME=VALUE for each, clocks of their own, parts that change hands.
#include "tests/cli/cli_test_files.h"

#include "chasles/chasles.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

/// A hand of side 0.2 that slides along x, at a height above its rail.
std::string slider(const std::string& height) {
    return R"(<robot name="slider"><link name="rail"/>
      <link name="hand"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
      <joint name="x" type="prismatic"><parent link="rail"/><child link="hand"/><origin xyz="0 0 )" +
           height + R"("/><axis xyz="1 0 0"/><limit lower="-9" upper="9" velocity="1" effort="1"/></joint></robot>)";
}

class CellCommand : public tests::CommandLine {
protected:
    CellCommand() {
        write("slider.urdf", slider("0"));
        write("lower.csv", "t,x\n0,0\n1,1\n3,-1\n");
        write("upper.csv", "t,x\n1,1\n2,5\n");
        write("rest.csv", "x\n1\n");
        write("small.off",
              "OFF\n8 6 0\n-.1 -.1 -.1\n.1 -.1 -.1\n.1 .1 -.1\n-.1 .1 -.1\n-.1 -.1 .1\n.1 -.1 .1\n.1 .1 .1\n"
              "-.1 .1 .1\n4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
        write("wall.json", R"({"bodies": [{"name": "wall", "mesh": "cube.obj", "pose": [3, -0.5, -0.2]}]})");
    }
    [[nodiscard]] nlohmann::json json(const std::string& arguments) const {
        return nlohmann::json::parse(run(arguments + " --json").out);
    }
};

const std::string both = "robot lower=slider.urdf upper=slider.urdf --base \"upper=0 0 0.4\" ";
const std::string paths = "--path lower=lower.csv --path upper=upper.csv ";
const std::string cube = "--attach \"lower/hand,small.off,0 0 0.2\" ";

TEST_F(CellCommand, EachRobotHasAClockOfItsOwn) {
    const tests::Finished clear = run(both + paths);
    EXPECT_EQ(clear.status, 0) << clear.err;
    EXPECT_NE(clear.out.find("lower/x -1, upper/x 5"), std::string::npos) << clear.out;
    EXPECT_NE(clear.out.find("3 segments"), std::string::npos) << clear.out;
    const nlohmann::json wall = json(both + paths + "--scene wall.json");
    EXPECT_EQ(wall["pair"], nlohmann::json({"upper/hand", "wall"}));
    EXPECT_NEAR(wall["time"].get<double>(), 1 + 1.9 / 4, 1e-9);
    EXPECT_EQ(wall["segment"], 1);
    EXPECT_EQ(json(both + "--path lower=lower.csv --path upper=rest.csv")["configuration"]["upper/x"], 1);
    EXPECT_EQ(json(both + paths + "--clearance")["pair"], nlohmann::json({"upper/hand", "lower/hand"}));
}

TEST_F(CellCommand, APartChangesHands) {
    EXPECT_EQ(json(both + paths + cube)["pair"], nlohmann::json({"small", "upper/hand"}));
    const std::string taken = both + paths + cube + "--handover 1,small,upper/hand ";
    EXPECT_EQ(run(taken).status, 0);
    EXPECT_EQ(run(taken + "--profile").status, 0);
    EXPECT_EQ(json(taken + "--scene wall.json --allow upper/hand,wall")["pair"], nlohmann::json({"small", "wall"}));
    EXPECT_EQ(run(taken + "--scene wall.json --page page.html --curve").status, 1);
    std::ifstream page(path("page.html"));
    const std::string text((std::istreambuf_iterator<char>(page)), {});
    EXPECT_NE(text.find("slider.urdf"), std::string::npos);
}

TEST_F(CellCommand, ASingleRobotMayStandElsewhere) {
    const nlohmann::json found = json("robot slider.urdf --base \"1 0 0\" --path upper.csv --scene wall.json");
    EXPECT_NEAR(found["time"].get<double>(), 1 + 0.9 / 4, 1e-9);
    EXPECT_EQ(found["pair"], nlohmann::json({"hand", "wall"}));
}

TEST_F(CellCommand, RefusesWhatNamesNoRobot) {
    const auto refused = [&](const std::string& arguments) { return run(arguments).err; };
    EXPECT_EQ(refused("robot lower=slider.urdf slider.urdf " + paths),
              "chasles: ROBOT: 'slider.urdf' is not of the form NAME=FILE, which each of several robots needs\n");
    EXPECT_EQ(refused(both + "--path lower=lower.csv"),
              "chasles: --path: is needed for the 1 variable of the robot upper: x\n");
    EXPECT_EQ(refused(both + "--path lower.csv"), "chasles: --path: 'lower.csv' is not of the form NAME=VALUE\n");
    EXPECT_EQ(refused(both + paths + "--path left=lower.csv"),
              "chasles: --path: there is no robot 'left', only 'lower, upper'\n");
    EXPECT_EQ(refused(both + paths + "--path lower=upper.csv"), "chasles: --path: is given twice for lower\n");
    EXPECT_EQ(refused(both + "--path lower=rest.csv --path upper=rest.csv"),
              "chasles: --path: every robot of the cell rests; repeat the row of one of them to ask about the cell at "
              "rest\n");
    EXPECT_EQ(refused("robot slider.urdf --path upper.csv --path lower.csv"), "chasles: --path: is given twice\n");
    EXPECT_EQ(refused(both + "--base upper=1 " + paths).substr(0, 15), "chasles: --base");
    EXPECT_EQ(refused(both + paths + cube + "--handover 1,small"),
              "chasles: --handover: '1,small' is not of the form TIME,PART,LINK\n");
    EXPECT_EQ(
        refused(both + paths + cube + "--handover 1.5,small,upper/hand"),
        "chasles: handover 0: no segment of the path ends at the stamp 1.5, or it is the last one; segments end at "
        "1, 2\n");
}

TEST_F(CellCommand, MayHaveOneRobot) {
    const nlohmann::json found =
        json("robot only=slider.urdf --base \"only=1 0 0\" --path only=upper.csv --scene wall.json");
    EXPECT_EQ(found["pair"], nlohmann::json({"only/hand", "wall"}));
    write("on=off.urdf", slider("0"));
    EXPECT_EQ(json("robot on=off.urdf --path upper.csv --scene wall.json")["pair"], nlohmann::json({"hand", "wall"}));
    EXPECT_EQ(error_line("robot only=slider.urdf --path upper.csv"),
              "chasles: --path: 'upper.csv' is not of the form NAME=VALUE");
    EXPECT_EQ(error_line("info left=slider.urdf"),
              "chasles: left=slider.urdf: no such file; info is about one file: ask for slider.urdf");
}

/// The answers are those of the cell that the library makes.
TEST_F(CellCommand, HasRangesAndPairs) {
    Robot lower = Robot::load(path("slider.urdf")), upper = lower;
    upper.set_base(Pose({0, 0, 0.15}, Eigen::Quaterniond::Identity()));
    const Robot cell = Robot::together({{"lower", lower}, {"upper", upper}});
    const std::vector<std::string> joints{"lower/x", "upper/x"};
    const RobotRange same = RobotChecker(cell).range(box_of_joints(cell, joints, cell.neutral()), {.tolerance = 0.01});
    const std::string robots = "lower=slider.urdf upper=slider.urdf --base \"upper=0 0 0.15\" ";
    const nlohmann::json found = json("range " + robots + "--joints lower/x,upper/x --tolerance 0.01");
    EXPECT_EQ(found["joints"], nlohmann::json(joints));
    EXPECT_EQ(found["clear_share"].get<double>(), same.clear_share);
    EXPECT_GT(same.contact_share, 0);
    EXPECT_EQ(found["boxes"].size(), same.clear.size());
    const nlohmann::json pairs = json("acm " + robots);
    ASSERT_EQ(pairs["pairs"].size(), 1U);
    EXPECT_EQ(pairs["pairs"][0]["links"], nlohmann::json({"lower/hand", "upper/hand"}));
    EXPECT_EQ(pairs["pairs"][0]["reason"], "sometimes");
    EXPECT_EQ(json("acm lower=slider.urdf upper=slider.urdf --base \"upper=0 0 0.4\"")["pairs"][0]["reason"], "never");
    write("no.srdf", R"(<robot name="slider"><disable_collisions link1="rail" link2="hand" reason="Never"/></robot>)");
    EXPECT_EQ(run("acm " + robots + "--srdf lower=no.srdf").status, 0);
    EXPECT_NE(error_line("acm " + robots + "--out a.srdf").find("ask about each robot alone"), std::string::npos);
    EXPECT_EQ(error_line("acm " + robots + "--srdf no.srdf"),
              "chasles: --srdf: 'no.srdf' is not of the form NAME=VALUE");
}

} // namespace
} // namespace chasles
