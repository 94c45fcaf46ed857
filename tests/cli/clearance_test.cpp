// chasles clearance: exit status, JSON, report, and the options that it refuses.
#include "tests/cli/cli_test_files.h"

#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

class Clearance : public tests::CommandLine {
protected:
    [[nodiscard]] tests::Finished clearance(const std::string& options) const {
        return run("clearance cube.obj cube.obj " + options);
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
    EXPECT_EQ(keys, (std::vector<std::string>{"distance", "distance_upper", "time", "time_upper", "certain", "contacts",
                                              "work"}));
    EXPECT_LE(answer["distance"], 0.25);
    EXPECT_GE(answer["distance_upper"], 0.25);
    EXPECT_LE(answer["distance_upper"].get<double>() - answer["distance"].get<double>(), 0.25e-6);
    EXPECT_EQ(answer["certain"], true);
    ASSERT_EQ(answer["contacts"].size(), 1U);
    EXPECT_NEAR(answer["contacts"][0]["gap"], 0.25, 1e-12);
    EXPECT_GE(answer["time"], 1.0 / 3 - 1e-9); // the cubes are beside each other
    EXPECT_LE(answer["time_upper"], 2.0 / 3 + 1e-9);
}

TEST_F(Clearance, AgreesWithCheck) {
    const Json answer = Json::parse(clearance(passing + "--json").out);
    const auto check = [&](double margin) {
        return run("check cube.obj cube.obj " + passing + "--margin " + std::to_string(margin)).status;
    };
    EXPECT_EQ(check(answer["distance"].get<double>() * 0.999), 0);
    EXPECT_EQ(check(answer["distance_upper"].get<double>() * 1.001), 1);
}

TEST_F(Clearance, IsZeroWhereTheBodiesTouch) {
    const auto finished = clearance("--start '0.25 0.5 3' --goal '0.25 0.5 -1' --json");
    EXPECT_EQ(finished.status, 1);
    const Json answer = Json::parse(finished.out);
    EXPECT_EQ(answer["distance"], 0);
    EXPECT_EQ(answer["distance_upper"], 0);
    EXPECT_LE(answer["time"], 0.5);
    EXPECT_GE(answer["time_upper"], 0.5);
    EXPECT_EQ(
        clearance("--start '0.25 0.5 3' --goal '0.25 0.5 -1'").out.find("NO CLEARANCE: the bodies touch at time 0.5"),
        0U);
}

TEST_F(Clearance, ReportsForPeople) {
    const auto finished = clearance(passing);
    EXPECT_EQ(finished.status, 0);
    EXPECT_EQ(finished.out.find("CLEARANCE 0.2499"), 0U) << finished.out;
    for (const char* label : {"  screw ", "  distance ", "  time ", "  certain   yes", "  nearest ", "  work "})
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

TEST_F(Clearance, RefusesWhatHasNoMeaning) {
    for (const std::string option : {"--margin 0.1", "--hold 0.1", "--any"}) {
        const auto finished = clearance(passing + option);
        EXPECT_EQ(finished.status, 2) << option;
        EXPECT_EQ(finished.out, "");
        EXPECT_NE(finished.err.find(option.substr(0, option.find(' '))), std::string::npos) << finished.err;
        EXPECT_NE(finished.err.find("a least distance"), std::string::npos) << finished.err;
        EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1);
    }
    EXPECT_NE(clearance(passing + "--tolerance 0").err.find("tolerance: must be in [1e-12, 1]"), std::string::npos);
    EXPECT_NE(clearance(passing + "--tolerance x").err.find("--tolerance"), std::string::npos);
}

} // namespace
} // namespace chasles
