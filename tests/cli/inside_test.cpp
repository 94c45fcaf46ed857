// Bodies inside of each other on the command line: every command names them, and --solid is for every kind of body.
#include "tests/cli/cli_test_files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace chasles::tests {
namespace {

using Json = nlohmann::json;

class InsideCommand : public CommandLine {
protected:
    InsideCommand() {
        write("speck.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        write("mesh.urdf", robot("<mesh filename=\"cube.obj\"/>"));
        write("box.urdf", robot("<box size=\"2 2 2\"/>"));
    }
    static std::string robot(const std::string& shape) {
        return "<robot name=\"r\"><link name=\"a\"><collision><geometry>" + shape +
               "</geometry></collision></link></robot>";
    }
    [[nodiscard]] Json answer(const std::string& arguments) const {
        return Json::parse(run(arguments + " --json").out);
    }
    /// A speck in a body of a scene.
    [[nodiscard]] std::string verdict(const std::string& body, const std::string& options = "") {
        write("scene.json",
              R"({"bodies": [{"name": "speck", "mesh": "speck.obj", "pose": [0.4, 0.4, 0.4], "goal": [0.5, 0.4, 0.4]},
            {"name": "other", )" +
                  body + "}]}");
        return answer("scene scene.json " + options)["verdict"];
    }
};

const std::string motion = " --start \"0.4 0.4 0.4\" --goal \"5 0 0\"";

TEST_F(InsideCommand, EveryAnswerNamesTheBody) {
    for (const std::string command : {"check", "clearance"}) {
        const Json inner = answer(command + " speck.obj cube.obj" + motion);
        EXPECT_EQ(inner["inside"], "moving") << command;
        EXPECT_TRUE(inner["contacts"].empty());
        EXPECT_EQ(inner["inside_point"].size(), 3U);
        EXPECT_EQ(answer(command + " cube.obj speck.obj --start \"-0.4 -0.4 -0.4\" --goal \"5 0 0\"")["inside"],
                  "fixed");
        EXPECT_FALSE(answer(command + " speck.obj cube.obj --solid no" + motion).contains("inside"));
    }
    EXPECT_NE(run("check speck.obj cube.obj" + motion).out.find("the moving body is inside of the fixed one"),
              std::string::npos);
    EXPECT_EQ(run("check speck.obj cube.obj --solid round" + motion).err,
              "chasles: --solid: must be automatic, yes or no, and is 'round'\n");
}

TEST_F(InsideCommand, SolidIsForMeshesAndRobotsOfScenes) {
    for (const std::string body : {R"("mesh": "cube.obj")", R"("urdf": "mesh.urdf")", R"("urdf": "box.urdf")"}) {
        EXPECT_EQ(verdict(body), "contact_at_start") << body;
        EXPECT_EQ(verdict(body, "--solid no"), "clear") << body;
        EXPECT_EQ(verdict(body + R"(, "solid": "no")"), "clear") << body;
        EXPECT_EQ(verdict(body + R"(, "solid": "yes")", "--solid no"), "contact_at_start") << body;
    }
    EXPECT_EQ(answer("scene scene.json --all")["events"][0]["inside"], "moving");
}

TEST_F(InsideCommand, SolidIsForTheMeshesOfARobotAndItsParts) {
    write("scene.json", R"({"bodies": [{"name": "speck", "mesh": "speck.obj", "pose": [0.4, 0.4, 0.4]}]})");
    EXPECT_EQ(answer("robot mesh.urdf --scene scene.json")["inside"], "fixed");
    EXPECT_EQ(answer("robot mesh.urdf --scene scene.json --solid no")["verdict"], "clear");
    EXPECT_EQ(answer("robot box.urdf --scene scene.json --solid no")["inside"], "fixed") << "a primitive is solid";
    write("empty.urdf", "<robot name=\"r\"><link name=\"a\"/></robot>");
    const std::string carried = "robot empty.urdf --attach \"a,cube.obj,0 0 0\" --scene scene.json";
    EXPECT_EQ(answer(carried)["inside"], "fixed");
    EXPECT_EQ(answer(carried + " --solid no")["verdict"], "clear");
}

} // namespace
} // namespace chasles::tests
