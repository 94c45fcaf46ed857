// chasles drag: the rows are those of the library, and wrong input gets one line.
#include "tests/cli/cli_test_files.h"

#include "chasles/chasles.h"
#include "tests/view/packed.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

namespace chasles {
namespace {

using Json = nlohmann::json;

class DragCommand : public tests::CommandLine {
protected:
    DragCommand() {
        write("scene.json", R"({"bodies": [{"name": "table", "mesh": "cube.obj", "scale": 4, "pose": [-2, -2, -4]},
                                           {"name": "box", "mesh": "cube.obj", "pose": [0, 0, 1]}]})");
        write("goals.csv", "t,x,y,z,qw,qx,qy,qz\n0,0,0,-0.5,1,0,0,0\n0.1,0.3,0.2,-0.5,1,0,0,0\n0.2,0,0,2,1,0,0,0\n");
    }
    [[nodiscard]] std::vector<std::vector<double>> rows(const std::string& file) const {
        std::ifstream stream(path(file));
        std::string line;
        std::getline(stream, line);
        EXPECT_EQ(line, "t,x,y,z,qw,qx,qy,qz,contacts,fx,fy,fz,tx,ty,tz,distance");
        std::vector<std::vector<double>> rows;
        while (std::getline(stream, line)) {
            rows.emplace_back();
            std::istringstream cells(line);
            for (std::string cell; std::getline(cells, cell, ',');)
                rows.back().push_back(std::stod(cell));
        }
        return rows;
    }
};

TEST_F(DragCommand, WritesPosesAndForces) {
    const auto result = run("drag scene.json --body box --goals goals.csv --out out.csv --margin 0.001 --stiffness 2 "
                            "--json");
    EXPECT_EQ(result.status, 1);
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["updates"], 3);
    EXPECT_EQ(json["resting"], 2);
    EXPECT_EQ(json["reached"], 1);
    EXPECT_EQ(json["in_contact"], 2);
    EXPECT_EQ(json["margin"], 0.001);
    const auto rows = this->rows("out.csv");
    ASSERT_EQ(rows.size(), 3U);
    const std::vector<double> slid{0.1, 0.3, 0.2, 0.001, 1, 0, 0, 0, 4, 0, 0, 2 * 0.501};
    for (std::size_t i = 0; i < slid.size(); ++i)
        EXPECT_NEAR(rows[1][i], slid[i], 1e-9) << i;
    EXPECT_EQ(rows[1].size(), 16U);
    EXPECT_NEAR(rows[1][15], 0.501, 1e-9);
    EXPECT_EQ(rows[2][3], 2);
    EXPECT_EQ(rows[2][15], 0);
}

/// It is in contact as long as it is held, and somebody has to say why it does not move.
TEST_F(DragCommand, ABodyThatStartsInsideOrAcrossIsInContact) {
    for (const std::string start :
         {R"("sphere": 0.1, "pose": [0, 0, -2])", R"("mesh": "cube.obj", "pose": [1.5, 1, -0.5])",
          R"("mesh": "cube.obj", "pose": [0, 0, 0])"}) {
        write("scene.json", R"({"bodies": [{"name": "table", "mesh": "cube.obj", "scale": 4, "pose": [-2, -2, -4]},
                                           {"name": "box", )" +
                                start + "}]}");
        const std::string drag = "drag scene.json --body box --goals goals.csv --out ";
        const auto result = run(drag + "out.csv --json");
        EXPECT_EQ(result.status, 1) << start;
        const Json json = Json::parse(result.out);
        EXPECT_EQ(json["touching"], 3) << start;
        EXPECT_EQ(json["in_contact"], 3) << start;
        EXPECT_EQ(json["touched_by"], Json::array({"table"})) << start;
        const std::string why = "box touches or overlaps table, and does not move (3 updates)",
                          way_out = "start with a gap, or leave the pair out by \"ignore\"";
        const std::string text = run(drag + "out.csv").out;
        EXPECT_NE(text.find("  touching  " + why + "\n  way out   " + way_out + "\n"), std::string::npos) << text;
        const auto rows = run(drag + "/dev/stdout");
        EXPECT_EQ(rows.status, 1);
        EXPECT_NE(rows.err.find(why + "; " + way_out), std::string::npos) << rows.err;
    }
}

TEST_F(DragCommand, TakesTheMarginOfTheScene) {
    const std::string bodies = R"("bodies": [{"name": "table", "mesh": "cube.obj", "scale": 4, "pose": [-2, -2, -4]},
                                             {"name": "box", "mesh": "cube.obj", "pose": [0, 0, 1]}]})";
    const std::string drag = "drag scene.json --body box --goals goals.csv --out out.csv ";
    write("scene.json", R"({"margin": 0.001, )" + bodies);
    EXPECT_EQ(Json::parse(run(drag + "--json").out)["margin"], 0.001);
    EXPECT_EQ(Json::parse(run(drag + "--json --margin 0.002").out)["margin"], 0.002);
    write("scene.json", R"({"margin": 0.001, "hold": 0.0005, )" + bodies);
    EXPECT_EQ(error_line(drag), "chasles: scene.json: hold: a dragged body keeps the margin from all bodies; leave the "
                                "hold distance out");
}

/// The cube is pressed by 0.501, and so lags by a half of that.
TEST_F(DragCommand, FrictionHoldsBack) {
    write("goals.csv", "x,y,z,qw,qx,qy,qz\n0,0,-0.5,1,0,0,0\n0,0.2,-0.5,1,0,0,0\n0,0.75,-0.5,1,0,0,0\n");
    EXPECT_EQ(run("drag scene.json --body box --goals goals.csv --out out.csv --margin 0.001 --friction .5").status, 1);
    const auto rows = this->rows("out.csv");
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[1][2], 0);
    EXPECT_NEAR(rows[1][10], -0.2, 1e-6);
    EXPECT_NEAR(rows[2][2], 0.75 - 0.501 / 2, 1e-6);
    EXPECT_NEAR(rows[2][10], -0.501 / 2, 1e-6);
}

TEST_F(DragCommand, ALockLeavesALine) {
    write("goals.csv", "x,y,z,qw,qx,qy,qz\n1,3,2,1,0,0,0\n-5,1,-1,1,0,0,0.3\n");
    EXPECT_EQ(
        run("drag scene.json --body box --goals goals.csv --out out.csv --lock slider --lock-axis \"-1 0 0\"").status,
        0);
    const auto rows = this->rows("out.csv");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_NEAR(rows[0][1], 1, 1e-12);
    EXPECT_NEAR(rows[1][1], -5, 1);
    for (const auto& row : rows)
        EXPECT_NEAR(std::abs(row[2]) + std::abs(row[3] - 1), 0, 1e-12);
}

TEST_F(DragCommand, WritesAPageToo) {
    const auto result = run("drag scene.json --body box --goals goals.csv --out out.csv --page page.html");
    if (result.err.find("this build has no viewer") != std::string::npos)
        GTEST_SKIP() << result.err;
    EXPECT_EQ(result.status, 1);
    std::ifstream page(path("page.html"));
    const std::string text{std::istreambuf_iterator<char>(page), {}};
    EXPECT_NE(text.find("box in scene.json"), std::string::npos);
}

/// Goals a third of a turn apart about a hinge: the page shows the arcs, not the lines between the updates.
TEST_F(DragCommand, ThePageFollowsTheWayThatWasProven) {
    std::string goals = "x,y,z,qw,qx,qy,qz\n";
    for (int i = 0; i <= 6; ++i) {
        const double turn = 2 * i * std::numbers::pi / 3;
        goals += fmt::format("{},{},1,{},0,0,{}\n", 9 - 9 * std::cos(turn), -9 * std::sin(turn), std::cos(turn / 2),
                             std::sin(turn / 2));
    }
    write("around.csv", goals);
    const auto result = run("drag scene.json --body box --goals around.csv --out out.csv --page page.html "
                            "--lock hinge --lock-axis \"0 0 1\" --lock-point \"9 0 0\"");
    if (result.err.find("this build has no viewer") != std::string::npos)
        GTEST_SKIP() << result.err;
    std::ifstream page(path("page.html"));
    const std::string text{std::istreambuf_iterator<char>(page), {}};
    const std::string before = "<script id=\"scene\" type=\"application/json\">";
    const std::size_t begin = text.find(before) + before.size();
    const auto record = nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
    const auto body = std::ranges::find(record["bodies"], "box", [](const auto& each) { return each["name"]; });
    ASSERT_NE(body, record["bodies"].end());
    const auto times = tests::unpacked<double>((*body)["times"].template get<std::string>());
    const auto rows = tests::unpacked<double>((*body)["poses"].template get<std::string>());
    ASSERT_EQ(rows.size(), 7 * times.size());
    EXPECT_GE(times.size(), 3 * 7U);
    double turned = 0;
    for (std::size_t i = 0; i + 13 < rows.size(); i += 7) {
        EXPECT_LT(times[i / 7], times[i / 7 + 1]);
        const double x = (rows[i] + rows[i + 7]) / 2 - 9, y = (rows[i + 1] + rows[i + 8]) / 2;
        EXPECT_NEAR(std::hypot(x, y), 9, 0.02) << "between two poses";
        const double product = rows[i + 3] * rows[i + 10] + rows[i + 6] * rows[i + 13];
        turned += 2 * std::acos(std::min(1., product));
    }
    EXPECT_GE(turned, std::numbers::pi) << "the hand has moved it";
}

TEST_F(DragCommand, AHandThatMeetsNothingIsClear) {
    write("free.csv", "x,y,z,qw,qx,qy,qz\n0,0,2,1,0,0,0\n1,0,2,1,0,0,1\n");
    const auto result = run("drag scene.json --body box --goals free.csv --out out.csv");
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.out.find("2 reached, 0 resting"), std::string::npos) << result.out;
    EXPECT_EQ(rows("out.csv")[1][0], 1); // without stamps, the number of the row
}

TEST_F(DragCommand, RefusesWhatItCannotUse) {
    EXPECT_EQ(error_line("drag scene.json --body nut --goals goals.csv --out out.csv"),
              "chasles: scene: nut: is not in the scene");
    EXPECT_EQ(error_line("drag scene.json --body box --goals goals.csv --out out.csv --margin -1"),
              "chasles: drag: margin: must be in (0, 1e30], or 0 for the default");
    EXPECT_EQ(error_line("drag scene.json --body box --goals goals.csv --out out.csv --friction -1"),
              "chasles: drag: friction: must be in [0, 100]");
    EXPECT_EQ(error_line("drag scene.json --body box --goals goals.csv --out out.csv --lock hinge --lock-axis '0 0 0'"),
              "chasles: drag: lock: the direction must be finite and not zero");
    EXPECT_NE(error_line("drag scene.json --body box --goals goals.csv --out out.csv --lock door").find("--lock"),
              std::string::npos);
    const std::string drag = "drag scene.json --body box --goals goals.csv --out out.csv ";
    EXPECT_EQ(error_line(drag + "--lock-axis '0 0 1'"),
              "chasles: --lock-axis: belongs to a lock; add --lock hinge, slider, cylinder or plane");
    EXPECT_EQ(error_line(drag + "--lock-point 0 0 1"),
              "chasles: --lock-point: belongs to a lock; add --lock hinge, slider, cylinder or plane");
    for (const std::string kind : {"slider", "plane"})
        EXPECT_EQ(error_line(drag + "--lock-point 0 0 1 --lock " + kind),
                  "chasles: --lock-point: says nothing about --lock " + kind +
                      "; leave it out, or lock the body to a hinge or a cylinder");
    write("moving.json", R"({"bodies": [{"name": "box", "mesh": "cube.obj"},
                                        {"name": "other", "mesh": "cube.obj", "pose": [5, 0, 0], "goal": [3, 0, 0]}]})");
    EXPECT_EQ(error_line("drag moving.json --body box --goals goals.csv --out out.csv"),
              "chasles: moving.json: other: moves; a scene to drag a body in must be at rest");
}

} // namespace
} // namespace chasles
