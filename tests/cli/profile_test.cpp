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
    EXPECT_EQ(within("--start '0.2 0.2 0.2' --goal '0.3 0.3 0.3' --margins 0"), "within    0: nowhere for sure");
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

} // namespace
} // namespace chasles
