// chasles clearance: exit status, JSON, report, and the options that it refuses.
#include "tests/cli/cli_test_files.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>

namespace chasles {
namespace {

using Json = nlohmann::json;

class Clearance : public tests::CommandLine {
protected:
    [[nodiscard]] tests::Finished clearance(const std::string& options) const {
        return run("clearance cube.obj cube.obj " + options);
    }
    [[nodiscard]] Json json(const std::string& options) const {
        return Json::parse(clearance(options + " --json").out);
    }
};

/// The unit cube passes another one at a distance of 0.25.
const std::string passing = "--start '-3 1.25 0.5' --goal '3 1.25 0.5' ";

TEST_F(Clearance, BracketsTheDistance) {
    const auto finished = clearance(passing + "--json");
    EXPECT_EQ(finished.status, 0);
    EXPECT_EQ(finished.err, "");
    const auto answer = nlohmann::ordered_json::parse(finished.out);
    std::vector<std::string> keys;
    for (const auto& item : answer.items())
        keys.push_back(item.key());
    EXPECT_EQ(keys, (std::vector<std::string>{"distance", "distance_upper", "time", "time_upper", "tau", "tau_upper",
                                              "certain", "pose", "contacts", "motion", "work"}));
    EXPECT_LE(answer["distance"], 0.25);
    EXPECT_GE(answer["distance_upper"], 0.25);
    EXPECT_LE(answer["distance_upper"].get<double>() - answer["distance"].get<double>(), 0.25e-6);
    EXPECT_EQ(answer["certain"], true);
    ASSERT_EQ(answer["contacts"].size(), 1U);
    EXPECT_NEAR(answer["contacts"][0]["gap"], 0.25, 1e-12);
    EXPECT_GE(answer["time"], 1.0 / 3 - 1e-9); // the cubes are beside each other
    EXPECT_LE(answer["time_upper"], 2.0 / 3 + 1e-9);
}

/// The unit cube turns by 170 degrees about its edge at x = 3.5, y = 0. At 135 degrees the opposite edge comes nearest
/// to the side x = 1 of the other cube: it is sqrt(2) away from the axis.
TEST_F(Clearance, OfATurningEdge) {
    const double half = 85 * std::numbers::pi / 180;
    const std::string turned = fmt::format("3.5 0 0 {} 0 0 {}", std::cos(half), std::sin(half));
    const Json answer = json("--start '3.5 0 0' --goal '" + turned + "'");
    const double expected = 2.5 - std::numbers::sqrt2;
    EXPECT_LE(answer["distance"], expected);
    EXPECT_GE(answer["distance_upper"], expected);
    EXPECT_LE(answer["distance_upper"].get<double>() - answer["distance"].get<double>(), 1e-6 * expected);
    EXPECT_NEAR(answer["time"], 135.0 / 170, 1e-6);
    EXPECT_NEAR(answer["motion"]["angle"], 2 * half, 1e-14);
}

/// With the lower end as margin the bodies are proven clear; with a margin above the upper end they come into contact.
TEST_F(Clearance, AgreesWithCheck) {
    for (const std::string& poses : {passing, std::string("--start '3 2.25 0.3' --goal '-2 1.75 0.3 0.9 0.1 0.2 0.3' "),
                                     std::string("--start '2 2 2' --goal '1.5 1.6 1.7 .5 .5 .1 .2' --motion sweep ")}) {
        const Json answer = json(poses);
        const auto check = [&](double margin) {
            return run("check cube.obj cube.obj " + poses + fmt::format("--margin {}", margin)).status;
        };
        ASSERT_GT(answer["distance"], 0);
        EXPECT_EQ(check(answer["distance"].get<double>() * (1 - 1e-9)), 0) << poses;
        EXPECT_EQ(check(answer["distance_upper"].get<double>() * (1 + 1e-9)), 1) << poses;
    }
}

TEST_F(Clearance, IsZeroWhereTheBodiesTouch) {
    const std::string poses = "--start '0.25 0.5 3' --goal '0.25 0.5 -1' ";
    const auto finished = clearance(poses);
    EXPECT_EQ(finished.status, 1);
    EXPECT_TRUE(finished.out.starts_with("TOUCH at time 0.5; motion: screw\n")) << finished.out;
    EXPECT_NE(finished.out.find("  touching "), std::string::npos) << finished.out;
    const Json answer = json(poses), check = Json::parse(run("check cube.obj cube.obj --json " + poses).out);
    EXPECT_EQ(answer["distance"], 0.0);
    EXPECT_EQ(answer["distance_upper"], 0.0);
    for (const char* const key : {"time", "time_upper", "tau", "tau_upper", "certain", "pose", "contacts", "motion"})
        EXPECT_EQ(answer[key], check[key]) << key;
}

TEST_F(Clearance, IsZeroWhereTheBodiesOverlapAtTheStart) {
    const std::string poses = "--start '0.5 0.25 0.25' --goal '9 0 0' --all-contacts ";
    const auto finished = clearance(poses);
    EXPECT_EQ(finished.status, 1);
    EXPECT_TRUE(finished.out.starts_with("TOUCH AT THE START: the surfaces pass through each other; motion: screw\n"))
        << finished.out;
    EXPECT_EQ(json(poses)["overlap"]["point"].size(), 3U);
    EXPECT_EQ(json(poses)["contacts_cut"], true);
}

/// A distance far below the rounding of the scene.
TEST_F(Clearance, IsNotProvenBelowTheRounding) {
    const std::string poses = "--start '-2 1.000000000000001 0' --goal '2 1.000000000000001 0'";
    const Json answer = json(poses);
    EXPECT_GT(answer["distance_upper"], 0);
    EXPECT_LT(answer["distance_upper"], 1e-11);
    const auto finished = clearance(poses);
    if (answer["distance"] == 0) {
        EXPECT_EQ(finished.status, 1);
        EXPECT_TRUE(finished.out.starts_with("NO CLEARANCE PROVEN: at most ")) << finished.out;
        EXPECT_NE(finished.out.find("certain   no"), std::string::npos) << finished.out;
    }
}

TEST_F(Clearance, ReportsForPeople) {
    const auto finished = clearance(passing);
    EXPECT_EQ(finished.status, 0);
    EXPECT_TRUE(finished.out.starts_with("CLEARANCE 0.2499997")) << finished.out;
    for (const char* const label : {"  screw ", "  distance  0.2499997", "  so far    turned 0 degrees, slid ",
                                    "  time ", "  tau ", "  certain   yes", "  nearest ", "   gap\n", "  work "})
        EXPECT_NE(finished.out.find(label), std::string::npos) << label;
}

TEST_F(Clearance, TakesTheOptionsOfTheMotion) {
    const std::string still = "--start '3 0 0' --goal '3 0 0' ";
    EXPECT_NEAR(Json::parse(clearance(still + "--json --fixed-start '0 0 0' --fixed-goal '-1 0 0'").out)["distance"], 2,
                1e-5);
    const auto contacts = [&](const std::string& options) {
        return Json::parse(clearance(still + options + " --json").out)["contacts"].size();
    };
    EXPECT_EQ(contacts(""), 1U);
    EXPECT_EQ(contacts("--all-contacts"), 4U);
    const Json rough =
        Json::parse(clearance(passing + "--tolerance 0.5 --motion sweep --centre '.5 .5 .5' --json").out);
    EXPECT_GT(rough["distance_upper"].get<double>() - rough["distance"].get<double>(), 1e-3);
}

TEST_F(Clearance, RefusesOptionsOfCheckWithoutMeaning) {
    const auto error = [&](const std::string& option) {
        return error_line("clearance cube.obj cube.obj " + passing + option);
    };
    const std::string hint = " (see chasles clearance --help)";
    for (const std::string option : {"--margin 0.1", "--margin -.1", "--margin=1"})
        EXPECT_EQ(error(option), "chasles clearance: --margin: clearance measures the distance and takes no margin; "
                                 "check takes one" +
                                     hint);
    EXPECT_EQ(error("--hold 0.1"),
              "chasles clearance: --hold: clearance measures the distance and has no margin, so it "
              "holds no contacts; check does" +
                  hint);
    EXPECT_EQ(error("--any --json"), "chasles clearance: --any: clearance searches the whole motion for the least "
                                     "distance, so it cannot stop at any contact; check can" +
                                         hint);
    EXPECT_EQ(clearance("--help").out.find("--margin"), std::string::npos);
}

TEST_F(Clearance, RefusesATolerance) {
    const auto error = [&](const std::string& option) {
        return error_line("clearance cube.obj cube.obj " + passing + option);
    };
    for (const std::string tolerance : {"0", "-.5", "2", "1e-13"})
        EXPECT_EQ(error("--tolerance " + tolerance), "chasles: query: tolerance: must be in [1e-12, 1]");
    EXPECT_EQ(error("--tolerance="), "chasles: --tolerance: is empty, but takes T");
    EXPECT_EQ(error("--tolerance x"), "chasles: --tolerance: not a number: 'x'");
    EXPECT_TRUE(error("--time-tolerance 2").starts_with("chasles: query: time_tolerance: "));
}

} // namespace
} // namespace chasles
