// chasles scene: the answers are those of the library, and every wrong file gets one line.
#include "tests/cli/cli_test_files.h"

#include "chasles/chasles.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

const std::string bodies = R"([
  {"name": "floor", "mesh": "cube.obj", "scale": 10, "pose": [-5, -5, -10], "group": "static"},
  {"name": "falling", "mesh": "cube.obj", "pose": [0, 0, 3, 1, 0.1, 0.2, 0], "goal": [0, 0, -1, 1, 0.5, 0, 0.3],
   "centre": [0.5, 0.5, 0.5]},
  {"name": "thrown", "mesh": "cube.obj", "pose": [-4, 0.2, 1], "goal": [3, 0.2, 2, 1, 0, 1, 0], "motion": "twist"},
  {"name": "walking", "mesh": "cube.obj", "poses": [{"t": 0, "pose": [4, 4, 1]}, {"t": 0.5, "pose": [2, 2, 1]},
                                                   {"t": 1, "pose": [0, 0, 1]}]}])";

class SceneCommand : public tests::CommandLine {
protected:
    SceneCommand() { write("scene.json", "{\"bodies\": " + bodies + "}"); }

    [[nodiscard]] Json json(const std::string& options) const {
        return Json::parse(run("scene scene.json --json " + options).out);
    }
    [[nodiscard]] std::string content(const std::string& file) const {
        std::ifstream stream(path(file), std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    /// The same scene by the library.
    [[nodiscard]] Scene same() const {
        const Polyhedron cube = Polyhedron::load(path("cube.obj").string());
        std::vector<Eigen::Vector3d> large;
        std::vector<std::vector<std::uint32_t>> faces;
        for (const Eigen::Vector3d& v : cube.vertices())
            large.emplace_back(10 * v);
        for (std::size_t i = 0; i < cube.face_count(); ++i)
            faces.emplace_back(cube.face(i).begin(), cube.face(i).end());
        const auto pose = [](double x, double y, double z, double w = 1, double a = 0, double b = 0, double c = 0) {
            return Pose({x, y, z}, Eigen::Quaterniond(w, a, b, c));
        };
        Scene scene;
        scene.add({"floor", Polyhedron::from_polygons(large, faces), Motion::at_rest(pose(-5, -5, -10)), "static"});
        scene.add({"falling", cube,
                   Motion::velocity(pose(0, 0, 3, 1, 0.1, 0.2, 0), pose(0, 0, -1, 1, 0.5, 0, 0.3), {0.5, 0.5, 0.5})});
        scene.add({"thrown", cube, Motion::twist(pose(-4, 0.2, 1), pose(3, 0.2, 2, 1, 0, 1, 0))});
        scene.add({"walking", cube, TimedPoses::through({0, 0.5, 1}, {pose(4, 4, 1), pose(2, 2, 1), pose(0, 0, 1)})});
        return scene;
    }
    [[nodiscard]] std::string refused(const std::string& content) const {
        write("bad.json", content);
        const std::string line = error_line("scene bad.json");
        const std::string start = "chasles: bad.json: ";
        EXPECT_EQ(line.substr(0, start.size()), start);
        return line.substr(std::min(start.size(), line.size()));
    }
};

TEST_F(SceneCommand, RefusesAMotionOfABodyThatStandsStill) {
    for (const std::string member : {"\"motion\": \"twist\"", "\"motion\": \"velocity\"", "\"centre\": [0, 0, 0]"})
        EXPECT_EQ(refused(R"({"bodies": [{"name": "a", "mesh": "cube.obj", "pose": [0, 0, 0], )" + member + "}]}"),
                  "body 1: 'a': " + member.substr(1, 6) +
                      ": is for a body that moves; without a goal or poses it stands still");
}

TEST_F(SceneCommand, AnswersAsTheLibrary) {
    const Scene scene = same();
    const SceneAnswer first = scene.first_contact(), all = scene.all_contacts();
    ASSERT_GE(all.contacts.size(), 3U);
    const auto name = [&](std::size_t index) { return scene.bodies()[index].name; };
    const Json answer = json("");
    EXPECT_EQ(answer["verdict"], "contact");
    EXPECT_EQ(answer["time"], first.contacts[0].contact.time.lower);
    EXPECT_EQ(answer["time_upper"], first.contacts[0].contact.time.upper);
    EXPECT_EQ(answer["pair"], Json({name(first.contacts[0].moving), name(first.contacts[0].fixed)}));
    EXPECT_EQ(answer["clear_until"], first.clear_until);
    EXPECT_EQ(answer["contacts"].size(), first.contacts[0].contact.contacts.size());
    const Json events = json("--all")["events"];
    ASSERT_EQ(events.size(), all.contacts.size());
    for (std::size_t i = 0; i < events.size(); ++i)
        EXPECT_EQ(events[i]["time"], all.contacts[i].contact.time.lower);
}

TEST_F(SceneCommand, AListThatIsCutSaysSo) {
    EXPECT_FALSE(json("--all --all-contacts")["events"][0].contains("contacts_cut"));
    write("scene.json", R"({"bodies": [{"name": "a", "mesh": "cube.obj"},
        {"name": "b", "mesh": "cube.obj", "pose": [0.5, 0.25, 0.25], "goal": [9, 0, 0]}]})");
    EXPECT_EQ(json("--all-contacts")["contacts_cut"], true);
    EXPECT_EQ(json("--all --all-contacts")["events"][0]["contacts_cut"], true);
}

TEST_F(SceneCommand, TellsItForPeople) {
    const tests::Finished first = run("scene scene.json");
    EXPECT_EQ(first.status, 1);
    EXPECT_NE(first.out.find("CONTACT at time 0.49365"), std::string::npos) << first.out;
    EXPECT_NE(first.out.find("falling on thrown"), std::string::npos) << first.out;
    EXPECT_NE(run("scene scene.json --all").out.find("falling on floor"), std::string::npos);
    const tests::Finished early = run("scene scene.json --until 0.4 --threads 1");
    EXPECT_EQ(early.status, 0);
    EXPECT_NE(early.out.find("CLEAR"), std::string::npos);
    EXPECT_EQ(json("--until 0.4")["clear_until"], 0.4);
    EXPECT_EQ(run("scene scene.json --any").status, 1);
}

TEST_F(SceneCommand, NamesTheLimitOfTheTime) {
    const auto out = [&](const std::string& options) { return run("scene scene.json " + options).out; };
    EXPECT_TRUE(out("--until 0.4").starts_with("CLEAR: proven that nothing touches until time 0.4; motion: "));
    EXPECT_TRUE(out("--until 0").starts_with("CLEAR: proven that nothing touches at the start; motion: "));
    EXPECT_TRUE(out("--until 0.4 --all").starts_with("0 pairs touch until time 0.4; motion: "));
    EXPECT_TRUE(out("--until 0 --all").starts_with("0 pairs touch at the start; motion: "));
    EXPECT_EQ(out("--all").find("until"), std::string::npos);
}

TEST_F(SceneCommand, KeepsToTheFilters) {
    write("scene.json", "{\"bodies\": " + bodies + R"(, "margin": 0.01,
        "ignore": [["falling", "thrown"]], "ignore_groups": [["static", ""]]})");
    for (const Json& event : json("--all")["events"])
        EXPECT_EQ(event["pair"][1], "walking");
    EXPECT_LT(json("")["time"], 0.7163) << "the margin of the file";
    EXPECT_GT(json("--margin 0")["time"], 0.7163);
}

TEST_F(SceneCommand, WhatRestsOnATableMaySlide) {
    write("scene.json", R"({"margin": 0.1, "hold": 0.02, "bodies": [{"name": "table", "mesh": "cube.obj"},
        {"name": "box", "mesh": "cube.obj", "pose": [0, 0, 1.05], "goal": [0.5, 0, 1.05, 1, 0, 0, 0.1]}]})");
    const tests::Finished found = run("scene scene.json");
    EXPECT_EQ(found.status, 0);
    EXPECT_EQ(
        found.out.substr(0, found.out.find('\n')),
        "CLEAR: proven that no pair that is held comes within 0.02, or nearer than at the start if that is less, and "
        "no other pair within 0.1; motion: velocity");
    EXPECT_NE(run("scene scene.json --until 0.5").out.find("no other pair within 0.1, until time 0.5; motion: "),
              std::string::npos);
    EXPECT_EQ(json("--hold 0.049")["verdict"], "clear");
    EXPECT_EQ(json("--margin 0.04 --hold 0.02")["verdict"], "clear");
    EXPECT_EQ(error_line("scene scene.json --margin 1 --hold 2"),
              "chasles: query: hold: 2 is not less than the margin 1");
    EXPECT_EQ(error_line("scene scene.json --hold 0.1"), "chasles: query: hold: 0.1 is not less than the margin 0.1");
}

TEST_F(SceneCommand, WhatTouchesATableExactlyIsAContactAtTheStart) {
    const std::string rest = R"("margin": 0.1, "hold": 0.02, "bodies": [{"name": "table", "mesh": "cube.obj"},
        {"name": "box", "mesh": "cube.obj", "pose": [0, 0, 1], "goal": [0.5, 0, 1]}]})";
    write("scene.json", "{" + rest);
    EXPECT_EQ(json("")["verdict"], "contact_at_start");
    EXPECT_NE(run("scene scene.json")
                  .out.find("  hold      needs a gap above 0 at the start; move the bodies apart by a "
                            "little more than 0.02, or allow an overlap by a radius below 0\n"),
              std::string::npos);
    write("scene.json", R"({"ignore_touching_at_start": true, )" + rest);
    EXPECT_EQ(json("")["verdict"], "clear") << "the other way out leaves out the pair";
}

TEST_F(SceneCommand, SaysWhatItDoesNotTest) {
    write("tiles.json",
          R"({"bodies": [{"name": "t0", "mesh": "cube.obj"}, {"name": "t1", "mesh": "cube.obj", "pose": [1, 0, 0]},
        {"name": "high", "mesh": "cube.obj", "pose": [0, 0, 5], "goal": [9, 0, 5]},
        {"name": "low", "mesh": "cube.obj", "pose": [0, 0, 1], "goal": [9, 0, 1]}], "ignore": [["low", "t0"], ["t1", "low"]]})");
    const tests::Finished found = run("scene tiles.json");
    EXPECT_EQ(found.status, 0);
    EXPECT_TRUE(
        found.out.starts_with("CLEAR: proven that no tested pair touches during the whole motion; motion: velocity\n"
                              "  untested  3 pairs: 1 at rest (t0 and t1), 2 ignored (low and t0, low and t1)\n"))
        << found.out;
    const Json untested = Json::parse(run("scene tiles.json --json").out)["untested"];
    EXPECT_EQ(untested["tested"], 3);
    EXPECT_EQ(untested["pairs"], 3);
    EXPECT_EQ(untested["reasons"][0], Json::parse(R"({"reason": "at_rest", "count": 1, "pairs": [["t0", "t1"]]})"));
    EXPECT_EQ(untested["reasons"][1]["reason"], "ignored");
    EXPECT_EQ(Json::parse(run("scene tiles.json --json --all").out)["untested"], untested);
    EXPECT_NE(run("scene tiles.json --all").out.find("untested"), std::string::npos);
    const tests::Finished start = run("scene tiles.json --until 0");
    EXPECT_EQ(start.status, 1) << "a question about the start";
    EXPECT_NE(start.out.find("t0 on t1"), std::string::npos) << start.out;
    write("rest.json", R"({"bodies": [{"name": "a", "mesh": "cube.obj"}, {"name": "b", "mesh": "cube.obj"}]})");
    EXPECT_TRUE(run("scene rest.json").out.starts_with("CLEAR: no pair is tested; motion: rest\n"));
    EXPECT_NE(run("scene rest.json").out.find("--until 0 tests bodies at rest"), std::string::npos);
    for (const std::string question : {"--matrix", "--clearance", "--profile"})
        EXPECT_NE(run("scene rest.json " + question)
                      .out.find("--all --until 0, without " + question + ", tests bodies at rest"),
                  std::string::npos);
    EXPECT_EQ(run("scene scene.json").out.find("untested"), std::string::npos) << "all pairs are tested";
}

TEST_F(SceneCommand, IgnoresWhatTouchesAtTheStart) {
    const std::string parts = R"({"bodies": [{"name": "plate", "mesh": "cube.obj"},
        {"name": "screw", "mesh": "cube.obj", "pose": [0.9, 0, 0], "goal": [0.9, 0, 3]},
        {"name": "lid", "mesh": "cube.obj", "pose": [0.5, 0, 1.01]}], "ignore_touching_at_start": )";
    write("parts.json", parts + "true}");
    const tests::Finished found = run("scene parts.json");
    EXPECT_NE(found.out.find("1 touching at the start (plate and screw)"), std::string::npos) << found.out;
    EXPECT_NE(found.out.find("screw on lid"), std::string::npos) << found.out;
    const tests::Finished wide = run("scene parts.json --margin 0.02");
    EXPECT_EQ(wide.status, 0) << wide.out;
    EXPECT_NE(wide.out.find("3 touching at the start"), std::string::npos) << wide.out;
    write("parts.json", parts + "false}");
    EXPECT_EQ(Json::parse(run("scene parts.json --json").out)["verdict"], "contact_at_start");
    EXPECT_EQ(refused(parts + "1}"), "ignore_touching_at_start: must be true or false");
}

TEST_F(SceneCommand, TakesARobotWithoutMovingJointsAsABody) {
    write("fixture.urdf",
          R"(<robot name="fixture"><link name="plate"><collision><geometry><box size="4 4 1"/></geometry>
        </collision></link><link name="post"><collision><geometry><box size="1 1 2"/></geometry></collision></link>
        <joint name="glue" type="fixed"><parent link="plate"/><child link="post"/><origin xyz="0 0 1.5"/></joint></robot>)");
    write("scene.json", R"({"bodies": [{"name": "fixture", "urdf": "fixture.urdf", "pose": [0, 0, 1]},
        {"name": "box", "mesh": "cube.obj", "pose": [0, 0, 6.5], "goal": [0, 0, 2.5]}]})");
    EXPECT_NEAR(json("")["time"].get<double>(), (6.5 - 3.5) / 4, 1e-12) << "the post ends at 3.5";
    EXPECT_EQ(json("")["pair"], Json({"box", "fixture"}));
    write("door.urdf", R"(<robot name="door"><link name="a"/><link name="b"/>
        <joint name="hinge" type="continuous"><parent link="a"/><child link="b"/></joint></robot>)");
    EXPECT_EQ(
        refused(R"({"bodies": [{"name": "d", "urdf": "door.urdf"}]})"),
        "body 1: 'd': urdf: the joints of 'door.urdf' move (hinge), and a body of a scene is rigid; `chasles robot` "
        "moves joints");
    EXPECT_EQ(refused(R"({"bodies": [{"name": "d", "urdf": "fixture.urdf", "scale": 2}]})"),
              "body 1: 'd': scale: goes with a mesh, and the body has a urdf");
}

/// What a build without the viewer says is the same for all pages.
TEST_F(SceneCommand, WritesAPageToo) {
    const tests::Finished plain = run("scene scene.json --all");
    const tests::Finished paged = run("scene scene.json --all --page page.html --title 'Boxes & <floor>'");
    if (paged.err.find("this build has no viewer") != std::string::npos)
        GTEST_SKIP() << paged.err;
    EXPECT_EQ(paged.status, plain.status);
    EXPECT_EQ(paged.out, plain.out + "  page      page.html\n");
    const std::string page = content("page.html");
    EXPECT_NE(page.find(R"("title":"Boxes & \u003cfloor>")"), std::string::npos);
    EXPECT_NE(page.find(R"("source":"all_contacts")"), std::string::npos);
    EXPECT_EQ(page.find(R"("until":)"), std::string::npos);
    (void)run("scene scene.json --all --until 0.5 --page limited.html");
    EXPECT_NE(content("limited.html").find(R"("until":0.5)"), std::string::npos);
    EXPECT_EQ(Json::parse(run("scene scene.json --json --page first.html").out), json(""));
    const tests::Finished full = run("scene scene.json --all --page /dev/full");
    EXPECT_EQ(full.status, 2);
    EXPECT_EQ(full.out, plain.out) << "the answer comes before the page";
    EXPECT_NE(content("first.html").find(R"("source":"first_contact")"), std::string::npos);
    EXPECT_NE(content("first.html").find(R"("title":"scene.json")"), std::string::npos);
    EXPECT_TRUE(error_line("scene scene.json --page no/page.html").starts_with("chasles: no/page.html"));
    EXPECT_EQ(run("scene scene.json --title only").status, 2);
}

TEST_F(SceneCommand, RefusesWrongFilesInOneLine) {
    const auto body = [](const std::string& more) {
        return R"({"bodies": [{"name": "a", "mesh": "cube.obj")" + more + "}]}";
    };
    EXPECT_EQ(refused(body(R"(, "colour": 1)")),
              "body 1: unknown key 'colour'; the keys are name, mesh, part, urdf, "
              "scale, pose, goal, motion, centre, poses, group, solid, radius, sphere, capsule, points");
    EXPECT_EQ(refused(body(R"(, "pose": [1, 2])")).substr(0, 29), "body 1: 'a': pose: 2 numbers ");
    EXPECT_EQ(refused(body(R"(, "scale": -1)")),
              "body 1: 'a': scale: must be one positive number; mirror the mesh or scale its axes in the mesh file");
    EXPECT_EQ(refused(body(R"(, "goal": [1, 2, 3], "motion": "screw")")),
              "body 1: 'a': motion: screw is the motion of one body as seen from another one; a scene takes velocity "
              "and twist");
    EXPECT_EQ(refused(body(R"(, "poses": [{"t": 0, "pose": [1, 2, 3]}, {"t": 2, "pose": [1, 2, 3]}])")),
              "body 1: 'a': poses: t must run from 0 to 1, which is the time of the whole scene");
    EXPECT_EQ(refused(body(R"(, "poses": [{"t": 0}])")), "body 1: 'a': poses: entry 1: pose: is missing");
    EXPECT_EQ(refused(body(R"(}, {"name": "a", "mesh": "cube.obj")")), "body 2: scene: a: is in the scene already");
    EXPECT_EQ(refused(R"({"bodies": [{"name": "a", "mesh": "no.obj"}]})"), "body 1: 'a': no.obj: no such file");
    EXPECT_EQ(refused(R"({"bodies": [], "ignore": [["a", "b"]]})"), "ignore: scene: b: is not in the scene");
    EXPECT_EQ(
        refused(R"({"bodies": [{"name": "a", "mesh": "cube.obj", "group": "g"}], "ignore_groups": [["g", "typo"]]})"),
        "ignore_groups: no body has the group 'typo'");
    const std::string zero = R"({"name": "b\u0000c", "mesh": "cube.obj"})";
    EXPECT_EQ(refused(R"({"bodies": [)" + zero + ", " + zero + "]}"), "body 2: scene: b?c: is in the scene already");
    EXPECT_TRUE(
        refused(body(R"(}, {"name": "b", "mesh": "cube.obj", "pose": [0, 0, 1e30], "goal": [1, 2, 3, 1, 0, 1, 0])"))
            .starts_with("scene: b and a: motion: goes up to 2e+30 far, more than "))
        << "what the question refuses is of the file, too";
    EXPECT_EQ(refused(R"({"bodies": 3})"), "bodies: must be a list");
    EXPECT_EQ(refused("[]"), "must be an object");
    EXPECT_EQ(refused("{"), "is not JSON: parse error at line 1, column 2: syntax error while parsing object key - "
                            "unexpected end of input; expected string literal");
    EXPECT_EQ(refused(R"({"bodies": [], "hold": "1"})"), "hold: must be a number");
    EXPECT_EQ(refused(R"({"bodies": [], "margin": -1})"), "margin: must be in [0, 1e30]");
}

/// A null goal would make a body that moves one that stands still.
TEST_F(SceneCommand, NullIsNoValueOfAnyKey) {
    const std::string why = ": is null, which is no value; leave the key out";
    for (const char* key : {"part", "urdf", "scale", "pose", "goal", "motion", "centre", "poses", "group", "solid",
                            "radius", "sphere", "capsule", "points"})
        EXPECT_EQ(refused(R"({"bodies": [{"name": "a", "mesh": "cube.obj", ")" + std::string(key) + R"(": null}]})"),
                  "body 1: " + std::string(key) + why);
    for (const char* key : {"name", "mesh"})
        EXPECT_EQ(refused(R"({"bodies": [{")" + std::string(key) + R"(": null}]})"),
                  "body 1: " + std::string(key) + why);
    for (const char* key : {"bodies", "ignore", "ignore_groups", "ignore_touching_at_start", "margin", "hold"})
        EXPECT_EQ(refused(R"({")" + std::string(key) + R"(": null})"), key + why);
    EXPECT_EQ(refused(R"({"bodies": [{"name": "a", "mesh": "cube.obj", "poses": [{"t": 0, "pose": null}]}]})"),
              "body 1: 'a': poses: entry 1: pose" + why);
}

TEST_F(SceneCommand, NamesDoNotSteerTheTerminal) {
    write("names.json", R"({"bodies": [{"name": "a\u001b[31m\nb", "mesh": "cube.obj"},
                                       {"name": "c\u009b2J\u007f", "mesh": "cube.obj", "pose": [3, 0, 0], "goal": [0.5, 0, 0]}]})");
    const std::string text = run("scene names.json").out;
    EXPECT_NE(text.find("  pair      c?2J? on a?[31m b\n"), std::string::npos) << text;
    const std::string line = run("scene names.json --json").out;
    EXPECT_EQ(Json::parse(line)["pair"], Json({"c\u009b2J\u007f", "a\u001b[31m\nb"})) << "the names as they are";
    EXPECT_TRUE(std::ranges::none_of(line, [](char c) { return c == '\x7f' || c == '\x9b' || c == '\x1b'; }));
    EXPECT_NE(line.find(R"(a\u001b[31m\nb)"), std::string::npos) << line;
}

/// The warnings of a robot that is a body are not lost.
TEST_F(SceneCommand, NamesThePackageThatARobotLacks) {
    write("table.urdf", R"(<robot name="table"><link name="top"><collision><geometry>
  <mesh filename="package://table/cubes/cube.obj"/></geometry></collision></link></robot>)");
    std::filesystem::create_directories(path("cubes"));
    std::filesystem::copy_file(path("cube.obj"), path("cubes/cube.obj"));
    write("table.json", R"({"bodies": [{"name": "table", "urdf": "table.urdf"}]})");
    EXPECT_NE(run("scene table.json").err.find("there is no package 'table'"), std::string::npos);
    EXPECT_NE(run("scene table.json --json").out.find("there is no package 'table'"), std::string::npos);
}

} // namespace
} // namespace chasles
