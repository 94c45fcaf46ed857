// Spellings of times in messages, and the state where a trajectory of MoveIt starts.
#include "tests/cli/cli_test_files.h"

#include "chasles/chasles.h"

#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

/// Two links that turn about the vertical, one after the other, beside a cube.
class TrajectoryMessages : public tests::CommandLine {
protected:
    TrajectoryMessages() {
        write("arm.urdf", R"(<robot name="arm"><link name="base"/>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.6 0.1 0.1"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.6 0.1 0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3"/></joint>
  <joint name="bend" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3"/></joint></robot>)");
        write("cell.json", R"({"bodies": [{"name": "ball", "sphere": 0.1, "pose": [1.12, 0.6, 0]}]})");
        write("falling.json",
              R"({"bodies": [{"name": "ball", "sphere": 0.1, "pose": [0, 0.5, 5], "goal": [0, 0.5, -5]}]})");
    }
    [[nodiscard]] std::string command(const std::string& path, const std::string& scene = "cell.json") const {
        write("path.json", path);
        return "robot arm.urdf --json --scene " + scene + " --path path.json";
    }
    [[nodiscard]] Json answer(const std::string& path, const std::string& scene = "cell.json") const {
        const auto finished = run(command(path, scene));
        return Json::parse(finished.out.empty() ? "{}" : finished.out);
    }
    [[nodiscard]] std::string refusal(const std::string& path) const { return error_line(command(path)); }

    /// From 0 to a quarter turn in a second; then at rest until the third point, at this time.
    static std::string timed(const std::string& last) {
        return R"({"joint_names": ["turn", "bend"], "points": [{"positions": [0, 0], "time_from_start": 0},
            {"positions": [1.5707963, 0], "time_from_start": 1}, {"positions": [1.5707963, 0], "time_from_start": )" +
               last + "}]}";
    }
    static std::string recorded(const std::string& last) {
        return R"([{"name": ["turn", "bend"], "position": [0, 0], "header": {"stamp": {"sec": 0}}},
            {"name": ["turn", "bend"], "position": [1.5707963, 0], "header": {"stamp": {"sec": 1}}},
            {"name": ["turn", "bend"], "position": [1.5707963, 0], "header": {"stamp": )" +
               last + "}}]";
    }
    /// A trajectory of the first joint, which starts in a state.
    static std::string started(const std::string& state, const std::string& key = "trajectory_start") {
        return R"({"trajectory": [{"joint_trajectory": {"joint_names": ["turn"],
            "points": [{"positions": [0.1]}, {"positions": [0]}]}}], ")" +
               key + "\": " + state + "}";
    }
};

/// The ball falls through the plane of the arm at the middle of all times. A lost fraction moves the middle.
TEST_F(TrajectoryMessages, TimesHaveEverySpelling) {
    const Json expected = answer(timed("2.9"), "falling.json");
    ASSERT_EQ(expected["verdict"], "contact");
    for (const char* const seconds : {"sec", "secs"})
        for (const char* const nanoseconds : {"nanosec", "nanosecs", "nsec", "nsecs"}) {
            const std::string time = Json{{seconds, 2}, {nanoseconds, 900000000}}.dump();
            for (const std::string& path : {timed(time), recorded(time)}) {
                const Json found = answer(path, "falling.json");
                ASSERT_TRUE(found.contains("time")) << path << found;
                EXPECT_NEAR(found["time"].get<double>(), expected["time"].get<double>(), 1e-9) << path;
            }
        }
}

TEST_F(TrajectoryMessages, TimesHaveNoOtherKeys) {
    const std::string keys = "a time has sec or secs, and nanosec, nanosecs, nsec or nsecs";
    const std::vector<std::pair<std::string, std::string>> times{
        {R"({"sec": 2, "nanoseconds": 5})", "unknown key 'nanoseconds'; " + keys},
        {R"({"sec": 2, "ns": 5})", "unknown key 'ns'; " + keys},
        {R"({"seconds": 2, "nanosec": 5})", "unknown key 'seconds'; " + keys},
        {R"({"sec": 2, "secs": 5})", "has two of 'sec, secs': leave one"},
        {R"({"sec": 2, "nsec": 5, "nanosec": 5})", "has two of 'nanosec, nanosecs, nsec, nsecs': leave one"},
        {"{}", "is empty; " + keys}};
    for (const auto& [time, why] : times) {
        EXPECT_EQ(refusal(timed(time)), "chasles: path.json: points: point 3: time_from_start: " + why);
        EXPECT_EQ(refusal(recorded(time)), "chasles: path.json: messages: message 3: header: stamp: " + why);
    }
}

TEST_F(TrajectoryMessages, KeysThatAreNotReadGiveAWarning) {
    EXPECT_EQ(answer(R"({"joint_names": ["turn", "bend"], "points": [{"positions": [0, 0], "time": 1, "effort": []},
                         {"positions": [0, 0.1], "time": 2}]})")["warnings"],
              Json({"path.json: points: ignored keys: 'time'"}));
    EXPECT_EQ(answer(R"([{"name": ["turn", "bend"], "position": [0, 0], "header": {"seq": 1, "time": 1}},
                         {"name": ["turn", "bend"], "position": [0, 0.1], "t": 2}])")["warnings"],
              Json({"path.json: messages: ignored keys: 'header: time, message: t'"}));
}

/// With the second joint at a quarter turn the lower link reaches the ball. The same path with a column for it agrees.
TEST_F(TrajectoryMessages, JointsThatAreLeftOutHaveTheValuesOfTheStart) {
    const std::string both = R"({"joint_names": ["turn", "bend"], "points": [{"positions": [0.1, 1.5707963]},
        {"positions": [0, 1.5707963]}]})";
    const Json expected = answer(both);
    ASSERT_EQ(expected["verdict"], "contact");
    ASSERT_EQ(answer(started("{}"))["verdict"], "clear");
    for (const char* const key : {"trajectory_start", "start_state", "sequence_start"}) {
        const Json found = answer(started(R"({"joint_state": {"name": ["turn", "bend", "wheel"],
            "position": [0.1, 1.5707963, 7]}})",
                                          key));
        for (const char* const member : {"verdict", "time", "pair", "configuration"})
            EXPECT_EQ(found[member], expected[member]) << key;
        EXPECT_EQ(found["warnings"],
                  Json({"path.json: joint_names: ignored joints: 'wheel'; the robot has no variables of these names",
                        std::string("path.json: joint_names: 'bend' stays at 1.5707963, its value in ") + key}));
    }
}

TEST_F(TrajectoryMessages, TheStartSaysWhatIsNotTested) {
    const Json found = answer(started(R"({"joint_state": {"name": ["turn", "bend"], "position": [0.5, 0]},
        "attached_collision_objects": [{"link_name": "lower"}]})"));
    EXPECT_EQ(found["warnings"],
              Json({"path.json: trajectory_start: attached_collision_objects: are not read; --attach adds a part",
                    "path.json: trajectory_start: 'turn' is 0.5, and the first point has 0.1: the way between them is "
                    "not tested",
                    "path.json: joint_names: 'bend' stays at 0, its value in trajectory_start"}));
}

TEST_F(TrajectoryMessages, AStartThatMovesTheBaseIsRefused) {
    const auto at = [](const std::string& place) {
        return started(R"({"multi_dof_joint_state": {"joint_names": ["world_joint"], "transforms": [{"translation": )" +
                       place + R"(, "rotation": {"x": 0, "y": 0, "z": 0, "w": 1}}]}})");
    };
    EXPECT_EQ(answer(at(R"({"x": 0, "y": 0, "z": 0})"))["verdict"], "clear");
    EXPECT_EQ(refusal(at(R"({"x": 2, "y": 0, "z": 0})")),
              "chasles: path.json: trajectory_start: multi_dof_joint_state: the base of the robot is not where "
              "'world_joint' puts it; give this pose by --base, or take it out of the file");
    EXPECT_EQ(run(command(at(R"({"x": 2, "y": 0, "z": 0})")) + " --base 2,0,0").status, 0);
}

TEST_F(TrajectoryMessages, AStartIsRefusedInOneLine) {
    EXPECT_EQ(refusal(started(R"({"joint_state": {"name": ["bend"], "position": []}})")),
              "chasles: path.json: trajectory_start: joint_state: position: 0 found, and name has 1");
    EXPECT_EQ(refusal(started(R"({"joint_state": {"name": ["bend"], "position": [NaN]}})")),
              "chasles: path.json: trajectory_start: joint_state: position: 'bend': not a finite number: 'NaN'");
    EXPECT_EQ(
        refusal(R"({"a": )" + started(R"({"joint_state": {"name": ["bend"], "position": [0]}})") +
                R"(, "start_state": {"joint_state": {"name": ["bend"], "position": [1]}}})"),
        "chasles: path.json: has 2 states where a trajectory may start (trajectory_start, start_state): leave one "
        "in the file");
}

/// Goals of controllers have an empty one.
TEST_F(TrajectoryMessages, AnEmptyTrajectoryOfOtherJointsCountsForNothing) {
    const std::string goal = R"({"trajectory": {"joint_names": ["turn"], "points": [{"positions": [0.1]},
        {"positions": [0]}]}, "multi_dof_trajectory": {"joint_names": [NAMES], "points": []}})";
    const auto with = [&](const std::string& names) {
        std::string text = goal;
        return text.replace(text.find("NAMES"), 5, names);
    };
    EXPECT_EQ(answer(with(""))["verdict"], "clear");
    EXPECT_EQ(refusal(with("\"base\"")),
              "chasles: path.json: multi_dof_trajectory: is not read; a table of columns can "
              "hold its joints");
}

} // namespace
} // namespace chasles
