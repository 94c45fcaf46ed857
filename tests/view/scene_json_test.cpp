// The scene has the numbers of the answer, to the last digit, and no text that could end a script element.
#include "view/page.h"
#include "view/page_template.h"

#include "tests/query/bodies.h"
#include "tests/view/packed.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

class SceneJson : public testing::Test {
protected:
    const Polyhedron moving = test::box({0.5, 0.4, 0.3}).polyhedron();
    const Polyhedron fixed = test::triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0}).polyhedron();
    const ScrewMotion screw =
        ScrewMotion::between(test::shifted(0, 0, 2), test::turned({0.1, 0.2, -2}, {0.3, 0.5, 1}, 1.1));
    const Motion motion = screw;
    const view::MotionNumbers numbers = view::numbers_of(screw);
    const FirstContact found = first_contact({.moving = moving, .fixed = fixed, .motion = motion});

    [[nodiscard]] view::Scene scene() const {
        return {.moving = moving, .fixed = fixed, .motion = motion, .numbers = numbers, .found = found};
    }
    [[nodiscard]] Json json() const { return Json::parse(view::scene_json(scene())); }
};

TEST_F(SceneJson, HoldsTheAnswerToTheLastDigit) {
    ASSERT_EQ(found.verdict, Verdict::contact);
    const Json answer = json()["answer"];
    EXPECT_EQ(answer["verdict"], "contact");
    EXPECT_EQ(answer["time"], found.time.lower);
    EXPECT_EQ(answer["time_upper"], found.time.upper);
    EXPECT_EQ(answer["tau"], found.tau.lower);
    ASSERT_EQ(answer["contacts"].size(), found.contacts.size());
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(answer["contacts"][0]["point"][i], found.contacts[0].point[i]);
        EXPECT_EQ(answer["contacts"][0]["normal"][i], found.contacts[0].normal[i]);
        EXPECT_EQ(answer["pose"][i], found.pose.translation[i]);
    }
    EXPECT_EQ(answer["contacts"][0]["gap"], found.contacts[0].gap);
}

TEST_F(SceneJson, HoldsBothMeshes) {
    const Json meshes = json()["meshes"];
    ASSERT_EQ(meshes.size(), 2U);
    const auto vertices = tests::unpacked<float>(meshes[0]["vertices"].get<std::string>());
    ASSERT_EQ(vertices.size(), 3 * moving.vertex_count());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        EXPECT_EQ(vertices[i], static_cast<float>(moving.vertices()[i / 3][static_cast<int>(i % 3)]));
    EXPECT_EQ(tests::unpacked<std::uint32_t>(meshes[0]["triangles"].get<std::string>()).size(), 3U * 12);
    EXPECT_EQ(tests::unpacked<std::uint32_t>(meshes[1]["triangles"].get<std::string>()).size(), 3U);
    EXPECT_EQ(tests::unpacked<std::uint32_t>(meshes[1]["creases"].get<std::string>()).size(), 2U * 3);
}

TEST_F(SceneJson, WritesABodyThatMeetsItselfOnce) {
    view::Scene same{.moving = moving, .fixed = moving, .motion = motion, .numbers = numbers, .found = found};
    const Json json = Json::parse(view::scene_json(same));
    EXPECT_EQ(json["meshes"].size(), 1U);
    EXPECT_EQ(json["fixed"]["mesh"], 0);
}

TEST_F(SceneJson, HoldsTheWay) {
    const auto poses = tests::unpacked<double>(json()["moving"]["poses"].get<std::string>());
    ASSERT_GE(poses.size(), 7U * 241);
    EXPECT_NEAR(poses[2], 2, 1e-14);
    EXPECT_NEAR(poses[poses.size() - 5], -2, 1e-14);
    EXPECT_EQ(json()["fixed"]["poses"].get<std::string>().size(), 4U * 19) << "one pose of 56 bytes";
}

TEST_F(SceneJson, NamesTheMotion) {
    EXPECT_EQ(json()["motion"], "screw");
    EXPECT_EQ(json()["is_sweep"], false);
    EXPECT_EQ(json()["is_in_world"], false);
    const SweepMotion sweep = SweepMotion::between(test::shifted(0, 0, 2), test::shifted(0, 0, -2));
    const view::MotionNumbers of_sweep = view::numbers_of(sweep);
    const Motion plain = sweep;
    const view::Scene other{.moving = moving, .fixed = fixed, .motion = plain, .numbers = of_sweep, .found = found};
    EXPECT_EQ(Json::parse(view::scene_json(other))["motion"], "sweep");
    EXPECT_EQ(Json::parse(view::scene_json(other))["is_sweep"], true);
}

TEST_F(SceneJson, HoldsNoTauOfAnEvenMotion) {
    const Pose start = test::shifted(0, 0, 2), goal = test::turned({0.1, 0.2, -2}, {0.3, 0.5, 1}, 1.1);
    const ConstantVelocity velocity = ConstantVelocity::between(start, goal, {0.1, 0.2, 0.3});
    const ConstantTwist twist = ConstantTwist::between(start, goal);
    const auto scene_of = [&](const Motion& even, const view::MotionNumbers& of_even) {
        const FirstContact met = first_contact({.moving = moving, .fixed = fixed, .motion = even});
        EXPECT_EQ(met.verdict, Verdict::contact);
        return Json::parse(
            view::scene_json({.moving = moving, .fixed = fixed, .motion = even, .numbers = of_even, .found = met}));
    };
    const Json by_velocity = scene_of(velocity, view::numbers_of(velocity));
    const Json by_twist = scene_of(twist, view::numbers_of(twist));
    EXPECT_EQ(by_velocity["motion"], "velocity");
    EXPECT_EQ(by_twist["motion"], "twist");
    for (const Json& scene : {by_velocity, by_twist}) {
        EXPECT_TRUE(scene["answer"].contains("time"));
        EXPECT_FALSE(scene["answer"].contains("tau"));
        EXPECT_FALSE(scene["answer"].contains("tau_upper"));
        EXPECT_NEAR(scene["answer"]["motion"]["angle"], 1.1, 1e-14);
    }
    EXPECT_EQ(by_velocity["answer"]["motion"]["displacement"][2], velocity.displacement().z());
    EXPECT_FALSE(by_twist["answer"]["motion"].contains("displacement"));
}

TEST_F(SceneJson, HoldsTheWaysOfTwoBodies) {
    const Motion one = Motion::twist(test::shifted(0, 0, 2), test::turned({0.1, 0.2, -2}, {0.3, 0.5, 1}, 1.1));
    const Motion two = Motion::velocity(test::shifted(0, 0, -1), test::turned({0, 0, 1}, {1, 0, 0}, 0.5));
    const Motion both = relative(one, two);
    const FirstContact met = first_contact({.moving = moving, .fixed = fixed, .motion = both});
    ASSERT_EQ(met.verdict, Verdict::contact);
    const Json scene = Json::parse(
        view::scene_json({.moving = moving, .fixed = fixed, .motion = both, .numbers = numbers, .found = met}));
    const auto poses = tests::unpacked<double>(scene["fixed"]["poses"].get<std::string>());
    ASSERT_GE(poses.size(), 7U * 241);
    EXPECT_NEAR(poses[2], -1, 1e-14);
    EXPECT_NEAR(poses[poses.size() - 5], 1, 1e-14);
    EXPECT_NEAR(scene["fixed_pose"][2], -1 + 2 * met.time.lower, 1e-12);
    EXPECT_NEAR(scene["fixed_pose"][2], met.fixed_pose.translation.z(), 1e-9);
}

TEST_F(SceneJson, NothingInItEndsAScript) {
    view::Scene named = scene();
    named.title = "</script><script>alert('\xE2\x80\xA8')</script><!-- \\ \" \n";
    named.moving_name = "caf\xC3\xA9 \xFF.obj"; // a file name need not be UTF-8
    const std::string text = view::scene_json(named);
    EXPECT_EQ(text.find('<'), std::string::npos);
    for (const char c : text)
        ASSERT_TRUE(c >= ' ' && c <= '~') << static_cast<int>(c);
    EXPECT_EQ(Json::parse(text)["title"], named.title);
    EXPECT_EQ(Json::parse(text)["moving"]["name"], "caf\xC3\xA9 \xEF\xBF\xBD.obj");
}

TEST_F(SceneJson, StandsInThePageOnce) {
    if (view::page_template().empty())
        GTEST_SKIP() << view::why_no_page_template();
    view::Scene named = scene();
    named.title = std::string(view::scene_marker) + " $& </script>";
    const std::string page = view::page(named);
    EXPECT_NE(page.find("<script id=\"scene\" type=\"application/json\">" + view::scene_json(named) + "</script>"),
              std::string::npos);
    EXPECT_TRUE(page.starts_with("<!doctype html>"));
    EXPECT_NE(page.find("The MIT License"), std::string::npos) << "of three.js";
}

} // namespace
} // namespace chasles
