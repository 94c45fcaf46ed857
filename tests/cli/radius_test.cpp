// --radius, and round bodies of scenes.
#include "tests/cli/cli_test_files.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
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
    EXPECT_EQ(error(R"("scale": 1)"), "chasles: scene.json: body 1: 'other': has no shape; a body has one of mesh, "
                                      "urdf, sphere, capsule and points\n");
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

/// A cube that ends at x = 1, and bodies about x = 4 with a radius of 1/2: 5/2 apart.
TEST_F(RadiusCommand, IsAddedToSpheresCapsulesAndPoints) {
    write("point.xyz", "0 0 0\n");
    write("ball.urdf", "<robot name='r'><link name='a'><collision><geometry><sphere radius='0.5'/></geometry>"
                       "</collision></link></robot>");
    for (const std::string shape : {R"("sphere": 0.5)", R"("capsule": [0.5, 0.25])",
                                    R"("points": "point.xyz", "radius": 0.5)", R"("urdf": "ball.urdf")"}) {
        const std::string body = shape + R"(, "pose": [4, 0.5, 0.5], "goal": [0, 0.5, 0.5])";
        EXPECT_NEAR(scene(body)["time"], 0.625, 1e-11) << shape;
        EXPECT_NEAR(scene(body, "--radius 0.25")["time"], 0.5, 1e-11) << shape << ", and the cube";
        EXPECT_NEAR(scene(body, "--radius=-0.25")["time"], 0.75, 1e-11) << shape;
        write("alone.json", R"({"bodies": [{"name": "other", )" + shape + "}]}");
        const std::string error = run("scene alone.json --radius=-0.5").err;
        EXPECT_NE(error.find("radius: that of the shape, 0.5, and the added one, -0.5, must be above 0 together"),
                  std::string::npos)
            << error;
    }
}

/// A ball on a slide passes another one: the distance of their middles is 1.7, and 1.5 is the sum of their radii.
TEST_F(RadiusCommand, IsAddedToRoundBodiesAroundRobots) {
    write("slide.urdf", "<robot name='b'><link name='base'/><link name='ball'><collision><geometry>"
                        "<sphere radius='0.5'/></geometry></collision></link><joint name='j' type='prismatic'>"
                        "<parent link='base'/><child link='ball'/><axis xyz='1 0 0'/>"
                        "<limit lower='-40' upper='40'/></joint></robot>");
    write("path.csv", "j\n-10\n10\n");
    write("point.xyz", "0 0 0\n");
    for (const std::string shape :
         {R"("sphere": 1)", R"("capsule": [1, 0.5])", R"("points": "point.xyz", "radius": 1)"}) {
        write("scene.json", R"({"bodies": [{"name": "other", )" + shape + R"(, "pose": [0, 1.7, 0]}]})");
        const std::string robot = "robot slide.urdf --path path.csv --scene scene.json ";
        EXPECT_EQ(answer(robot)["verdict"], "clear") << shape;
        EXPECT_NEAR(answer(robot + "--radius 0,0.3")["time"], (10 - std::sqrt(1.8 * 1.8 - 1.7 * 1.7)) / 20, 1e-11);
        EXPECT_NEAR(answer(robot + "--radius 0.2,0.3")["time"], (10 - std::sqrt(2.0 * 2.0 - 1.7 * 1.7)) / 20, 1e-11);
        EXPECT_NEAR(answer(robot + "--clearance")["distance_upper"], 0.2, 1e-6) << shape;
        EXPECT_NEAR(answer(robot + "--clearance --radius 0.05,0.1")["distance_upper"], 0.05, 1e-6) << shape;
        EXPECT_NEAR(answer(robot + "--clearance --radius=-0.05,-0.1")["distance_upper"], 0.35, 1e-6) << shape;
    }
}

/// A ball comes down onto another one; both have a radius of 1/2.
TEST_F(RadiusCommand, IsAddedToRoundBodiesInAHand) {
    write("scene.json", R"({"bodies": [{"name": "fixed", "sphere": 0.5},
                                       {"name": "ball", "capsule": [0.5, 0.25], "pose": [3, 0, 0]}]})");
    write("goals.csv", "x,y,z,qw,qx,qy,qz\n0,0,0,1,0,0,0\n0,0,0,1,0,0,0\n");
    const auto place = [&](const std::string& radius) {
        EXPECT_EQ(
            run("drag scene.json --body ball --goals goals.csv --out out.csv --margin 0.001 --rounds 99 " + radius)
                .status,
            1);
        std::ifstream stream(path("out.csv"));
        const std::string rows(std::istreambuf_iterator<char>(stream), {});
        return std::stod(rows.substr(rows.find("\n1,") + 3));
    };
    EXPECT_NEAR(place(""), 1.001, 1e-6);
    EXPECT_NEAR(place("--radius 0.25"), 1.501, 1e-6);
    EXPECT_NEAR(place("--radius=-0.25"), 0.501, 1e-6);
}

/// A hint about radii below 0 is for bodies that can have one.
TEST_F(RadiusCommand, RoundBodiesGetNoHintThatTheyCannotUse) {
    const std::string balls = R"({"bodies": [{"name": "a", "sphere": 1},
        {"name": "b", "sphere": 1, "pose": [1.5, 0, 0], "goal": [5, 0, 0]}]})";
    write("scene.json", balls);
    const auto found = run("scene scene.json");
    EXPECT_NE(found.out.find("CONTACT AT THE START"), std::string::npos) << found.out;
    EXPECT_EQ(found.out.find("way out"), std::string::npos) << found.out;
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
