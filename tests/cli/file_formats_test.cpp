// A file means the same through every command: nothing is turned, and numbers are in the unit of the file. A cube of
// side 0.125 goes from x = -1 to x = 1 at half the height of a post. Their faces touch at x = -0.1875, which is 0.40625
// of the way.
#include "tests/cli/cli_test_files.h"
#include "tests/io/post_files.h"

#include "chasles/chasles.h"

#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

constexpr double time_of_touch = 0.40625;

class FileFormats : public tests::CommandLine {
protected:
    FileFormats() {
        std::string small = "# cube\n";
        for (int i = 0; i < 8; ++i)
            small += fmt::format("v {} {} {}\n", (i & 4) / 32.0, (i & 2) / 16.0, (i & 1) / 8.0);
        for (const auto& [a, b, c] : tests::post_triangles())
            small += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
        write("small.obj", small);
        for (const tests::PostFile& file : tests::post_files())
            write(file.name, file.content);
    }
    [[nodiscard]] Json json(const std::string& arguments) const {
        const auto finished = run(arguments + " --json");
        EXPECT_TRUE(finished.err.empty()) << finished.err;
        return Json::parse(finished.out);
    }
    static void expect_touch(const Json& answer, const std::string& name) {
        EXPECT_EQ(answer["verdict"], "contact") << name;
        EXPECT_NEAR(answer.value("time", 0.0), time_of_touch, 1e-9) << name;
    }
};

TEST_F(FileFormats, MeanTheSameInCheck) {
    for (const tests::PostFile& file : tests::post_files()) {
        expect_touch(json("check small.obj " + file.name + " --start=-1,0,0.5 --goal 1,0,0.5"), file.name);
        EXPECT_EQ(json("check small.obj " + file.name + " --start=-1,0.5,0.5 --goal 1,0.5,0.5")["verdict"], "clear")
            << file.name << " is turned";
    }
}

TEST_F(FileFormats, UnitsThatDifferAreSaid) {
    write("inch.3mf", tests::post_3mf("inch"));
    const std::string ends = " --start=-1,0,0.5 --goal 1,0,0.5";
    const std::string why = "inch.3mf is in the unit 'inch', and post.glb in the unit 'meter'; numbers are not "
                            "converted: export both in one unit";
    write("poses.csv", "x,y,z,qw,qx,qy,qz\n-1,0,0.5,1,0,0,0\n1,0,0.5,1,0,0,0\n");
    write("motions.csv", "x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1\n9,0,0,1,0,0,0,9,0,0,1,0,0,0\n");
    for (const std::string& command : {"check inch.3mf post.glb" + ends, "clearance inch.3mf post.glb" + ends,
                                       std::string("path inch.3mf post.glb --poses poses.csv")}) {
        EXPECT_EQ(run(command).err, "chasles: warning: " + why + "\n") << command;
        EXPECT_EQ(Json::parse(run(command + " --json").out)["warnings"], Json({why})) << command;
    }
    EXPECT_EQ(run("batch inch.3mf post.glb --motions motions.csv --out out.csv").err,
              "chasles: warning: " + why + "\n");
    EXPECT_TRUE(run("check post.3mf post.glb" + ends).err.empty()) << "both in metres";
    EXPECT_TRUE(run("check inch.3mf small.obj" + ends).err.empty()) << "an OBJ states no unit";
}

TEST_F(FileFormats, UnitsThatDifferAreSaidOfScenes) {
    write("inch.3mf", tests::post_3mf("inch"));
    const auto scene_with = [&](const std::string& scale) {
        write("scene.json",
              R"({"bodies": [{"name": "a", "mesh": "inch.3mf", "goal": [1, 0, 0]}, {"name": "b", "mesh": "post.glb")" +
                  scale + R"(, "pose": [90, 0, 0]}]})");
        return run("scene scene.json").err;
    };
    EXPECT_EQ(scene_with(""),
              "chasles: warning: inch.3mf is in the unit 'inch', and post.glb in the unit 'meter'; numbers are "
              "not converted: export both in one unit\n");
    EXPECT_EQ(scene_with(R"(, "scale": 39.37)"), "") << "the user knows the units";
}

TEST_F(FileFormats, MeanTheSameInScenes) {
    for (const tests::PostFile& file : tests::post_files()) {
        write("scene.json",
              R"({"bodies": [{"name": "post", "mesh": ")" + file.name +
                  R"("}, {"name": "cube", "mesh": "small.obj", "pose": [-1, 0, 0.5], "goal": [1, 0, 0.5]}]})");
        expect_touch(json("scene scene.json"), file.name);
    }
}

TEST_F(FileFormats, MeanTheSameInDrag) {
    write("goals.csv", "t,x,y,z,qw,qx,qy,qz\n0,-1,0,0.5,1,0,0,0\n1,1,0,0.5,1,0,0,0\n");
    for (const tests::PostFile& file : tests::post_files()) {
        write("scene.json", R"({"bodies": [{"name": "post", "mesh": ")" + file.name +
                                R"("}, {"name": "cube", "mesh": "small.obj", "pose": [-1, 0, 0.5]}]})");
        const Json answer = json("drag scene.json --body cube --goals goals.csv --out out.csv --margin 0.001");
        EXPECT_EQ(answer["in_contact"], 1) << file.name;
        EXPECT_EQ(answer["reached"], 1) << file.name;
    }
}

TEST_F(FileFormats, MeanTheSameInRobots) {
    write("path.csv", "x\n-1\n1\n");
    write("scene.json", R"({"bodies": [{"name": "cube", "mesh": "small.obj", "pose": [0, 0, 0.5]}]})");
    for (const tests::PostFile& file : tests::post_files()) {
        write("robot.urdf",
              R"(<robot name="r"><link name="base"/><link name="post"><collision><geometry><mesh filename=")" +
                  file.name + R"("/></geometry></collision></link>
            <joint name="x" type="prismatic"><parent link="base"/><child link="post"/><axis xyz="-1 0 0"/>
            <limit lower="-2" upper="2" effort="1" velocity="1"/></joint></robot>)");
        expect_touch(json("robot robot.urdf --path path.csv --scene scene.json"), file.name);
    }
}

TEST_F(FileFormats, MeanTheSameInInfoAndTheLibrary) {
    for (const tests::PostFile& file : tests::post_files()) {
        const Json info = json("info " + file.name);
        EXPECT_EQ(info["closed"], true) << file.name;
        EXPECT_EQ(info["bounding_box"]["lower"], Json({-0.0625, -0.0625, 0.0})) << file.name;
        EXPECT_EQ(info["bounding_box"]["upper"], Json({0.0625, 0.0625, 1.0})) << file.name;
        const Polyhedron body = Polyhedron::load(path(file.name));
        const std::vector<NamedPolyhedron> parts = load_parts(path(file.name));
        ASSERT_EQ(parts.size(), 1U) << file.name;
        EXPECT_EQ(parts[0].name, file.name.substr(1, 4) == "_up." ? "post" : path(file.name).stem().string());
        for (const Polyhedron& loaded : {body, parts[0].polyhedron}) {
            EXPECT_EQ(loaded.report().lower, Eigen::Vector3d(-0.0625, -0.0625, 0)) << file.name;
            EXPECT_EQ(loaded.report().upper, Eigen::Vector3d(0.0625, 0.0625, 1)) << file.name;
        }
    }
}

/// The post at the origin, and once more at x = 2.
std::string two_posts() {
    std::string gltf = tests::post_gltf_json("");
    gltf.replace(gltf.find(R"("nodes": [0])"), 12, R"("nodes": [0, 1])");
    const std::string node = R"([{"name": "post", "mesh": 0}])";
    gltf.replace(gltf.find(node), node.size(),
                 R"([{"name": "post", "mesh": 0}, {"name": "post", "mesh": 0, "translation": [2, 0, 0]}])");
    return tests::glb(gltf, tests::post_buffer());
}

/// A cube meets the second post, which stands at x = 2, and passes beside the first one.
TEST_F(FileFormats, ABodyOfASceneMayBeOnePart) {
    write("two.glb", two_posts());
    const auto scene = [&](const std::string& keys, double from) {
        write("scene.json", fmt::format(R"({{"bodies": [{{"name": "post", "mesh": "two.glb"{}}},
            {{"name": "cube", "mesh": "small.obj", "pose": [{}, 0, 0.5], "goal": [{}, 0, 0.5]}}]}})",
                                        keys, from, from + 2));
        return run("scene scene.json --json");
    };
    expect_touch(Json::parse(scene(R"(, "part": "post")", -1).out), "the first");
    expect_touch(Json::parse(scene(R"(, "part": "post_2")", 1).out), "the second lies where the file places it");
    EXPECT_EQ(Json::parse(scene(R"(, "part": "post_2")", -1).out)["verdict"], "clear");
    expect_touch(Json::parse(scene(R"(, "part": "post_2", "pose": [-2, 0, 0])", -1).out),
                 "the pose moves it from there");
    EXPECT_EQ(
        scene(R"(, "part": "wheel")", 0).err,
        "chasles: scene.json: body 1: 'post': part: the file has no part 'wheel'; its parts are 'post', 'post_2'\n");
    EXPECT_EQ(scene(R"(, "scale": -1)", 0).err,
              "chasles: scene.json: body 1: 'post': scale: must be one positive number; "
              "mirror the mesh or scale its axes in the mesh file\n");
    EXPECT_EQ(scene(R"(, "scale": [1, 1, 2])", 0).err, scene(R"(, "scale": 0)", 0).err);
    EXPECT_EQ(
        scene(R"(, "colour": 1)", 0).err,
        "chasles: scene.json: body 1: unknown key 'colour'; the keys are name, mesh, part, urdf, scale, pose, goal, "
        "motion, centre, poses, group, solid, radius, sphere, capsule, points\n");
}

TEST_F(FileFormats, InfoTellsTheUnit) {
    for (const tests::PostFile& file : tests::post_files()) {
        const Json found = json("info " + file.name);
        const std::string text = run("info " + file.name).out;
        if (file.name.ends_with(".dae") || file.name.ends_with(".glb") || file.name.ends_with(".gltf")) {
            EXPECT_EQ(found["unit"], "meter") << file.name;
        }
        EXPECT_EQ(found.contains("unit"), text.find("  unit      ") != std::string::npos) << file.name;
        const bool states_none = std::ranges::any_of(std::array{".obj", ".off", ".ply", ".stl", ".bt", ".ot"},
                                                     [&](const char* end) { return file.name.ends_with(end); });
        EXPECT_EQ(found.contains("unit"), !states_none) << file.name;
    }
}

TEST_F(FileFormats, InfoListsTheParts) {
    write("two.glb", two_posts());
    EXPECT_EQ(json("info two.glb")["parts"],
              Json::parse(R"([{"name": "post", "faces": 12}, {"name": "post_2", "faces": 12}])"));
    const std::string text = run("info two.glb").out;
    EXPECT_NE(text.find("  parts     2, merged into one body: post (12 faces), post_2 (12)"), std::string::npos)
        << text;
    EXPECT_FALSE(this->json("info post.glb").contains("parts")) << "one part is the body";
}

} // namespace
} // namespace chasles
