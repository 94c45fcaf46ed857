// chasles check: exit status, JSON and report, and every spelling of a pose.
#include "tests/cli/cli_test_files.h"

#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

class Check : public tests::CommandLine {
protected:
    [[nodiscard]] tests::Finished check(const std::string& options) const {
        return run("check cube.obj cube.obj " + options);
    }
    [[nodiscard]] Json json(const std::string& options) const { return Json::parse(check(options + " --json").out); }
};

std::vector<std::string> keys_of(const std::string& text) {
    std::vector<std::string> keys;
    const auto object = nlohmann::ordered_json::parse(text);
    for (const auto& item : object.items())
        keys.push_back(item.key());
    return keys;
}

TEST_F(Check, AnswersClear) {
    const auto finished = check("--start '3 0 0' --goal '3 5 0' --json");
    EXPECT_EQ(finished.status, 0);
    EXPECT_EQ(finished.err, "");
    EXPECT_EQ(keys_of(finished.out), (std::vector<std::string>{"verdict", "clear_until", "motion", "work"}));
    EXPECT_EQ(Json::parse(finished.out)["verdict"], "clear");
    EXPECT_EQ(Json::parse(finished.out)["motion"]["slide"], 5.0);
}

TEST_F(Check, AnswersContact) {
    const auto finished = check("--start '0.25 0.5 3' --goal '0.25 0.5 -1' --json");
    EXPECT_EQ(finished.status, 1);
    EXPECT_EQ(keys_of(finished.out),
              (std::vector<std::string>{"verdict", "time", "time_upper", "tau", "tau_upper", "certain", "pose",
                                        "contacts", "clear_until", "motion", "work"}));
    const Json answer = Json::parse(finished.out);
    EXPECT_EQ(answer["verdict"], "contact");
    EXPECT_LE(answer["time"], 0.5);
    EXPECT_GE(answer["time_upper"], 0.5);
    EXPECT_LE(answer["time_upper"].get<double>() - answer["time"].get<double>(), 1e-12);
    EXPECT_EQ(answer["certain"], true);
    EXPECT_EQ(answer["pose"].size(), 7U);
    EXPECT_NEAR(answer["pose"][2], 1, 1e-11);
}

TEST_F(Check, TellsGapsAndWhatIsHeldWithAMargin) {
    const std::string poses = "--start '0.25 0.5 1.3' --goal '0.25 0.5 0.5' --margin 0.5 ";
    const Json contacts = json("--start '0.25 0.5 3' --goal '0.25 0.5 -1' --margin 0.5 --all-contacts")["contacts"];
    ASSERT_EQ(contacts.size(), 4U);
    EXPECT_NEAR(contacts[0]["gap"], 0.5, 1e-11);
    EXPECT_EQ(json(poses)["verdict"], "contact_at_start");
    EXPECT_FALSE(json(poses).contains("contacts_cut"));
    EXPECT_EQ(json("--start '0.5 0.25 0.25' --goal '9 0 0' --all-contacts")["contacts_cut"], true);
    const Json held = json(poses + "--hold 0.1");
    EXPECT_EQ(held["verdict"], "contact");
    EXPECT_NEAR(held["clear_until"], 0.25, 1e-11);
    ASSERT_EQ(held["held"].size(), 4U);
    EXPECT_NEAR(held["held"][0]["gap"], 0.3, 1e-12);
    EXPECT_NE(check(poses + "--hold 0.1").out.find("clear to"), std::string::npos);
    const std::string leaving = check("--start '0 0 1.05' --goal '0.5 0 1.3' --margin 0.1 --hold 0.06").out;
    EXPECT_TRUE(leaving.starts_with(
        "CLEAR: proven that the bodies keep the hold distance, or that of the start if it is less"));
}

TEST_F(Check, HoldNeedsAGapAndSaysSo) {
    const std::string poses = "--start '0 0 1' --goal '0.5 0 1' --margin 0.1 --hold 0.02";
    EXPECT_EQ(json(poses)["verdict"], "contact_at_start") << "the cubes touch";
    const std::string line =
        "\n  hold      needs a gap above 0 at the start; move the bodies apart by a little more than 0.02, or allow an "
        "overlap by a radius below 0\n";
    EXPECT_NE(check(poses).out.find(line), std::string::npos) << check(poses).out;
    EXPECT_EQ(json("--start '0 0 1.021' --goal '0.5 0 1.021' --margin 0.1 --hold 0.02")["verdict"], "clear");
    EXPECT_EQ(check("--start '0 0 1' --goal '0.5 0 1' --margin 0.1").out.find("hold"), std::string::npos);
}

TEST_F(Check, NamesFeaturesByKind) {
    const Json contacts = json("--start '0.25 0.5 3' --goal '0.25 0.5 -1' --all-contacts")["contacts"];
    ASSERT_FALSE(contacts.empty());
    for (const Json& contact : contacts) {
        const std::string kind = contact["kind"];
        EXPECT_EQ(contact["moving_feature"].is_number(), kind == "vertex_face");
        EXPECT_EQ(contact["fixed_feature"].is_number(), kind == "face_vertex");
        EXPECT_EQ(contact["moving_feature"].size(), kind == "edge_edge" ? 2U : 1U);
        EXPECT_EQ(contact["fixed_feature"].size(), kind == "edge_edge" ? 2U : 1U);
        EXPECT_NEAR(contact["normal"][2], 1, 1e-12) << "from the fixed body to the moving one";
        EXPECT_NEAR(contact["approach_speed"], 4, 1e-9);
        EXPECT_NEAR(contact["point"][2], 1, 1e-11);
    }
}

TEST_F(Check, AnswersContactAtTheStart) {
    const auto finished = check("--start '0.5 0.25 0.25' --goal '9 0 0' --json");
    EXPECT_EQ(finished.status, 1);
    const Json answer = Json::parse(finished.out);
    EXPECT_EQ(answer["verdict"], "contact_at_start");
    EXPECT_EQ(answer["time"], 0.0);
    ASSERT_TRUE(answer.contains("overlap"));
    EXPECT_EQ(answer["overlap"]["moving_feature"].size() + answer["overlap"]["fixed_feature"].size(), 3U)
        << "an edge of one body and a face of the other";
    EXPECT_EQ(answer["overlap"]["point"].size(), 3U);
}

TEST_F(Check, TakesPosesInEverySpelling) {
    const Json expected = json("--start '-1.5 -0.5 -0.001' --goal '-.5 0 3'");
    for (const char* const poses :
         {"--start -1.5 -0.5 -0.001 --goal -.5 0 3", "--start=-1.5,-.5,-1e-3 --goal=-.5,0,3",
          "--start -1.5,-0.5,-1e-3 --goal '-.5 0 3'", "--goal -.5 0 3 --start '-1.5, -.5, -1e-3 1 0 0 0'",
          "--start '1 0 0 -1.5 0 1 0 -.5 0 0 1 -.001 0 0 0 1' --goal -.5 0 3 2 0 0 0"})
        EXPECT_EQ(json(poses), expected) << poses;
}

TEST_F(Check, TakesMovingFixedBodies) {
    const Json alone = json("--start '3 0.25 0.25' --goal '1.5 0.25 0.25'");
    EXPECT_EQ(alone["verdict"], "clear");
    const Json both = json("--start '3 0.25 0.25' --goal '1.5 0.25 0.25' --fixed-start '0 0 0' --fixed-goal '1.5 0 0'");
    EXPECT_EQ(both["verdict"], "contact");
    EXPECT_NEAR(both["time"], 2.0 / 3, 1e-9);
    EXPECT_NEAR(both["contacts"][0]["point"][0], 2, 1e-9) << "in the world, not in the fixed body";
}

TEST_F(Check, SweepsAboutACentre) {
    const std::string poses = "--start '3 0 0' --goal '-1.2 .4 .3 .9 .1 .1 .1'";
    const double screw = json(poses)["time"];
    const double sweep = json(poses + " --motion sweep")["time"];
    const double centred = json(poses + " --motion sweep --centre '1 0 0'")["time"];
    EXPECT_NE(screw, sweep);
    EXPECT_NE(sweep, centred);
    Json numbers = json(poses + " --motion sweep")["motion"];
    EXPECT_EQ(numbers["kind"], "sweep");
    numbers["kind"] = "screw";
    EXPECT_EQ(numbers, json(poses)["motion"]) << "a sweep has the numbers of the screw with equal end poses";
}

TEST_F(Check, ListsOneContactUnlessAllAreWanted) {
    const std::string poses = "--start '0.25 0.5 3' --goal '0.25 0.5 -1' ";
    EXPECT_EQ(json(poses)["contacts"].size(), 1U);
    EXPECT_EQ(json(poses + "--all-contacts")["contacts"].size(), 4U);
    EXPECT_EQ(check(poses + "--all-contacts --any").status, 2);
}

TEST_F(Check, StopsAtAnyContact) {
    EXPECT_EQ(check("--start '0.25 0.5 3' --goal '0.25 0.5 -1' --any").status, 1);
    EXPECT_EQ(check("--start '3 0 0' --goal '3 5 0' --any").status, 0);
}

TEST_F(Check, TurnsOnceWhereToldTo) {
    const Json whole = json("--start '9 0 0' --goal '9 0 0 0 0 0 1' --max-turn-deg 180");
    EXPECT_EQ(whole["verdict"], "clear");
    EXPECT_NEAR(whole["motion"]["angle"], 3.14159265358979, 1e-12);
}

TEST_F(Check, ReportsForPeople) {
    const auto finished = check("--start '0.25 0.5 3' --goal '0.25 0.5 -1' --all-contacts");
    EXPECT_EQ(finished.status, 1);
    EXPECT_TRUE(finished.out.starts_with("CONTACT at time 0.5; motion: screw\n")) << finished.out;
    EXPECT_NE(finished.out.find("vertex 0 on face 1"), std::string::npos) << finished.out;
    EXPECT_TRUE(check("--start '3 0 0' --goal '3 5 0'").out.starts_with("CLEAR"));
    EXPECT_TRUE(check("--start '.5 .5 .5' --goal '3 5 0'").out.starts_with("CONTACT AT THE START"));
}

} // namespace
} // namespace chasles
