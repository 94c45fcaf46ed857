// chasles profile: exit status, JSON, the table, the picture, and what it refuses.
#include "tests/cli/cli_test_files.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace chasles {
namespace {

using Json = nlohmann::json;

/// The unit cube passes another one at a distance of 0.25, or goes through it.
const std::string passing = "--start '-3 1.25 0' --goal '3 1.25 0' ";
const std::string through = "--start '-3 0.25 0' --goal '3 0.25 0' ";

double distance_at(double time) {
    return std::hypot(std::max(0.0, std::abs(6 * time - 3) - 1), 0.25);
}

class ProfileCommand : public tests::CommandLine {
protected:
    [[nodiscard]] tests::Finished profile(const std::string& options) const {
        return run("profile cube.obj cube.obj " + options);
    }
};

TEST_F(ProfileCommand, BoundsTheDistanceAtAllTimes) {
    const auto finished = profile(passing + "--margins 0.5,1 --json");
    EXPECT_EQ(finished.status, 0) << finished.err;
    const Json answer = Json::parse(finished.out);
    EXPECT_EQ(answer["certain"], true);
    const std::vector<double> times = answer["times"], lower = answer["lower"], upper = answer["upper"];
    ASSERT_EQ(times.size(), lower.size());
    ASSERT_EQ(times.size(), upper.size());
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
        for (const double time : {times[i], 0.5 * (times[i] + times[i + 1]), times[i + 1]}) {
            EXPECT_LE(lower[i], distance_at(time) + 1e-12);
            EXPECT_GE(upper[i], distance_at(time) - 1e-12);
        }
    EXPECT_EQ(answer["free"], Json::parse("[[0.0, 1.0]]"));
    ASSERT_EQ(answer["zones"].size(), 2U);
    EXPECT_EQ(answer["zones"][1]["margin"], 1.0);
    EXPECT_NEAR(answer["zones"][1]["inside"][0][0], 0.5 - (1 + std::sqrt(0.9375)) / 6, 2e-6);
}

TEST_F(ProfileCommand, SaysWhenTheBodiesAreFreeAndWithinMargins) {
    const auto finished = profile(through + "--margins 0.5");
    EXPECT_EQ(finished.status, 1);
    EXPECT_NE(finished.out.find("DISTANCE from 0 to 2: the bodies touch, or may touch; motion: screw"),
              std::string::npos);
    EXPECT_NE(finished.out.find("within    0.5: 0.25"), std::string::npos) << finished.out;
    EXPECT_NE(finished.out.find("free      0 to 0.333"), std::string::npos) << finished.out;
}

TEST_F(ProfileCommand, SaysNeverOnlyWhereThatIsProven) {
    const auto within = [&](const std::string& options) {
        const std::string out = profile(options).out;
        return out.substr(out.find("within"), out.find('\n', out.find("within")) - out.find("within"));
    };
    EXPECT_EQ(within("--start '0.2 0.2 0.2' --goal '0.3 0.3 0.3' --margins 0"), "within    0: 0 to 1");
    EXPECT_EQ(within("--start '1 0.2 0.2' --goal '1 0.3 0.3' --margins 0"), "within    0: nowhere for sure");
    EXPECT_EQ(within("--start '3 0 0' --goal '3 1 0' --margins 1.5"), "within    1.5: never");
}

TEST_F(ProfileCommand, WritesATableAndAPicture) {
    EXPECT_EQ(profile(passing + "--csv p.csv --plot p.svg").status, 0);
    const auto content = [&](const char* name) {
        std::ostringstream text;
        text << std::ifstream(path(name)).rdbuf();
        return text.str();
    };
    EXPECT_TRUE(content("p.csv").starts_with("time,lower,upper\n0,"));
    EXPECT_NE(content("p.svg").find("<polygon points="), std::string::npos);
    EXPECT_EQ(profile(passing + "--csv cube.obj").status, 2) << "an input";
    const auto refused = profile(passing + "--plot p.png");
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("--plot: p.png: pictures are SVG"), std::string::npos) << refused.err;
    EXPECT_EQ(profile(passing + "--margins 1,-2").status, 2);
}

/// A cart between two walls.
TEST_F(ProfileCommand, OfASceneNamesTheNearestPair) {
    const std::string hall =
        R"({"bodies": [{"name": "left", "mesh": "cube.obj", "pose": [-4, 0, 0]}, {"name": "right, far", "mesh": "cube.obj", "pose": [4, 0, 0]},)"
        R"({"name": "cart", "mesh": "cube.obj", "pose": [-2, 0, 0], "goal": [2, 0, 0]}]})";
    std::ofstream(path("hall.json")) << hall;
    const auto finished = run("scene hall.json --profile --margins 1.5 --csv hall.csv --plot hall.svg");
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_TRUE(finished.out.starts_with("DISTANCE from 1 to 3")) << finished.out;
    EXPECT_NE(finished.out.find("; motion: velocity\n  untested  1 pair: 1 at rest (left and right, far)\n"),
              std::string::npos)
        << finished.out;
    EXPECT_NE(finished.out.find("  nearest   cart and left: 0 to 0."), std::string::npos) << finished.out;
    EXPECT_NE(finished.out.find("            cart and right, far: 0."), std::string::npos) << finished.out;
    std::string head, row;
    std::ifstream table(path("hall.csv"));
    std::getline(table, head);
    std::getline(table, row);
    EXPECT_EQ(head, "time,lower,upper,first,second");
    EXPECT_TRUE(row.starts_with("0,") && row.ends_with(",cart,left")) << row;
    while (std::getline(table, row))
        head = row;
    EXPECT_TRUE(head.starts_with("1,") && head.ends_with(",cart,\"right, far\"")) << head;
    const Json answer = Json::parse(run("scene hall.json --profile --json").out);
    EXPECT_EQ(answer["pairs"], Json::parse(R"([["cart", "left"], ["cart", "right, far"]])"));
    EXPECT_EQ(answer["nearest"].size() + 1, answer["times"].size());
    EXPECT_EQ(answer["untested"]["pairs"], 1);
    write("rest.json", R"({"bodies": [{"name": "a", "mesh": "cube.obj"}]})");
    const Json none = Json::parse(run("scene rest.json --profile --json --csv rest.csv").out);
    for (const auto& [key, value] : answer.items())
        EXPECT_TRUE(none.contains(key)) << key;
    EXPECT_EQ(none["pairs"], Json::array());
    EXPECT_EQ(none["nearest"], Json::array());
    std::ifstream rest(path("rest.csv"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(rest), {}),
              "time,lower,upper,first,second\n0,inf,inf,,\n1,inf,inf,,\n");
    EXPECT_EQ(run("scene hall.json --tolerance 0.1").status, 2) << "of what?";
    EXPECT_EQ(run("scene hall.json --csv hall.csv").status, 2) << "of what?";
    EXPECT_EQ(run("scene hall.json --profile --csv hall.json").status, 2) << "an input";
}

} // namespace
} // namespace chasles
