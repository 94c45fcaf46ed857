// chasles robot and chasles acm: the answers are those of the library, and every wrong input gets one line.
#include "tests/cli/cli_test_files.h"

#include "chasles/chasles.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

const std::string arm = R"(<robot name="arm">
  <link name="base"><collision><geometry><sphere radius="0.2"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <limit lower="0.5" upper="3" velocity="1" effort="1"/></joint>
</robot>)";

class RobotCommand : public tests::CommandLine {
protected:
    RobotCommand() {
        write("arm.urdf", arm);
        write("path.csv", "shoulder\n0\n0.1\n2\n");
        write("timed.csv", "t,elbow,shoulder\n1,0.5,0\n3,0.5,2\n");
        write("cell.json", R"({"bodies": [{"name": "cube", "mesh": "cube.obj", "pose": [-0.6, 1.3, -0.5]}]})");
    }
    [[nodiscard]] Json json(const std::string& arguments) const { return Json::parse(run(arguments + " --json").out); }
    [[nodiscard]] RobotAnswer expected(const JointPath& path) const {
        const Robot robot = Robot::load(path_of("arm.urdf"));
        Scene scene;
        scene.add({"cube", Polyhedron::load(path_of("cube.obj")),
                   Motion::at_rest(Pose({-0.6, 1.3, -0.5}, Eigen::Quaterniond::Identity()))});
        return RobotChecker(robot, &scene).first_contact(path);
    }
    [[nodiscard]] std::string path_of(const std::string& name) const { return path(name).string(); }
};

Configuration values(double shoulder, double elbow) {
    Configuration q(2);
    q << shoulder, elbow;
    return q;
}

TEST_F(RobotCommand, AnswersAsTheLibrary) {
    const Robot robot = Robot::load(path_of("arm.urdf"));
    const std::vector<Configuration> way{values(0, 0.5), values(0.1, 0.5), values(2, 0.5)};
    const RobotAnswer same = expected(JointPath::straight(robot, way));
    const tests::Finished finished = run("robot arm.urdf --path path.csv --scene cell.json");
    EXPECT_EQ(finished.status, 1);
    EXPECT_NE(finished.out.find("lower on cube (scene)"), std::string::npos) << finished.out;
    const Json answer = json("robot arm.urdf --path path.csv --scene cell.json");
    EXPECT_EQ(answer["verdict"], "contact");
    EXPECT_EQ(answer["segment"], 1);
    EXPECT_EQ(answer["time"].get<double>(), same.contact.time.lower);
    EXPECT_EQ(answer["time_upper"].get<double>(), same.contact.time.upper);
    EXPECT_EQ(answer["clear_until"].get<double>(), same.contact.clear_until);
    EXPECT_EQ(answer["pair"], Json({"lower", "cube"}));
    EXPECT_EQ(answer["configuration"]["shoulder"].get<double>(), same.configuration[0]);
    EXPECT_EQ(answer["configuration"]["elbow"].get<double>(), 0.5) << "left out: its limit nearest to 0";
    EXPECT_EQ(answer["contacts"].size(), 1U);
    const Json clear = json("robot arm.urdf --path path.csv");
    EXPECT_EQ(clear["verdict"], "clear");
    EXPECT_EQ(clear["clear_until"].get<double>(), 1);
    EXPECT_FALSE(clear.contains("pair"));
    EXPECT_EQ(run("robot arm.urdf --path path.csv").status, 0);
}

TEST_F(RobotCommand, TheStampOfTheStartIsExact) {
    write("start.csv", "t,shoulder\n0,0\n2,1\n");
    write("around.json", R"({"bodies": [{"name": "cube", "mesh": "cube.obj", "pose": [-0.5, -0.5, -0.5]}]})");
    const Json answer = json("robot arm.urdf --path start.csv --scene around.json");
    EXPECT_EQ(answer["verdict"], "contact_at_start");
    EXPECT_EQ(answer["time"], 0);
    EXPECT_EQ(answer["time_upper"], 0);
}

/// Stamps are no shares of the motion: 10 is not its end.
TEST_F(RobotCommand, SaysWhyAnAnswerIsUncertain) {
    write("cart.urdf", R"(<robot name="cart"><link name="base"/>
  <link name="cart"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <joint name="x" type="prismatic"><parent link="base"/><child link="cart"/><limit lower="-9" upper="9"/></joint></robot>)");
    write("wall.json", R"({"bodies": [{"name": "wall", "mesh": "cube.obj", "pose": [0.5000000001, -0.5, -0.5]}]})");
    for (const char* const rows : {"t,x\n10,0\n18,8\n", "x\n0\n8\n"}) {
        write("cart.csv", rows);
        const std::string text = run("robot cart.urdf --path cart.csv --scene wall.json").out;
        EXPECT_NE(text.find("certain   no: a rounding error decides whether the features named here meet"),
                  std::string::npos)
            << text;
    }
}

TEST_F(RobotCommand, CountsInStamps) {
    const Json answer = json("robot arm.urdf --path timed.csv --scene cell.json");
    const Robot robot = Robot::load(path_of("arm.urdf"));
    const std::vector<Configuration> way{values(0, 0.5), values(2, 0.5)};
    const RobotAnswer same = expected(JointPath::straight(robot, way));
    EXPECT_NEAR(answer["time"].get<double>(), 1 + 2 * same.contact.time.lower, 1e-12);
    EXPECT_NEAR(answer["contacts"][0]["approach_speed"].get<double>(), same.contact.contacts[0].approach_speed / 2,
                1e-9);
}

/// Twelve digits of seconds since 1970 are hundredths.
TEST_F(RobotCommand, TheFirstLineKeepsWhatIsAfterThePointOfAStamp) {
    write("epoch.csv", "t,elbow,shoulder\n1700000000,0.5,0\n1700000002,0.5,2\n");
    for (const std::string arguments :
         {"robot arm.urdf --path epoch.csv --scene cell.json", "robot arm.urdf --path epoch.csv --clearance"}) {
        const std::string text = run(arguments).out;
        const std::string before = "at time ";
        const std::size_t at = text.find(before);
        ASSERT_LT(at, text.find('\n')) << text;
        EXPECT_NEAR(std::stod(text.substr(at + before.size())), json(arguments)["time"].get<double>(), 1e-6) << text;
    }
}

TEST_F(RobotCommand, FindsTheClearance) {
    const Robot robot = Robot::load(path_of("arm.urdf"));
    const std::vector<Configuration> way{values(0, 0.5), values(0.1, 0.5), values(2, 0.5)};
    const RobotClearance same = RobotChecker(robot).least_distance(JointPath::straight(robot, way));
    const Json answer = json("robot arm.urdf --path path.csv --clearance");
    EXPECT_EQ(answer["distance"].get<double>(), same.distance.lower);
    EXPECT_EQ(answer["distance_upper"].get<double>(), same.distance.upper);
    EXPECT_EQ(answer["time"].get<double>(), same.nearest.time.lower);
    EXPECT_EQ(answer["pair"], Json({same.pair->first, same.pair->second}));
    EXPECT_EQ(answer["segment"], same.segment);
    EXPECT_EQ(answer["contacts"].size(), 1U);
    EXPECT_EQ(run("robot arm.urdf --path path.csv --clearance").status, 0);
    EXPECT_EQ(run("robot arm.urdf --path path.csv --clearance --scene cell.json").status, 1);
    EXPECT_EQ(json("robot arm.urdf --path path.csv --clearance --scene cell.json")["distance_upper"], 0);
    const Json timed = json("robot arm.urdf --path timed.csv --clearance");
    EXPECT_GE(timed["time"].get<double>(), 1);
    write("lonely.urdf", R"(<robot name="lonely"><link name="a"/><link name="b"/>
        <joint name="spin" type="continuous"><parent link="a"/><child link="b"/></joint></robot>)");
    write("lonely.csv", "spin\n0\n1\n");
    const Json lonely = json("robot lonely.urdf --path lonely.csv --clearance");
    for (const auto& [key, value] : timed.items())
        EXPECT_TRUE(lonely.contains(key)) << key;
    for (const char* const key : {"distance", "pair", "time", "segment", "configuration"})
        EXPECT_TRUE(lonely[key].is_null()) << key;
    EXPECT_NE(run("robot lonely.urdf --path lonely.csv --clearance").out.find("no two bodies are tested"),
              std::string::npos);
    EXPECT_EQ(run("robot arm.urdf --path path.csv --clearance --any").status, 2);
    EXPECT_EQ(run("robot arm.urdf --path path.csv --tolerance 0.1").status, 2);
}

/// The page of a long path takes longer than its answer.
TEST_F(RobotCommand, TheAnswerComesBeforeThePage) {
    const std::string question = "robot arm.urdf --path timed.csv --scene cell.json ";
    const tests::Finished plain = run(question), paged = run(question + "--page page.html");
    if (paged.err.find("this build has no viewer") != std::string::npos)
        GTEST_SKIP() << paged.err;
    EXPECT_EQ(paged.out, plain.out + "  page      page.html\n");
    EXPECT_EQ(run(question + "--json --page page.html").out, run(question + "--json").out);
    for (const std::string format : {"", "--json "}) {
        const tests::Finished full = run(question + format + "--page /dev/full");
        EXPECT_EQ(full.status, 2);
        EXPECT_EQ(full.out, run(question + format).out);
        EXPECT_NE(full.err.find("/dev/full"), std::string::npos) << full.err;
    }
}

TEST_F(RobotCommand, NamesTheDistanceOfAHeldContact) {
    write("lift.urdf", R"(<robot name="lift"><link name="post"/><link name="box"><collision>
        <origin xyz="0 0 0.52"/><geometry><box size="0.5 0.5 0.5"/></geometry></collision></link>
        <joint name="lift" type="prismatic"><parent link="post"/><child link="box"/><axis xyz="0 0 1"/>
        <limit lower="-9" upper="9"/></joint></robot>)");
    write("floor.json", R"({"bodies": [{"name": "floor", "mesh": "cube.obj", "pose": [-0.5, -0.5, -0.75]}]})");
    write("down.csv", "lift\n0\n-0.1\n");
    const std::string question = "robot lift.urdf --path down.csv --scene floor.json --margin 0.05 --hold ";
    EXPECT_TRUE(run(question + "0.01").out.starts_with("CONTACT at the hold distance, at time 0."));
    EXPECT_TRUE(run(question + "0.03").out.starts_with("CONTACT at the distance of the start, 0.02, at time "));
}

TEST_F(RobotCommand, ProvesPairsAndWritesThem) {
    write("arm.srdf", R"(<robot name="arm"><group name="all"><joint name="elbow"/></group>
        <disable_collisions link1="base" link2="lower" reason="Never"/></robot>)");
    const Json answer = json("acm arm.urdf");
    ASSERT_EQ(answer["pairs"].size(), 3U);
    EXPECT_EQ(answer["pairs"][1]["links"], Json({"base", "lower"}));
    EXPECT_EQ(answer["pairs"][1]["reason"], "sometimes") << "folded by 3 rad, the lower bar reaches the base";
    EXPECT_TRUE(answer["pairs"][1]["witness"].contains("elbow"));
    EXPECT_NE(run("acm arm.urdf --srdf arm.srdf --out new.srdf").out.find("does not test it"), std::string::npos);
    std::ifstream stream(path("new.srdf"));
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(text.find("<group name=\"all\">"), std::string::npos) << text;
    EXPECT_NE(text.find("link2=\"upper\" reason=\"Adjacent\""), std::string::npos) << text;
    EXPECT_EQ(text.find("link2=\"lower\" reason=\"Never\""), std::string::npos) << text;
}

/// A pair of adjacent links that a file enables is tested before and after.
TEST_F(RobotCommand, AcmKeepsTheAdjacentPairsThatAFileEnables) {
    const auto box = [](const std::string& name, const std::string& at) {
        return "<link name='" + name + "'><collision><origin xyz='" + at +
               " 0 0'/><geometry><box size='1 1 1'/></geometry></collision></link>";
    };
    write("hinge.urdf",
          "<robot name='hinge'>" + box("post", "0") + box("leaf", "2") +
              "<joint name='slide' type='prismatic'><parent link='post'/><child link='leaf'/>"
              "<axis xyz='1 0 0'/><limit lower='-1.5' upper='0' velocity='1' effort='1'/></joint></robot>");
    write("enabled.srdf", R"(<robot name="hinge"><enable_collisions link1="post" link2="leaf"/></robot>)");
    write("slide.csv", "slide\n0\n-1.5\n");
    EXPECT_EQ(run("acm hinge.urdf").out, "post  leaf  adjacent\n1 adjacent\n");
    EXPECT_EQ(run("acm hinge.urdf --srdf enabled.srdf --out new.srdf").out, "post  leaf  sometimes\n1 sometimes\n");
    for (const char* file : {"enabled.srdf", "new.srdf"})
        EXPECT_EQ(run(std::string("robot hinge.urdf --path slide.csv --srdf ") + file).status, 1) << file;
}

TEST_F(RobotCommand, SaysWhyThereIsNoPair) {
    write("lonely.urdf", R"(<robot name="lonely"><link name="a"/>
        <link name="b"><collision><geometry><sphere radius="1"/></geometry></collision></link>
        <joint name="spin" type="continuous"><parent link="a"/><child link="b"/></joint></robot>)");
    EXPECT_EQ(run("acm lonely.urdf").out,
              "no pair: a pair needs two links with collision shapes, and there are 1 among 2 links\n");
}

/// A slab slides on a table, and touches it everywhere without overlapping: no time decides that.
TEST_F(RobotCommand, SaysHowFarTheProofsAre) {
    const auto box = [](const std::string& name, const std::string& height) {
        return "<link name='" + name + "'><collision><origin xyz='0 0 " + height +
               "'/><geometry><box size='1 1 1'/></geometry></collision></link>";
    };
    const auto slide = [](const std::string& parent, const std::string& child, const std::string& axis) {
        return "<joint name='to " + child + "' type='prismatic'><parent link='" + parent + "'/><child link='" + child +
               "'/><axis xyz='" + axis + "'/><limit lower='-0.1' upper='0.1' velocity='1' effort='1'/></joint>";
    };
    write("slab.urdf", "<robot name='slab'>" + box("table", "0") + box("beam", "9") + box("slab", "1") +
                           slide("table", "beam", "1 0 0") + slide("beam", "slab", "0 1 0") + "</robot>");
    const tests::Finished found = run("acm slab.urdf --seconds 6.5 --threads 1");
    EXPECT_EQ(found.status, 0);
    EXPECT_NE(found.out.find("table  slab  open"), std::string::npos) << found.out;
    EXPECT_TRUE(found.err.starts_with("chasles: progress: 2 of 3 pairs are done after ")) << found.err;
    EXPECT_TRUE(found.err.ends_with(" s; the rest stays open after 6.5 s (--seconds)\n")) << found.err;
}

TEST_F(RobotCommand, RefusesWrongInput) {
    EXPECT_EQ(error_line("robot nothing.urdf --path path.csv"), "chasles: nothing.urdf: no such file");
    write("bad.csv", "wrist\n0\n");
    EXPECT_EQ(
        error_line("robot arm.urdf --path bad.csv"),
        "chasles: bad.csv: line 1: the header 'wrist' names no variable of the robot, which has 'shoulder, elbow'; "
        "fixed joints and joints that follow others have none");
    write("bad.csv", "shoulder\n0\nnan\n");
    EXPECT_EQ(error_line("robot arm.urdf --path bad.csv"),
              "chasles: bad.csv: line 3: shoulder: not a finite number: 'nan'");
    write("bad.csv", "t,shoulder\n0,0\n0,1\n");
    EXPECT_EQ(error_line("robot arm.urdf --path bad.csv"),
              "chasles: bad.csv: line 3: t: must increase, but is 0 after 0");
    EXPECT_EQ(error_line("robot arm.urdf --path path.csv --packages here"),
              "chasles: --packages: 'here' is not of the form NAME=FOLDER");
    EXPECT_EQ(error_line("acm arm.urdf --seconds 0"), "chasles: query: seconds: must be positive");
}

} // namespace
} // namespace chasles
