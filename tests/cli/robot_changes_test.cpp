// chasles robot: parts that it carries, pairs that may touch, hold, warnings, and a robot without moving joints.
#include "tests/cli/cli_test_files.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

namespace chasles {
namespace {

using Json = nlohmann::json;

class RobotChangesCommand : public tests::CommandLine {
protected:
    RobotChangesCommand() {
        write("arm.urdf", R"(<robot name="arm">
 <link name="base"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.3 0.3 0.2"/></geometry></collision></link>
 <link name="l1"><collision><origin xyz="0.5 0 0.35"/><geometry><box size="1 0.1 0.1"/></geometry></collision></link>
 <link name="l2"><collision><origin xyz="1.5 0 0.35"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
 <joint name="j1" type="revolute"><parent link="base"/><child link="l1"/><axis xyz="0 0 1"/><limit lower="-3" upper="3"/></joint>
 <joint name="j2" type="prismatic"><parent link="l1"/><child link="l2"/><axis xyz="1 0 0"/><limit lower="0" upper="1"/></joint>
</robot>)");
        write("table.json", R"({"bodies": [{"name": "table", "mesh": "cube.obj", "scale": 4, "pose": [-2, -2, -4]}]})");
        write("path.csv", "j1,j2\n0,0\n1.5,0\n");
        write("block.obj", "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    }
    [[nodiscard]] Json json(const std::string& arguments) const {
        return Json::parse(run("robot arm.urdf --path path.csv --json " + arguments).out);
    }
    [[nodiscard]] std::string refused(const std::string& arguments) const {
        return error_line("robot arm.urdf --path path.csv " + arguments);
    }
};

TEST_F(RobotChangesCommand, ARobotMayStandOnItsTable) {
    EXPECT_EQ(json("--scene table.json")["verdict"], "contact_at_start");
    const tests::Finished found = run("robot arm.urdf --path path.csv --scene table.json --allow base,table");
    EXPECT_EQ(found.status, 0);
    EXPECT_TRUE(found.out.starts_with(
        "CLEAR: proven that no tested pair touches during the whole motion; motion: straight in joint space\n"
        "  untested  3 pairs: 2 adjacent (base and l1, l1 and l2), 1 ignored (base and table (scene))\n"))
        << found.out;
    const Json untested = json("--scene table.json --allow base,table")["untested"];
    EXPECT_EQ(untested["tested"], 3);
    EXPECT_EQ(untested["reasons"][1]["pairs"], Json::parse(R"([["base", "table"]])"));
    EXPECT_EQ(json("--scene table.json --allow table,base")["untested"], untested) << "in either order";
    EXPECT_EQ(json("--allow base,l2")["untested"]["tested"], 0);
}

TEST_F(RobotChangesCommand, CarriesMeshesByName) {
    const std::string low = "--attach 'l2,block.obj,1.5 0 0.2' --scene table.json --allow base,table ";
    EXPECT_EQ(json(low)["verdict"], "clear");
    EXPECT_EQ(json(low)["untested"]["tested"], 6) << "the part with base, l1 and the table, beside the links";
    const Json found = json("--attach l2,block.obj,1.5,0,-0.05 --scene table.json --allow base,table");
    EXPECT_EQ(found["verdict"], "contact_at_start");
    EXPECT_EQ(found["pair"], Json({"block", "table"}));
    EXPECT_EQ(
        json("--attach l2,block.obj,1.5,0,-0.05 --scene table.json --allow base,table --allow block,table")["verdict"],
        "clear");
    const Json two = json("--attach l2,block.obj,1.5,0,3 --attach 'l1,block.obj,0 0 -1 1 0 0 0' --allow block,block_2");
    EXPECT_EQ(two["untested"]["reasons"].back()["pairs"].back(), Json({"block", "block_2"}));
    EXPECT_EQ(two["warnings"], Json({"--attach: the name 'block' is taken: the part has the name 'block_2'"}));
}

/// Who mends a start needs all of them.
TEST_F(RobotChangesCommand, NamesAllPairsInContactAtTheStart) {
    write("two.json", R"({"bodies": [{"name": "table", "mesh": "cube.obj", "scale": 4, "pose": [-2, -2, -4]},
                                     {"name": "floor", "mesh": "cube.obj", "scale": 4, "pose": [-1, -1, -4]}]})");
    const Json found = json("--scene two.json");
    EXPECT_EQ(found["verdict"], "contact_at_start");
    Json pairs = found["also"];
    pairs.push_back(found["pair"]);
    EXPECT_EQ(std::set<Json>(pairs.begin(), pairs.end()), (std::set<Json>{{"base", "floor"}, {"base", "table"}}));
    EXPECT_NE(run("robot arm.urdf --path path.csv --scene two.json").out.find("\n  also      base and "),
              std::string::npos);
    EXPECT_FALSE(json("--scene two.json --allow base,floor --allow base,table").contains("also"));
}

/// Meshes are cut as those of the robot itself (RobotWarnings).
TEST_F(RobotChangesCommand, WarnsOfPolygonsThatWereCut) {
    write("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4\n");
    for (const std::string scale : {"1", "2"}) {
        write("bent.json",
              R"({"bodies": [{"name": "sheet", "mesh": "bent.obj", "pose": [9, 9, 9], "scale": )" + scale + "}]}");
        const Json warnings = json("--attach l2,bent.obj,1.5,0,3 --scene bent.json")["warnings"];
        ASSERT_EQ(warnings.size(), 2U) << warnings;
        for (const Json& warning : warnings)
            EXPECT_NE(warning.get<std::string>().find("bent.obj: 1 polygon leaves its plane by "), std::string::npos)
                << warning;
    }
}

TEST_F(RobotChangesCommand, HoldsADistance) {
    write("table.json", R"({"bodies": [{"name": "table", "mesh": "cube.obj", "scale": 4, "pose": [-2, -2, -4.05]}]})");
    EXPECT_EQ(json("--scene table.json --margin 0.1")["verdict"], "contact_at_start");
    const Json held = json("--scene table.json --margin 0.1 --hold 0.01");
    EXPECT_EQ(held["verdict"], "clear");
    EXPECT_EQ(refused("--scene table.json --margin 0.1 --hold 0.1"),
              "chasles: query: hold: 0.1 is not less than the margin 0.1");
    EXPECT_TRUE(run("robot arm.urdf --path path.csv --scene table.json --margin 0.1 --hold 0.01")
                    .out.starts_with("CLEAR: proven that no tested pair that is held comes within 0.01"));
}

/// As for `chasles scene`; an option stands instead of the file's.
TEST_F(RobotChangesCommand, TakesMarginAndHoldOfTheScene) {
    const auto write_table = [&](const std::string& keys) {
        write("table.json", "{" + keys + R"("bodies": [{"name": "table", "mesh": "cube.obj", "scale": 4,
            "pose": [-2, -2, -4.05]}]})");
    };
    write_table("");
    EXPECT_EQ(json("--scene table.json")["verdict"], "clear");
    write_table(R"("margin": 0.1, )");
    EXPECT_EQ(json("--scene table.json")["verdict"], "contact_at_start");
    EXPECT_TRUE(run("robot arm.urdf --path path.csv --scene table.json").out.starts_with("CONTACT within 0.1 AT THE"));
    EXPECT_EQ(json("--scene table.json --margin 0.01")["verdict"], "clear");
    EXPECT_EQ(json("--scene table.json --hold 0.01")["verdict"], "clear");
    write_table(R"("margin": 0.1, "hold": 0.01, )");
    EXPECT_EQ(json("--scene table.json")["verdict"], "clear");
    EXPECT_EQ(json("--scene table.json --margin 0.005")["warnings"],
              Json({"hold: 0.01 is not less than the margin 0.005 of the command line, and is left out"}));
    EXPECT_EQ(refused("--scene table.json --hold 0.1"), "chasles: query: hold: 0.1 is not less than the margin 0.1");
    const std::string clearance = "robot arm.urdf --path path.csv --clearance --scene table.json";
    EXPECT_EQ(run(clearance).err, "chasles: warning: table.json: margin has no effect on a clearance\n"
                                  "chasles: warning: table.json: hold has no effect on a clearance\n");
    EXPECT_EQ(json("--clearance --scene table.json")["warnings"].size(), 2U);
    write_table(R"("ignore_touching_at_start": true, )");
    EXPECT_EQ(refused("--scene table.json"),
              "chasles: table.json: ignore_touching_at_start: is not for robots; leave it out, and name what a robot "
              "may touch by --allow LINK,BODY");
    write_table(R"("ignore_touching_at_start": false, )");
    EXPECT_EQ(json("--scene table.json")["verdict"], "clear");
}

TEST_F(RobotChangesCommand, WarnsOfWhatHasNoEffect) {
    write("arm.srdf", R"(<robot name="arm"><disable_collisions link1="base" link2="table" reason="Never"/></robot>)");
    write("path.csv", "j1,j2\n0,0\n90,1.5\n");
    const tests::Finished found = run("robot arm.urdf --path path.csv --srdf arm.srdf");
    EXPECT_EQ(found.err, "chasles: warning: arm.srdf:1: <disable_collisions>: there is no link 'table'\n"
                         "chasles: warning: path: j1: 90 in configuration 1 looks like degrees; angles are in radians\n"
                         "chasles: warning: path: j2: 1.5 in configuration 1 is beyond the limits [0, 1]\n");
    EXPECT_EQ(found.status, 0);
    EXPECT_EQ(json("--srdf arm.srdf")["warnings"].size(), 3U);
    EXPECT_EQ(json("--srdf arm.srdf --clearance")["warnings"].size(), 3U);
    write("path.csv", "j1\n0\n1.5\n");
    EXPECT_EQ(json("")["warnings"], Json({"path.csv: line 1: no values for 'j2': they stay at their neutral values"}));
}

TEST_F(RobotChangesCommand, ARobotWithoutMovingJointsNeedsNoPath) {
    write("bench.urdf",
          R"(<robot name="bench"><link name="top"><collision><geometry><box size="2 1 0.1"/></geometry></collision>
        </link></robot>)");
    write("ball.json", R"({"bodies": [{"name": "ball", "mesh": "cube.obj", "pose": [0, 0, 2], "goal": [0, 0, -2]}]})");
    EXPECT_EQ(run("robot bench.urdf").status, 0);
    EXPECT_TRUE(run("robot bench.urdf").out.starts_with("CLEAR: no pair is tested; motion: "));
    const Json found = Json::parse(run("robot bench.urdf --scene ball.json --json").out);
    EXPECT_NEAR(found["time"].get<double>(), 1.95 / 4, 1e-9);
    EXPECT_EQ(found["pair"], Json({"top", "ball"}));
    write("t.csv", "t\n0\n8\n");
    EXPECT_NEAR(Json::parse(run("robot bench.urdf --scene ball.json --path t.csv --json").out)["time"].get<double>(),
                3.9, 1e-8)
        << "in stamps";
    EXPECT_EQ(error_line("robot arm.urdf"), "chasles: --path: is needed for the 2 variables of the robot: j1, j2");
}

TEST_F(RobotChangesCommand, RefusesWrongChangesInOneLine) {
    write("far.json", R"({"bodies": [{"name": "comet", "mesh": "cube.obj", "pose": [0, 0, -1e14],
                                      "goal": [1, 2, 1e14, 1, 1, 0, 0]}]})");
    EXPECT_TRUE(
        refused("--scene far.json").starts_with("chasles: far.json: path.csv: robot: base and comet: motion: goes up"));
    EXPECT_TRUE(
        refused("--scene far.json --clearance").starts_with("chasles: far.json: path.csv: robot: base and comet: "));
    EXPECT_EQ(refused("--allow base"), "chasles: --allow: 'base' is not of the form LINK,BODY");
    EXPECT_EQ(refused("--allow leg,l1"), "chasles: --allow: 'leg,l1': the robot has no link or part 'leg'");
    EXPECT_EQ(refused("--allow base,table"),
              "chasles: --allow: 'base,table': 'table' is no link, no part; a body needs --scene");
    EXPECT_EQ(refused("--scene table.json --allow base,chair"),
              "chasles: --allow: 'base,chair': 'chair' is no link, no part and no body of the scene");
    EXPECT_EQ(refused("--allow base,base"), "chasles: --allow: robot: base: is named twice");
    write("l1.json", R"({"bodies": [{"name": "l1", "mesh": "cube.obj", "pose": [9, 9, 9]}]})");
    EXPECT_EQ(refused("--scene l1.json --allow base,l1"),
              "chasles: --allow: 'base,l1': 'l1' is a link and a body of the scene; rename the body");
    EXPECT_EQ(refused("--scene l1.json"),
              "chasles: scene: 'l1' is a body of the scene and a link or part of the robot; rename the body");
    EXPECT_EQ(refused("--attach l1,block.obj"), "chasles: --attach: 'l1,block.obj' is not of the form LINK,MESH,POSE");
    EXPECT_EQ(refused("--attach leg,block.obj,1,2,3"), "chasles: --attach: robot: leg: there is no such link or part");
    EXPECT_EQ(refused("--attach l1,no.obj,1,2,3"), "chasles: --attach: no.obj: no such file");
    EXPECT_TRUE(refused("--attach l1,block.obj,1,2").starts_with("chasles: --attach: 'l1,block.obj,1,2': "));
}

/// The inputs on which the product failed; what each must say is in the issue.
TEST_F(RobotChangesCommand, AnswersTheInputsOfTheField) {
    const std::filesystem::path field = std::filesystem::path(CHASLES_DATA_DIR) / "field";
    if (!std::filesystem::is_directory(field / "17-open-with-a-witness"))
        GTEST_SKIP() << "skipped: no " << field;
    const auto at = [&](const std::string& file) { return (field / file).string(); };
    const std::string table = "robot " + at("05-robot-on-its-table/arm.urdf") + " --path " +
                              at("05-robot-on-its-table/j.csv") + " --scene " + at("05-robot-on-its-table/table.json");
    EXPECT_EQ(run(table).status, 1);
    EXPECT_EQ(run(table + " --allow base,table").status, 0);
    EXPECT_NE(run(table + " --srdf " + at("05-robot-on-its-table/t.srdf")).err.find("there is no link 'table'"),
              std::string::npos);
    const std::string limits = "robot " + at("09-limits/swaplimit.urdf") + " --path " + at("09-limits/j.csv");
    EXPECT_EQ(run(limits).status, 0);
    EXPECT_NE(run(limits).err.find("the joint has no limits"), std::string::npos);
    const std::string door = "robot " + at("11-adjacent-links/hinge.urdf") + " --path " + at("11-adjacent-links/h.csv");
    EXPECT_TRUE(run(door).out.starts_with("CLEAR: no pair is tested; motion: straight in joint space\n"
                                          "  untested  1 pair: 1 adjacent (frame and door)\n"));
    EXPECT_EQ(run(door + " --srdf " + at("11-adjacent-links/en.srdf")).status, 1);
    const tests::Finished tiles = run("scene " + at("13-bodies-at-rest/tiles_move.json"));
    EXPECT_NE(tiles.out.find("pair      b on t"), std::string::npos) << "only the body moves" << tiles.out;
    EXPECT_NE(tiles.out.find("36 at rest"), std::string::npos) << tiles.out;
    EXPECT_NE(run("acm " + at("17-open-with-a-witness/arm.urdf")).out.find("fore   sometimes"), std::string::npos)
        << run("acm " + at("17-open-with-a-witness/arm.urdf")).out;
}

} // namespace
} // namespace chasles
