// --radius, and round bodies of scenes.
#include "tests/cli/cli_test_files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace chasles::tests {
namespace {

using Json = nlohmann::json;

class RadiusCommand : public CommandLine {
protected:
    [[nodiscard]] Json answer(const std::string& arguments) const {
        return Json::parse(run(arguments + " --json").out);
    }
    /// Of a cube at the origin and another body.
    [[nodiscard]] Json scene(const std::string& body, const std::string& options = "") const {
        write("scene.json", R"({"bodies": [{"name": "cube", "mesh": "cube.obj"}, {"name": "other", )" + body + "}]}");
        return answer("scene scene.json " + options);
    }
};

const std::string apart = " --start \"4 0 0\" --goal \"0 0 0\"";

TEST_F(RadiusCommand, AddsToBothBodies) {
    EXPECT_NEAR(answer("check cube.obj cube.obj" + apart)["time"], 0.75, 1e-11);
    EXPECT_NEAR(answer("check cube.obj cube.obj --radius 0.5" + apart)["time"], 0.625, 1e-11);
    EXPECT_NEAR(answer("check cube.obj cube.obj --radius 0,1" + apart)["time"], 0.5, 1e-11);
    EXPECT_NEAR(answer("check cube.obj cube.obj --radius 0.5,0.5" + apart)["time"], 0.5, 1e-11);
    const Json contact = answer("check cube.obj cube.obj --radius 0,1" + apart)["contacts"][0];
    EXPECT_NEAR(contact["point"][0], 2, 1e-11);
    EXPECT_NEAR(contact["gap"], 0, 1e-11);
    const Json least = answer("clearance cube.obj cube.obj --radius 0.25 --start \"4 0 0\" --goal \"2 0 0\"");
    EXPECT_NEAR(least["distance_upper"], 0.75, 1e-9);
    EXPECT_EQ(run("check cube.obj cube.obj --radius 1,2,3" + apart).err.substr(0, 18), "chasles: --radius:");
}

TEST_F(RadiusCommand, BelowZeroLetsBodiesTouch) {
    const std::string lifted = " --start \"0 0 1\" --goal \"0 0 2\"";
    EXPECT_EQ(answer("check cube.obj cube.obj" + lifted)["verdict"], "contact_at_start");
    EXPECT_NE(run("check cube.obj cube.obj" + lifted)
                  .out.find("way out   closed bodies that touch by design may have a radius below 0"),
              std::string::npos);
    EXPECT_EQ(answer("check cube.obj cube.obj --radius -1e-6" + lifted)["verdict"], "clear");
    EXPECT_EQ(answer("check cube.obj cube.obj --radius 0,-1e-6" + lifted)["verdict"], "clear");
    EXPECT_NE(run("info cube.obj --radius -0.125").out.find("  radius    -0.125: faces have moved inwards\n"),
              std::string::npos);
    EXPECT_EQ(answer("info cube.obj --radius -0.125")["moved_inwards"], 0.125);
    EXPECT_EQ(answer("info cube.obj --radius 0.5")["bounding_box"]["upper"][0], 1.5);
}

TEST_F(RadiusCommand, BodiesOfScenesHaveTheirOwn) {
    const std::string way = R"(, "pose": [4, 0.5, 0.5], "goal": [0, 0.5, 0.5])";
    EXPECT_NEAR(scene(R"("sphere": 0.5)" + way)["time"], 0.625, 1e-11);
    EXPECT_NEAR(scene(R"("capsule": [0.5, 0.25])" + way)["time"], 0.625, 1e-11);
    EXPECT_NEAR(scene(R"("mesh": "cube.obj", "radius": 0.5)" + way)["time"], 0.625, 1e-11);
    EXPECT_NEAR(scene(R"("mesh": "cube.obj", "radius": 0.5)" + way, "--radius 0.5")["time"], 0.5, 1e-11);
    const auto error = [&](const std::string& body) {
        write("scene.json", R"({"bodies": [{"name": "other", )" + body + "}]}");
        return run("scene scene.json").err;
    };
    EXPECT_EQ(error(R"("sphere": 0)"), "chasles: scene.json: body 1: 'other': sphere: radius: must be positive "
                                       "and at most 1e30, and is 0\n");
    EXPECT_EQ(error(R"("capsule": [1, -1])"), "chasles: scene.json: body 1: 'other': capsule: length: must be positive "
                                              "and at most 1e30, and is -1\n");
    EXPECT_EQ(error(R"("scale": 1)"), "chasles: scene.json: body 1: 'other': mesh: is missing\n");
    EXPECT_EQ(error(R"("capsule": [1])"),
              "chasles: scene.json: body 1: 'other': capsule: needs [radius, length], and there are 1\n");
    EXPECT_EQ(error(R"("sphere": 1, "mesh": "cube.obj")"),
              "chasles: scene.json: body 1: 'other': mesh: goes with a mesh, and the body has a sphere\n");
    EXPECT_EQ(error(R"("sphere": 1, "radius": 2)"), "chasles: scene.json: body 1: 'other': radius: goes with a mesh, a "
                                                    "urdf or points, and the body has a sphere\n");
    EXPECT_EQ(error(R"("sphere": 1, "capsule": [1, 1])"),
              "chasles: scene.json: body 1: 'other': capsule: the body has a sphere already\n");
}

TEST_F(RadiusCommand, CloudsOfPointsAreBodiesOfScenes) {
    write("cloud.xyz", "0 0 0\n0 0.5 0.5\n");
    const std::string way = R"(, "pose": [4, 0, 0], "goal": [0, 0, 0])";
    EXPECT_NEAR(scene(R"("points": "cloud.xyz", "radius": 0.5)" + way)["time"], 0.625, 1e-11);
    EXPECT_NEAR(scene(R"("points": "cloud.xyz")" + way, "--radius 0.5")["time"], 0.5, 1e-11) << "and the cube";
    EXPECT_NE(run("scene scene.json").err.find("points: need a radius above 0 beside them"), std::string::npos);
}

TEST_F(RadiusCommand, IsForRobotsAndTheirScenes) {
    write("box.urdf",
          "<robot name=\"r\"><link name=\"a\"><collision><geometry><box size=\"2 2 2\"/></geometry></collision>"
          "</link></robot>");
    write("scene.json", R"({"bodies": [{"name": "cube", "mesh": "cube.obj", "pose": [1.5, 0, 0]}]})");
    EXPECT_EQ(answer("robot box.urdf --scene scene.json")["verdict"], "clear");
    EXPECT_EQ(answer("robot box.urdf --scene scene.json --radius 0.75")["verdict"], "contact_at_start");
    EXPECT_EQ(answer("robot box.urdf --scene scene.json --radius 0,0.75")["verdict"], "contact_at_start");
    EXPECT_EQ(answer("robot box.urdf --scene scene.json --radius -0.75,0.75")["verdict"], "clear");
    EXPECT_NE(run("info box.urdf --radius -5").err.find("turns face 0 over"), std::string::npos);
    EXPECT_NE(run("check cube.obj cube.obj --radius 1, --start \"0 0 0\" --goal \"1 0 0\"").err.find("--radius: "),
              std::string::npos);
}

/// A leaf slides towards a post: their gap is from 1 down to 0.5, or to -0.5.
TEST_F(RadiusCommand, IsForPairsOfLinks) {
    const auto reason = [&](const char* lower, const std::string& options) -> std::string {
        const std::string box = "<collision><geometry><box size='1 1 1'/></geometry></collision>";
        write("slide.urdf", "<robot name='r'><link name='post'>" + box + "</link><link name='leaf'>" + box +
                                "</link><joint name='slide' type='prismatic'><parent link='post'/><child link='leaf'/>"
                                "<origin xyz='2 0 0'/><axis xyz='1 0 0'/><limit lower='" +
                                lower + "' upper='0' velocity='1' effort='1'/></joint></robot>");
        write("slide.srdf", "<robot name='r'><enable_collisions link1='post' link2='leaf'/></robot>");
        return answer("acm slide.urdf --srdf slide.srdf " + options)["pairs"][0]["reason"];
    };
    EXPECT_EQ(reason("-0.5", ""), "never");
    EXPECT_EQ(reason("-0.5", "--radius 0.2"), "never");
    EXPECT_EQ(reason("-0.5", "--radius 0.3"), "sometimes");
    EXPECT_EQ(reason("-0.5", "--radius 0.6"), "always");
    EXPECT_EQ(reason("-1.5", ""), "sometimes");
    EXPECT_EQ(reason("-1.5", "--radius -0.3"), "never");
    EXPECT_EQ(run("acm slide.urdf --radius 1,2").err.substr(0, 18), "chasles: --radius:");
}

TEST_F(RadiusCommand, PagesDrawRoundBodies) {
    write(
        "scene.json",
        R"({"bodies": [{"name": "ball", "sphere": 1, "goal": [0, 0, 1]}, {"name": "cube", "mesh": "cube.obj", "pose": [0, 0, 9]}]})");
    EXPECT_EQ(run("scene scene.json --page page.html").err, "");
}

} // namespace
} // namespace chasles::tests
