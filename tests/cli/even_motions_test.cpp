// --motion velocity and --motion twist: the answers are those of the library, agree with closed forms, and have no tau.
#include "tests/cli/cli_test_files.h"

#include "chasles/chasles.h"
#include "chasles/io/pose_text.h"
#include "tests/query/posed_distance.h"
#include "tests/support/even_poses.h"

#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

const std::string start = "3 0.2 0.3", goal = "-1 0.2 0.3 0.9 0.1 0.2 0.3";
const std::string fixed_start = "0 -0.1 0 1 0.1 0 0", fixed_goal = "0.5 0 0.2 1 0 0 0.4";
const std::string alone = fmt::format("--start '{}' --goal '{}' ", start, goal);
const std::string both = alone + fmt::format("--fixed-start '{}' --fixed-goal '{}' ", fixed_start, fixed_goal);
const Eigen::Vector3d centre(0.5, -0.25, 1), fixed_centre(-1, 0.5, 0.5);
const std::string centres = "--centre .5 -.25 1 --fixed-centre -1 .5 .5 ";

class EvenMotions : public tests::CommandLine {
protected:
    [[nodiscard]] Polyhedron cube() const { return Polyhedron::load(path("cube.obj").string()); }
    [[nodiscard]] std::string text(const std::string& command, const std::string& options) const {
        return run(command + " cube.obj cube.obj " + options).out;
    }
    [[nodiscard]] Json json(const std::string& command, const std::string& options) const {
        return Json::parse(text(command, options + " --json"));
    }
    [[nodiscard]] FirstContact answer(const Motion& motion) const {
        return first_contact({.moving = cube(), .fixed = cube(), .motion = motion});
    }
};

Pose pose(const std::string& text) {
    return io::parse_pose(text);
}

/// The options of a motion, the same motion made by the library, and its closed form as seen from the fixed body.
struct Case {
    std::string options;
    Motion motion;
    std::function<Eigen::Isometry3d(double)> at;
};

std::vector<Case> cases() {
    const Pose from = pose(start), to = pose(goal), fixed_from = pose(fixed_start), fixed_to = pose(fixed_goal);
    const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    const auto velocity = [=](const Eigen::Vector3d& c) {
        return [=](double time) { return test::velocity_at(from, to, c, time); };
    };
    const auto twist = [=](double time) { return test::twist_at(from, to, time); };
    return {{alone + "--motion velocity", Motion::velocity(from, to), velocity(origin)},
            {alone + "--motion velocity --centre .5 -.25 1", Motion::velocity(from, to, centre), velocity(centre)},
            {alone + "--motion twist", Motion::twist(from, to), twist},
            {both + "--motion velocity", relative(Motion::velocity(from, to), Motion::velocity(fixed_from, fixed_to)),
             [=](double time) {
                 return test::velocity_at(fixed_from, fixed_to, origin, time).inverse() * velocity(origin)(time);
             }},
            {both + centres + "--motion velocity",
             relative(Motion::velocity(from, to, centre), Motion::velocity(fixed_from, fixed_to, fixed_centre)),
             [=](double time) {
                 return test::velocity_at(fixed_from, fixed_to, fixed_centre, time).inverse() * velocity(centre)(time);
             }},
            {both + "--motion twist", relative(Motion::twist(from, to), Motion::twist(fixed_from, fixed_to)),
             [=](double time) { return test::twist_at(fixed_from, fixed_to, time).inverse() * twist(time); }}};
}

TEST_F(EvenMotions, AreThoseOfTheLibrary) {
    for (const Case& known : cases()) {
        const FirstContact expected = answer(known.motion);
        ASSERT_EQ(expected.verdict, Verdict::contact) << known.options;
        const Json found = json("check", known.options);
        EXPECT_EQ(found["time"], expected.time.lower) << known.options;
        EXPECT_EQ(found["time_upper"], expected.time.upper) << known.options;
        EXPECT_EQ(found["clear_until"], expected.clear_until) << known.options;
        EXPECT_EQ(found["pose"][0], expected.pose.translation.x()) << known.options;
        EXPECT_NEAR(found["contacts"][0]["approach_speed"], expected.contacts.at(0).approach_speed, 1e-6)
            << known.options;
    }
}

TEST_F(EvenMotions, AgreeWithDenseSampling) {
    const Polyhedron body = cube();
    for (const Case& known : cases()) {
        const double time = json("check", known.options)["time"];
        EXPECT_LE(test::distance_at(body, body, Pose(known.at(time))), 1e-10) << known.options;
        for (int i = 0; i < 100; ++i)
            EXPECT_GT(test::distance_at(body, body, Pose(known.at(time * i / 100))), 1e-4) << known.options << " " << i;
    }
}

TEST_F(EvenMotions, HaveNoTau) {
    for (const Case& known : cases()) {
        std::vector<std::string> keys;
        const auto found = nlohmann::ordered_json::parse(text("check", known.options + " --json"));
        for (const auto& item : found.items())
            keys.push_back(item.key());
        EXPECT_EQ(keys, (std::vector<std::string>{"verdict", "time", "time_upper", "certain", "pose", "contacts",
                                                  "clear_until", "motion", "work"}));
        EXPECT_FALSE(json("clearance", known.options).contains("tau"));
        EXPECT_FALSE(json("clearance", known.options).contains("tau_upper"));
        EXPECT_EQ(text("check", known.options).find("\n  tau "), std::string::npos);
        EXPECT_EQ(text("clearance", known.options).find("\n  tau "), std::string::npos);
    }
}

void expect_near(const Json& numbers, const Json& expected) {
    for (const char* const key : {"angle", "slide"})
        EXPECT_NEAR(numbers[key], expected[key], 1e-14) << key;
    for (const char* const key : {"axis_point", "axis_direction"})
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(numbers[key][i], expected[key][i], 1e-14) << key;
}

TEST_F(EvenMotions, HaveTheNumbersOfTheScrew) {
    const Json screw = json("check", alone)["motion"];
    for (const std::string options : {"--motion twist", "--motion velocity", "--motion velocity --centre .5 -.25 1"}) {
        expect_near(json("check", alone + options)["motion"], screw);
        expect_near(json("check", both + options)["motion"], screw); // of the moving body in the world
    }
    EXPECT_GT(std::abs(json("check", both)["motion"]["angle"].get<double>() - screw["angle"].get<double>()), 0.1)
        << "a screw is that seen from the fixed body";
    EXPECT_EQ(json("check", alone + "--motion twist")["motion"].size(), 5U);
    const Json velocity = json("check", alone + "--motion velocity --centre .5 -.25 1")["motion"];
    const Eigen::Vector3d expected = pose(goal).isometry() * centre - pose(start).isometry() * centre;
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(velocity["displacement"][i], expected[static_cast<Eigen::Index>(i)], 1e-14);
}

/// One cube spins and comes down while the other one spins and rises: even slides, so the heights are known.
TEST_F(EvenMotions, MeetWhereTwoTwistsDo) {
    const std::string poses =
        "--start 0 0 3 --goal 0 0 1.5 .6 0 0 .8 --fixed-start 0 0 0 --fixed-goal 0 0 1 .9 0 0 -.3 ";
    for (const std::string motion : {"--motion twist", "--motion velocity", "--motion velocity --centre 0 0 1"}) {
        const Json found = json("check", poses + motion);
        EXPECT_EQ(found["verdict"], "contact") << motion;
        EXPECT_LE(found["time"], 0.8) << motion; // 3 - 1.5 t = 1 + t
        EXPECT_GE(found["time_upper"], 0.8) << motion;
        EXPECT_NEAR(found["contacts"][0]["point"][2], 1.8, 1e-11) << motion << ": in the world";
        EXPECT_NEAR(found["contacts"][0]["approach_speed"], 2.5, 1e-9) << motion;
    }
}

/// Neither body turns, and both move: 3 - 2 t = 1 + 1.5 t.
TEST_F(EvenMotions, MayBeTranslations) {
    const std::string poses = "--start 3 .2 .2 --goal 1 .2 .2 --fixed-start 0 0 0 --fixed-goal 1.5 0 0 ";
    for (const std::string motion : {"velocity", "twist"})
        EXPECT_NEAR(json("check", poses + "--motion " + motion)["time"], 4.0 / 7, 1e-12) << motion;
    EXPECT_EQ(json("check", "--start 3 0 0 --goal 3 5 0 --motion twist")["verdict"], "clear");
}

TEST_F(EvenMotions, BracketTheClearanceThatTheLibraryBrackets) {
    const std::string poses = "--start '3 2.25 0.3' --goal '-2 1.75 0.3 0.9 0.1 0.2 0.3' ";
    const Pose from = pose("3 2.25 0.3"), to = pose("-2 1.75 0.3 0.9 0.1 0.2 0.3");
    for (const auto& [name, motion] :
         {std::pair("velocity", Motion::velocity(from, to)), std::pair("twist", Motion::twist(from, to))}) {
        const LeastDistance expected = least_distance({.moving = cube(), .fixed = cube(), .motion = motion});
        const Json found = json("clearance", poses + "--motion " + name);
        EXPECT_EQ(found["distance"], expected.distance.lower) << name;
        EXPECT_EQ(found["distance_upper"], expected.distance.upper) << name;
        EXPECT_EQ(found["time"], expected.time.lower) << name;
        double sampled = 9;
        for (int i = 0; i <= 1000; ++i)
            sampled = std::min(sampled, test::distance_at(cube(), cube(), motion.pose_at(i / 1000.0)));
        EXPECT_LE(found["distance"], sampled) << name;
        EXPECT_NEAR(found["distance_upper"], sampled, 1e-4) << name;
    }
}

TEST_F(EvenMotions, AreReportedByTime) {
    const std::string velocity =
        text("check", "--start 3 0 0 --goal -1 0 0 .8 0 0 .6 --centre 0 0 .5 --motion velocity");
    const double time = json("check", "--start 3 0 0 --goal -1 0 0 .8 0 0 .6 --motion velocity")["time"];
    const double turn = 2 * std::atan2(0.6, 0.8) / std::acos(-1.0) * 180;
    EXPECT_NE(
        velocity.find(fmt::format("  velocity  turns {:.9g} degrees about (0, 0, 1), travels 4 straight on\n", turn)),
        std::string::npos)
        << velocity;
    EXPECT_NE(
        velocity.find(fmt::format("  so far    turned {:.9g} degrees, travelled {:.9g}\n", turn * time, 4 * time)),
        std::string::npos)
        << velocity;
    const std::string twist = text("check", "--start 0 0 3 --goal 0 0 -1 .8 0 0 .6 --motion twist");
    EXPECT_NE(
        twist.find(fmt::format("  twist     turns {:.9g} degrees and slides -4, axis (0, 0, 1) through (0, 0, ", turn)),
        std::string::npos)
        << twist;
    EXPECT_NE(twist.find(fmt::format("  so far    turned {:.9g} degrees, slid -2\n", turn / 2)), std::string::npos)
        << twist;
    EXPECT_NE(text("check", both + "--motion twist").find("in the world; the fixed body moves too\n"),
              std::string::npos);
}

} // namespace
} // namespace chasles
