// chasles path with --motion, and with time stamps: the answers are those of the library, in stamps.
#include "tests/cli/cli_test_files.h"

#include "chasles/chasles.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

const std::string columns = "x,y,z,qw,qx,qy,qz";
/// The last segment touches the cube at the origin.
const std::vector<std::vector<double>> rows = {
    {3, 0, 0, 1, 0, 0, 0}, {3, 3, 0.1, 0.9, 0, 0.2, 0}, {0.25, 3, 0.5, 1, 0, 0, 0}, {0.25, -0.5, 0.5, 1, 0.1, 0, 0.2}};
const std::vector<double> stamps = {10, 11, 13, 14.5};

class PathMotions : public tests::CommandLine {
protected:
    PathMotions() {
        std::string plain = columns + "\n", stamped = "t," + columns + "\n";
        for (std::size_t i = 0; i < rows.size(); ++i) {
            plain += fmt::format("{}\n", fmt::join(rows[i], ","));
            stamped += fmt::format("{},{}\n", stamps[i], fmt::join(rows[i], ","));
        }
        write("plain.csv", plain);
        write("stamped.csv", stamped);
        write("far.csv", "t," + columns + "\n-2,3,0,0,1,0,0,0\n1.5,3,3,0,1,0,0,0\n4,3,3,2,.9,.1,.2,.3\n");
    }
    [[nodiscard]] std::string text(const std::string& options) const {
        return run("path cube.obj cube.obj --poses " + options).out;
    }
    [[nodiscard]] Json json(const std::string& options) const { return Json::parse(text(options + " --json")); }
    [[nodiscard]] FirstContact answer(const Motion& motion) const {
        const Polyhedron cube = Polyhedron::load(path("cube.obj").string());
        return first_contact({.moving = cube, .fixed = cube, .motion = motion});
    }
};

std::vector<Pose> poses() {
    std::vector<Pose> poses;
    for (const std::vector<double>& r : rows)
        poses.emplace_back(Eigen::Vector3d(r[0], r[1], r[2]), Eigen::Quaterniond(r[3], r[4], r[5], r[6]));
    return poses;
}

/// The motions of the last segment.
std::vector<std::pair<std::string, Motion>> motions() {
    const Pose from = poses()[2], to = poses()[3];
    return {{"screw", Motion::screw(from, to)},
            {"sweep --centre 1 0 -1", Motion::sweep(from, to, {1, 0, -1})},
            {"velocity --centre 1 0 -1", Motion::velocity(from, to, {1, 0, -1})},
            {"twist", Motion::twist(from, to)}};
}

TEST_F(PathMotions, AreThoseOfTheLibrary) {
    for (const auto& [name, motion] : motions()) {
        const Json found = json("plain.csv --motion " + name);
        const FirstContact expected = answer(motion);
        ASSERT_EQ(expected.verdict, Verdict::contact) << name;
        EXPECT_EQ(found["segment"], 2) << name;
        EXPECT_EQ(found["time"], expected.time.lower) << name;
        EXPECT_EQ(found["time_upper"], expected.time.upper) << name;
        EXPECT_EQ(found.contains("tau"), name == "screw" || name.starts_with("sweep")) << name;
    }
    EXPECT_EQ(json("plain.csv"), json("plain.csv --motion screw")) << "the default";
}

TEST_F(PathMotions, AreOneTrackWithStamps) {
    using Between = TimedPoses::Between;
    const std::vector<std::pair<std::string, TimedPoses>> tracks = {
        {"velocity", TimedPoses::through(stamps, poses())},
        {"velocity --centre 1 0 -1", TimedPoses::through(stamps, poses(), Between::velocity, {1, 0, -1})},
        {"twist", TimedPoses::through(stamps, poses(), Between::twist)}};
    for (const auto& [name, track] : tracks) {
        const FirstContact expected = answer(track);
        ASSERT_EQ(expected.verdict, Verdict::contact) << name;
        const Json found = json("stamped.csv --motion " + name);
        EXPECT_EQ(found["time"], track.stamp_of(expected.time).lower) << name;
        EXPECT_EQ(found["time_upper"], track.stamp_of(expected.time).upper) << name;
        EXPECT_EQ(found["clear_until"], found["time"]) << name;
        EXPECT_EQ(found["segment"], track.segment_of(expected.time.lower)) << name;
        EXPECT_NEAR(found["contacts"][0]["approach_speed"], expected.contacts.at(0).approach_speed / 4.5, 1e-12)
            << name;
        EXPECT_FALSE(found.contains("tau")) << name;
    }
    EXPECT_EQ(json("stamped.csv"), json("stamped.csv --motion screw")) << "the default, as without stamps";
}

/// A track and its segments are the same motion; of screws and sweeps the times of a segment are mapped to stamps.
TEST_F(PathMotions, CountInStampsSegmentBySegment) {
    for (const auto& [name, motion] : motions()) {
        const FirstContact expected = answer(motion);
        const Json found = json("stamped.csv --motion " + name);
        EXPECT_EQ(found["segment"], 2) << name;
        EXPECT_NEAR(found["time"], 13 + 1.5 * expected.time.lower, 1e-11) << name;
        EXPECT_NEAR(found["time_upper"], 13 + 1.5 * expected.time.upper, 1e-11) << name;
        EXPECT_LT(found["time_upper"].get<double>() - found["time"].get<double>(), 1e-11) << name;
        EXPECT_NEAR(found["clear_until"], 13 + 1.5 * expected.clear_until, 1e-11) << name;
        EXPECT_NEAR(found["contacts"][0]["approach_speed"], expected.contacts.at(0).approach_speed / 1.5, 1e-6) << name;
        EXPECT_EQ(found["motion"], json("plain.csv --motion " + name)["motion"]) << name << ": of the segment";
        EXPECT_EQ(found.contains("tau"), name == "screw" || name.starts_with("sweep")) << name;
    }
}

TEST_F(PathMotions, RunToTheLastStampWhenClear) {
    for (const std::string motion : {"screw", "sweep", "velocity", "twist"}) {
        const Json found = json("far.csv --motion " + motion);
        EXPECT_EQ(found["verdict"], "clear") << motion;
        EXPECT_EQ(found["clear_until"], 4.0) << motion;
        EXPECT_EQ(found["segment"], 1) << motion;
        EXPECT_NE(text("far.csv --motion " + motion).find("  path      2 segments\n"), std::string::npos) << motion;
    }
}

TEST_F(PathMotions, BeginAtTheFirstStamp) {
    write("inside.csv", "t," + columns + "\n-2.5,.5,.5,.5,1,0,0,0\n7,3,3,0,1,0,0,0\n");
    for (const std::string motion : {"screw", "sweep", "velocity", "twist"}) {
        const Json found = json("inside.csv --motion " + motion);
        EXPECT_EQ(found["verdict"], "contact_at_start") << motion;
        EXPECT_EQ(found["time"], -2.5) << motion;
        EXPECT_EQ(found["time_upper"], -2.5) << motion;
        EXPECT_EQ(found["clear_until"], -2.5) << motion;
    }
}

/// The times of what is held count in stamps too. The cube slides down to the hold distance: 0.3 - 0.8 s = 0.1.
TEST_F(PathMotions, HoldInStamps) {
    write("hold.csv", "t," + columns + "\n5,.25,.5,1.3,1,0,0,0\n7,.25,.5,.5,1,0,0,0\n");
    for (const std::string motion : {"screw", "sweep"}) {
        const Json found = json("hold.csv --margin .5 --hold .1 --motion " + motion);
        EXPECT_NEAR(found["time"], 5.5, 1e-11) << motion;
        EXPECT_NEAR(found["clear_until"], 5.5, 1e-11) << motion;
        EXPECT_NEAR(found["held"].at(0)["approach_speed"], 0.4, 1e-9) << motion << ": per unit of the stamps";
    }
}

/// Whatever the last segment holds.
TEST_F(PathMotions, AClearPathWithHoldClaimsTheHoldDistance) {
    write("leaves.csv", columns + "\n.25,.5,1.3,1,0,0,0\n.25,.5,3,1,0,0,0\n2,2,3,1,0,0,0\n");
    for (const std::string motion : {"screw", "velocity"})
        EXPECT_TRUE(
            text("leaves.csv --margin .5 --hold .1 --motion " + motion)
                .starts_with("CLEAR: proven that the bodies keep the hold distance, or that of the start of a segment"))
            << motion;
}

TEST_F(PathMotions, AreReportedInStamps) {
    write("straight.csv",
          "t," + columns + "\n10,3,0,0,1,0,0,0\n11,3,3,0,1,0,0,0\n13,.25,3,.5,1,0,0,0\n14.5,.25,0,.5,1,0,0,0\n");
    const std::string stamped = text("straight.csv --motion velocity");
    EXPECT_TRUE(stamped.starts_with("CONTACT at time 14; motion: velocity\n")) << stamped;
    for (const char* const line :
         {"  segment   2 of 3 (from 0), from pose 2 at t = 13 to pose 3 at t = 14.5; the time counts as t\n",
          "  velocity  turns 0 degrees about (0, -1, 0), travels 3 straight on\n",
          "  so far    turned 0 degrees, travelled 2\n"})
        EXPECT_NE(stamped.find(line), std::string::npos) << stamped;
    EXPECT_EQ(stamped.find("\n  tau "), std::string::npos) << stamped;
    const std::string screws = text("straight.csv");
    EXPECT_NE(screws.find("  so far    turned 0 degrees, slid 2\n"), std::string::npos) << screws;
    EXPECT_NE(screws.find("\n  tau       0.66666666"), std::string::npos) << screws;
}

TEST_F(PathMotions, RefusesWhatMakesNoSense) {
    const std::string path = "path cube.obj cube.obj --poses ";
    EXPECT_EQ(error_line(path + "plain.csv --centre 1 2 3"),
              "chasles: --centre: is for --motion sweep and --motion velocity, but the motion is a screw");
    EXPECT_EQ(error_line(path + "stamped.csv --motion twist --centre 1 2 3"),
              "chasles: --centre: is for --motion sweep and --motion velocity, but the motion is a twist");
    EXPECT_EQ(error_line(path + "plain.csv --fixed-start 1 2 3"),
              "chasles path: The following argument was not expected: --fixed-start=1 2 3 (see chasles path --help)");
}

TEST_F(PathMotions, RefusesBadStamps) {
    const auto error = [&](const std::string& second) {
        write("bad.csv", "t," + columns + "\n1,3,0,0,1,0,0,0\n" + second);
        return error_line("path cube.obj cube.obj --poses bad.csv");
    };
    EXPECT_EQ(error(".5,3,1,0,1,0,0,0\n"), "chasles: bad.csv: line 3: t: must increase, but is 0.5 after 1");
    EXPECT_EQ(error("1,3,1,0,1,0,0,0\n"), "chasles: bad.csv: line 3: t: must increase, but is 1 after 1");
    EXPECT_EQ(error("nan,3,1,0,1,0,0,0\n"), "chasles: bad.csv: line 3: t: not a finite number: 'nan'");
    EXPECT_EQ(error("3,1,0,1,0,0,0\n"), "chasles: bad.csv: line 3: 7 columns found, 8 expected");
    EXPECT_EQ(error(""), "chasles: bad.csv: line 2: the path has 1 pose, but needs at least two");
}

TEST_F(PathMotions, StraightWaysAreCertain) {
    for (const char* const motion : {" --motion velocity", " --motion twist"})
        for (const char* const goal : {"-1", "1"}) {
            write("way.csv", "t," + columns + "\n10,3,.3,0,1,0,0,0\n12," + goal + ",.3,0,1,0,0,0\n");
            const std::string way = text(std::string("way.csv") + motion);
            EXPECT_NE(way.find("certain   yes"), std::string::npos) << way;
        }
}

/// A quarter turn of a cube that moves; at 2 a side of it reaches the other cube. Stamps are no shares of the motion:
/// 11 is not its end.
TEST_F(PathMotions, SayWhyTheyAreUncertain) {
    const std::string way = "t," + columns + "\n10,3,.3,0,1,0,0,0\n12,";
    const std::string end = ",.3,0,0.7071067811865476,0,0,0.7071067811865476\n";
    const std::string at_the_end = "at the end of the motion";
    write("through.csv", way + "-1" + end);
    const std::string through = text("through.csv --motion velocity");
    EXPECT_NE(through.find("certain   no: a rounding error decides whether the features named here meet"),
              std::string::npos)
        << through;
    write("up_to.csv", way + "2" + end);
    const std::string up_to = text("up_to.csv --motion velocity");
    EXPECT_NE(up_to.find(at_the_end), std::string::npos) << up_to;
    write("up_to_and_on.csv", way + "2" + end + "13,-3" + end);
    const std::string on = text("up_to_and_on.csv --motion velocity");
    EXPECT_EQ(on.find(at_the_end), std::string::npos) << on;
}

} // namespace
} // namespace chasles
