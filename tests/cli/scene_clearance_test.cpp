// chasles scene --clearance: the nearest pair of cubes in closed form, without bodies that both stand still.
#include "tests/cli/cli_test_files.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

class SceneClearance : public tests::CommandLine {
protected:
    SceneClearance() {
        write("scene.json", R"({"bodies": [
            {"name": "post", "mesh": "cube.obj", "pose": [0, 0, 0]},
            {"name": "wall", "mesh": "cube.obj", "pose": [1.001, 0, 0]},
            {"name": "cart", "mesh": "cube.obj", "pose": [-4, 1.3, 1.4], "goal": [4, 1.3, 1.4]}]})");
    }
};

TEST_F(SceneClearance, IsThatOfTheNearestPairThatMoves) {
    const auto finished = run("scene scene.json --clearance --json");
    EXPECT_EQ(finished.status, 0) << finished.err;
    const Json answer = Json::parse(finished.out);
    EXPECT_LE(answer["distance"], std::hypot(0.3, 0.4));
    EXPECT_NEAR(answer["distance_upper"], std::hypot(0.3, 0.4), 1e-6);
    EXPECT_EQ(answer["pair"][0], "cart");
    EXPECT_EQ(answer["certain"], true);
    EXPECT_EQ(answer["untested"]["tested"], 2);
    EXPECT_FALSE(answer["contacts"].empty());
    const std::string text = run("scene scene.json --clearance --tolerance 0.1").out;
    EXPECT_TRUE(text.starts_with("CLEARANCE 0.")) << text;
    EXPECT_NE(text.find("  pair      cart on "), std::string::npos) << text;
}

TEST_F(SceneClearance, OfBodiesThatTouchIsZero) {
    write("touch.json", R"({"bodies": [{"name": "a", "mesh": "cube.obj", "pose": [0, 0, 0]},
        {"name": "b", "mesh": "cube.obj", "pose": [3, 0.2, 0.3], "goal": [0, 0.2, 0.3]}]})");
    const auto finished = run("scene touch.json --clearance --json");
    EXPECT_EQ(finished.status, 1) << finished.err;
    EXPECT_EQ(Json::parse(finished.out)["distance_upper"], 0);
}

TEST_F(SceneClearance, OfNoPairHasNoLimit) {
    write("rest.json",
          R"({"bodies": [{"name": "a", "mesh": "cube.obj"}, {"name": "b", "mesh": "cube.obj", "pose": [3, 0, 0]}]})");
    const auto finished = run("scene rest.json --clearance");
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_TRUE(finished.out.starts_with("CLEARANCE WITHOUT A LIMIT: no two bodies are tested")) << finished.out;
    const Json none = Json::parse(run("scene rest.json --clearance --json").out),
               found = Json::parse(run("scene scene.json --clearance --json").out);
    for (const auto& [key, value] : found.items())
        EXPECT_TRUE(none.contains(key)) << key;
    for (const char* const key : {"distance", "distance_upper", "pair", "time", "time_upper", "pose"})
        EXPECT_TRUE(none[key].is_null()) << key;
    EXPECT_EQ(none["contacts"], Json::array());
    EXPECT_EQ(none["certain"], true);
}

TEST_F(SceneClearance, TakesNoMarginNoPageAndNoTime) {
    for (const std::string option : {"--margin 1", "--hold 1", "--until 0.5", "--page p.html", "--all", "--any"})
        EXPECT_EQ(run("scene scene.json --clearance " + option).status, 2) << option;
    EXPECT_EQ(run("scene scene.json --tolerance 0.1").status, 2) << "the tolerance is that of the clearance";
}

} // namespace
} // namespace chasles
