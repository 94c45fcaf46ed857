// The data of a page of many bodies, read independently, and wrong records.
#include "view/page.h"
#include "view/page_template.h"
#include "view/record_json.h"

#include "tests/query/bodies.h"
#include "tests/view/packed.h"

#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

std::vector<double> numbers_in(const Json& packed) {
    return tests::unpacked<double>(packed.get<std::string>());
}

class RecordOfScene : public testing::Test {
protected:
    RecordOfScene() {
        scene.add({"left", box, Motion::velocity(test::shifted(-4, 0, 0), test::shifted(0, 0, 0))});
        scene.add({"right", box, Motion::twist(test::shifted(4, 0.2, 0), test::turned({0, 0.2, 0}, {0, 0, 1}, 1))});
        scene.add({"plate", plate, Motion::at_rest(test::shifted(-2, 0, 0))});
    }
    [[nodiscard]] Json json(const SceneAnswer& found, view::RecordSource source) const {
        return Json::parse(view::record_json(view::scene_record(scene, found, source)));
    }
    const Polyhedron box = test::box({0.5, 0.4, 0.3}).polyhedron();
    const Polyhedron plate = test::triangle({0, -9, -9}, {0, 9, -9}, {0, 0, 9}).polyhedron();
    Scene scene;
};

TEST_F(RecordOfScene, HoldsTheContactsToTheLastDigit) {
    const SceneAnswer found = scene.all_contacts();
    ASSERT_GE(found.contacts.size(), 2U);
    const Json record = json(found, view::RecordSource::all_contacts);
    EXPECT_EQ(record["format"], 2);
    EXPECT_EQ(record["source"], "all_contacts");
    EXPECT_EQ(record["clear_until"], found.clear_until);
    ASSERT_EQ(record["events"].size(), found.contacts.size());
    for (std::size_t i = 0; i < found.contacts.size(); ++i) {
        const SceneContact& contact = found.contacts[i];
        const Json& event = record["events"][i];
        EXPECT_EQ(event["time"], contact.contact.time.lower);
        EXPECT_EQ(event["time_upper"], contact.contact.time.upper);
        EXPECT_EQ(event["certain"], contact.contact.certain);
        EXPECT_EQ(event["pair"], Json({contact.moving, contact.fixed}));
        EXPECT_EQ(event["contacts"][0]["normal"][0], contact.contact.contacts[0].normal.x());
        EXPECT_TRUE(event["contacts"][0].contains("moving_feature"));
        EXPECT_FALSE(event.contains("kind"));
        EXPECT_FALSE(event.contains("contacts_cut"));
    }
}

TEST_F(RecordOfScene, SaysThatAListOfContactsIsCut) {
    scene.add({"in the left", box, Motion::velocity(test::shifted(-3.7, 0.1, 0.2), test::shifted(0, 0, 9))});
    const SceneAnswer found = scene.first_contact({.options = {.find = Find::first_with_all_contacts}});
    ASSERT_TRUE(found.contacts.at(0).contact.contacts_cut);
    EXPECT_EQ(json(found, view::RecordSource::first_contact)["events"][0]["contacts_cut"], true);
}

TEST_F(RecordOfScene, HoldsTheLimitOfTheTime) {
    view::SceneRecord record = view::scene_record(scene, scene.all_contacts(), view::RecordSource::all_contacts);
    EXPECT_FALSE(Json::parse(view::record_json(record)).contains("until"));
    record.until = 0.5;
    EXPECT_EQ(Json::parse(view::record_json(record))["until"], 0.5);
}

TEST_F(RecordOfScene, HoldsEachShapeOnce) {
    const Json record = json(scene.first_contact(), view::RecordSource::first_contact);
    ASSERT_EQ(record["meshes"].size(), 2U);
    EXPECT_EQ(record["bodies"][0]["mesh"], 0);
    EXPECT_EQ(record["bodies"][1]["mesh"], 0);
    EXPECT_EQ(record["bodies"][2]["mesh"], 1);
    EXPECT_EQ(tests::unpacked<float>(record["meshes"][0]["vertices"].get<std::string>()).size(), 3 * 8U);
}

TEST_F(RecordOfScene, HoldsThePoseAtTheContact) {
    const SceneAnswer found = scene.first_contact();
    const double time = found.contacts[0].contact.time.lower;
    const Json record = json(found, view::RecordSource::first_contact);
    EXPECT_EQ(numbers_in(record["times"]), (std::vector<double>{0, 1}));
    EXPECT_EQ(numbers_in(record["bodies"][2]["poses"]).size(), 7U) << "the plate rests";
    const std::size_t moving = found.contacts[0].moving;
    const Json& body = record["bodies"][moving];
    ASSERT_TRUE(body.contains("times"));
    const std::vector<double> times = numbers_in(body["times"]), poses = numbers_in(body["poses"]);
    ASSERT_EQ(poses.size(), 7 * times.size());
    const auto place = std::find(times.begin(), times.end(), time);
    ASSERT_NE(place, times.end());
    EXPECT_EQ(poses[7 * static_cast<std::size_t>(place - times.begin())],
              scene.bodies()[moving].motion.pose_at(time).translation.x());
}

view::SceneRecord fall() {
    const Polyhedron box = test::box({0.5, 0.5, 0.5}).polyhedron();
    view::SceneRecord record;
    record.times = {0, 2, 2.5};
    record.bodies = {{"floor", box, {{0, 0, -1, 1, 0, 0, 0}}},
                     {"box", box, {{0, 0, 4, 1, 0, 0, 0}, {0, 0, 0, 1, 0, 0, 0}, {0, 0, 1, 1, 0, 0, 0}}}};
    view::RecordedContact late{.time = 2.25, .time_upper = 2.25, .moving = 1, .fixed = 0, .kind = "slide"};
    view::RecordedContact impact = late;
    impact.time = impact.time_upper = 2;
    impact.kind = "impact";
    impact.has_features = false;
    impact.contacts.resize(1);
    impact.contacts[0].point = {0, 0, -0.5};
    impact.contacts[0].normal = {0, 0, 1};
    record.contacts = {late, impact};
    return record;
}

TEST(SceneRecord, HoldsARecordingInOrderOfTime) {
    const Json record = Json::parse(view::record_json(fall()));
    EXPECT_EQ(record["source"], "recording");
    EXPECT_FALSE(record.contains("clear_until"));
    EXPECT_EQ(numbers_in(record["times"]), (std::vector<double>{0, 2, 2.5}));
    EXPECT_EQ(numbers_in(record["bodies"][1]["poses"])[2], 4);
    EXPECT_FALSE(record["bodies"][1].contains("times"));
    ASSERT_EQ(record["events"].size(), 2U);
    EXPECT_EQ(record["events"][1]["kind"], "slide");
    const Json& impact = record["events"][0];
    EXPECT_EQ(impact["time"], 2);
    EXPECT_EQ(impact["contacts"], Json::parse(R"([{"point": [0, 0, -0.5], "normal": [0, 0, 1], "gap": 0}])"));
}

TEST(SceneRecord, NothingInItEndsAScript) {
    view::SceneRecord record = fall();
    record.title = record.bodies[0].name = record.contacts[0].kind = "</script>\xE2\x80\xA8\xFF";
    const std::string text = view::record_json(record);
    EXPECT_EQ(text.find('<'), std::string::npos);
    for (const char c : text)
        ASSERT_TRUE(c >= ' ' && c <= '~') << static_cast<int>(c);
    EXPECT_EQ(Json::parse(text)["bodies"][0]["name"], "</script>\xE2\x80\xA8\xEF\xBF\xBD");
}

TEST(SceneRecord, StandsInThePageOnce) {
    if (view::page_template().empty())
        GTEST_SKIP() << view::why_no_page_template();
    const std::string page = view::scene_page(fall());
    EXPECT_NE(page.find("<script id=\"scene\" type=\"application/json\">" + view::record_json(fall()) + "</script>"),
              std::string::npos);
}

/// The error for a record that `change` has spoiled.
template <class Change>
std::string error_after(const Change& change) {
    view::SceneRecord record = fall();
    change(record);
    try {
        view::require_valid(record);
        return "";
    } catch (const InvalidInput& error) {
        return error.what();
    }
}

TEST(SceneRecord, WrongRecordsAreRefused) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    using Record = view::SceneRecord;
    EXPECT_EQ(error_after([](Record&) {}), "");
    EXPECT_EQ(error_after([](Record& r) { r.times.clear(); }), "record: times: there are none");
    EXPECT_EQ(error_after([](Record& r) { r.times[1] = 0; }), "record: times[1]: must be after the time before it");
    EXPECT_EQ(error_after([](Record& r) { r.times[2] = nan; }), "record: times[2]: must be a finite number");
    EXPECT_EQ(error_after([](Record& r) { r.bodies[1].poses.pop_back(); }), "record: bodies[1]: 2 poses for 3 times");
    EXPECT_EQ(error_after([](Record& r) {
                  r.bodies[0].times = {1, 0};
              }),
              "record: bodies[0]: times[1]: must be after the time before it");
    EXPECT_EQ(error_after([](Record& r) { r.bodies[1].poses[1][6] = nan; }),
              "record: bodies[1]: a pose has a number that is not finite");
    EXPECT_EQ(error_after([](Record& r) { r.contacts[1].fixed = 2; }),
              "record: contacts[1]: there is no body 2, only 2 from 0");
    EXPECT_EQ(error_after([](Record& r) { r.contacts[1].fixed = 1; }),
              "record: contacts[1]: a body does not touch itself");
    EXPECT_EQ(error_after([](Record& r) { r.contacts[0].time = 3; }),
              "record: contacts[0]: the time must be within the times of the record");
    EXPECT_EQ(error_after([](Record& r) { r.contacts[0].time_upper = nan; }),
              "record: contacts[0]: the bracket must not end before it begins");
    EXPECT_EQ(error_after([](Record& r) { r.contacts[1].contacts[0].gap = nan; }),
              "record: contacts[1]: points, normals and gaps must be finite numbers");
}

} // namespace
} // namespace chasles
