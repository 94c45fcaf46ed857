// chasles scene --matrix: cubes in closed form as text, JSON, table and picture; limits and refusals.
#include "tests/cli/cli_test_files.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace chasles {
namespace {

using Json = nlohmann::json;

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

/// A cart passes a post and drives through a wall; a lid rises from within it.
class SceneMatrix : public tests::CommandLine {
protected:
    SceneMatrix() {
        write("crash.json", bodies(R"(, {"name": "wall, old", "mesh": "cube.obj", "pose": [3, 0.2, 0.1]},
            {"name": "lid", "mesh": "cube.obj", "pose": [-3.5, 0.3, 0.2], "goal": [-3.5, 9, 0.2]}], "ignore": [["wall, old", "lid"])"));
        write("clear.json", bodies(""));
    }
    static std::string bodies(const std::string& more) {
        return R"({"bodies": [{"name": "<post>", "mesh": "cube.obj", "pose": [0, 1.5, 0]},
            {"name": "cart", "mesh": "cube.obj", "pose": [-4, 0, 0], "goal": [4, 0, 0]},
            {"name": "far", "mesh": "cube.obj", "pose": [0, 21, 0], "goal": [0, 41, 0]})" +
               more + "]}";
    }
    [[nodiscard]] std::string content(const char* name) const {
        std::ostringstream text;
        text << std::ifstream(path(name)).rdbuf();
        return text.str();
    }
};

TEST_F(SceneMatrix, ListsContactsFirstAndThenTheNearestPairs) {
    const auto finished = run("scene crash.json --matrix");
    EXPECT_EQ(finished.status, 1) << finished.err;
    std::istringstream lines(finished.out);
    std::vector<std::string> all;
    for (std::string line; std::getline(lines, line);)
        all.push_back(line);
    ASSERT_EQ(all.size(), 11U) << finished.out;
    EXPECT_EQ(all[0], "TOUCH: 2 of 8 pairs; motion: velocity");
    EXPECT_EQ(all[1], "  untested  2 pairs: 1 at rest (<post> and wall, old), 1 ignored (lid and wall, old)");
    EXPECT_EQ(all[2], "  contact   cart on lid        at the start, overlapping");
    EXPECT_TRUE(all[3].starts_with("            cart on wall, old  at time 0.7")) << all[3];
    EXPECT_TRUE(all[4].starts_with("  distance  cart on <post>     0.4999")) << all[4];
    EXPECT_TRUE(all[5].starts_with("            lid on <post>")) << all[5];
    EXPECT_TRUE(all[10].starts_with("  work      ")) << all[10];
}

TEST_F(SceneMatrix, OfBodiesThatStayApartNamesTheLeastDistance) {
    const auto finished = run("scene clear.json --matrix --tolerance 1e-9");
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_TRUE(finished.out.starts_with("CLEARANCE 0.5: the least one of 3 pairs; motion: velocity\n"))
        << finished.out;
    EXPECT_EQ(finished.out.find("untested"), std::string::npos);
    const Json answer = Json::parse(run("scene clear.json --matrix --json --threads 1").out);
    ASSERT_EQ(answer["pairs"].size(), 3U);
    const std::vector<double> distances{0.5, 18.5, std::sqrt(409)};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(answer["pairs"][i]["distance"], distances[i]);
        EXPECT_NEAR(answer["pairs"][i]["distance_upper"], distances[i], 1e-5 * distances[i]);
        EXPECT_EQ(answer["pairs"][i]["certain"], true);
    }
    std::size_t node_pairs = 0;
    for (const Json& pair : answer["pairs"])
        node_pairs += pair["work"]["node_pairs"].get<std::size_t>();
    EXPECT_EQ(answer["work"]["node_pairs"], node_pairs);
    EXPECT_EQ(answer["pairs"][0]["pair"], Json::parse(R"(["cart", "<post>"])"));
    EXPECT_EQ(answer["pairs"][2]["pair"], Json::parse(R"(["cart", "far"])"));
    EXPECT_EQ(answer["untested"]["tested"], 3);
    EXPECT_FALSE(answer.contains("verdict"));
}

TEST_F(SceneMatrix, WritesATableAndAPicture) {
    EXPECT_EQ(run("scene crash.json --matrix --csv m.csv --plot m.svg").status, 1);
    std::istringstream table(content("m.csv"));
    std::vector<std::string> rows;
    for (std::string row; std::getline(table, row);)
        rows.push_back(row);
    ASSERT_EQ(rows.size(), 9U);
    EXPECT_EQ(rows[0], "first,second,distance,distance_upper,time,time_upper,certain");
    EXPECT_TRUE(rows[1].starts_with("cart,<post>,0.49") && rows[1].ends_with(",true")) << rows[1];
    EXPECT_EQ(occurrences(content("m.csv"), "cart,\"wall, old\",0,0,0.7"), 1U);
    const std::string picture = content("m.svg");
    EXPECT_EQ(occurrences(picture, "#d4147f"), 2 * 2U + 1) << "each contact twice, and the legend";
    EXPECT_EQ(occurrences(picture, "&lt;post>"), 2U);
    EXPECT_EQ(occurrences(picture, ">t 0.75<"), 2U);
    EXPECT_EQ(occurrences(picture, ">0.5<"), 3U) << "twice, and the legend";
}

/// XML takes no control characters.
TEST_F(SceneMatrix, APictureShowsControlCharactersOfNamesAsQuestionMarks) {
    write("odd.json", R"({"bodies": [{"name": "a\u0001b\u001bc", "mesh": "cube.obj", "pose": [0, 0, 0]},
        {"name": "\u0085", "mesh": "cube.obj", "pose": [9, 0, 0], "goal": [8, 0, 0]}]})");
    EXPECT_EQ(run("scene odd.json --matrix --plot m.svg").status, 0);
    const std::string picture = content("m.svg");
    EXPECT_EQ(occurrences(picture, ">a?b?c<"), 2U);
    for (const char c : picture)
        EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n') << int(c);
}

TEST_F(SceneMatrix, AtALimitHasWhatTheBoxesProve) {
    const auto finished = run("scene clear.json --matrix --seconds 1e-9");
    EXPECT_EQ(finished.status, 0) << "boxes that are apart prove it";
    EXPECT_NE(finished.out.find("0.5 to "), std::string::npos) << finished.out;
    const auto open = run("scene crash.json --matrix --seconds 1e-9");
    EXPECT_EQ(open.status, 3) << open.out;
    EXPECT_TRUE(open.out.starts_with("NO CLEARANCE PROVEN: 2 of 8 pairs; the time was over")) << open.out;
    EXPECT_EQ(Json::parse(run("scene crash.json --matrix --seconds 1e-9 --json").out)["verdict"], "unknown");
}

TEST_F(SceneMatrix, TakesNoMarginAndNoTime) {
    for (const std::string option : {"--margin 1", "--hold 1", "--until 0.5", "--all", "--any", "--clearance",
                                     "--profile", "--plot m.png", "--csv crash.json", "--tolerance 2"})
        EXPECT_EQ(run("scene crash.json --matrix " + option).status, 2) << option;
    EXPECT_EQ(run("scene crash.json --csv m.csv").status, 2) << "of what?";
    EXPECT_EQ(run("scene crash.json --plot m.svg").status, 2) << "of what?";
    write("rest.json", R"({"bodies": [{"name": "a", "mesh": "cube.obj"}]})");
    const auto alone = run("scene rest.json --matrix");
    EXPECT_EQ(alone.status, 0) << alone.err;
    EXPECT_TRUE(alone.out.starts_with("CLEARANCE WITHOUT A LIMIT: no two bodies are tested")) << alone.out;
}

} // namespace
} // namespace chasles
