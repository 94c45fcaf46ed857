// Recordings of the states of joints as paths of a robot, and numbers of messages that are not finite.
#include "tests/cli/cli_test_files.h"

#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

/// A link that turns into a cube.
class JointStates : public tests::CommandLine {
protected:
    JointStates() {
        write("arm.urdf", R"(<robot name="arm"><link name="base"/>
  <link name="arm"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.6 0.1 0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3"/></joint></robot>)");
        write("cell.json", R"({"bodies": [{"name": "cube", "mesh": "cube.obj", "pose": [-0.5, 0.5, -0.5]}]})");
    }
    [[nodiscard]] std::string command(const std::string& name, const std::string& content) const {
        write(name, content);
        return "robot arm.urdf --scene cell.json --json --path " + name;
    }
    [[nodiscard]] Json answer(const std::string& name, const std::string& content) const {
        const std::string out = run(command(name, content)).out;
        return Json::parse(out.empty() ? "{}" : out);
    }
    [[nodiscard]] double time(const std::string& name, const std::string& content) const {
        return answer(name, content).value("time", -1.0);
    }
    const std::string plain = R"({"joint_names": ["turn"], "points": [{"positions": [0], "time_from_start": 10},
        {"positions": [1.5], "time_from_start": 14}]})";
};

TEST_F(JointStates, AreAPathWithStamps) {
    const double expected = time("plain.json", plain);
    ASSERT_GT(expected, 10);
    const std::vector<std::pair<std::string, std::string>> files{
        {"echo.yaml", "header: {stamp: {sec: 10, nanosec: 0}}\nname: [turn]\nposition: [0]\nvelocity: []\n---\n"
                      "header: {stamp: {sec: 14, nanosec: 0}}\nname: [turn]\nposition: [1.5]\nvelocity: []\n---\n"},
        {"list.yaml", "- {header: {stamp: {secs: 10}}, name: [turn], position: [0]}\n"
                      "- {header: {stamp: {secs: 14}}, name: [turn], position: [1.5]}\n"},
        {"list.json", R"({"messages": [{"name": ["turn"], "position": [0], "effort": [NaN], "header": {"stamp": 10}},
                                       {"name": ["turn"], "position": [1.5], "header": {"stamp": 14}}]})"}};
    for (const auto& [name, content] : files) {
        EXPECT_NEAR(time(name, content), expected, 1e-12) << name;
        EXPECT_EQ(answer(name, content)["warnings"], Json::array()) << name;
    }
    EXPECT_NEAR(time("none.yaml", "- {name: [turn], position: [0]}\n- {name: [turn], position: [1.5]}\n"),
                (expected - 10) / 4, 1e-9)
        << "without stamps";
}

TEST_F(JointStates, AreRefusedInTheirOwnWords) {
    const std::vector<std::pair<std::string, std::string>> files{
        {"name: [turn]\nposition: [0]\n",
         "messages: a path needs at least two, and there are 1; the state before it is missing: write it as the first "
         "message, or repeat the message with a later time to ask about it at rest"},
        {"- {name: [turn], position: [0]}\n- {name: [turn], position: []}\n",
         "messages: message 2: position: 0 found, and name has 1"},
        {"- {name: [turn], position: [0]}\n- {name: [grip], position: [0]}\n",
         "messages: message 2 has other names than the first one: leave the messages of one publisher in the file"},
        {"- {name: [turn], position: [0], header: {stamp: 1}}\n- {name: [turn], position: [1]}\n",
         "messages: 1 of 2 have header: stamp"},
        {"- {name: [hip], position: [0]}\n",
         "name: the header 'hip' names no variable of the robot, which has 'turn'; fixed joints and joints that follow "
         "others have none"}};
    for (const auto& [content, message] : files)
        EXPECT_EQ(error_line(command("bad.yaml", content)), "chasles: bad.yaml: " + message);
}

/// Python's json writes them, and they are no JSON.
TEST_F(JointStates, OfMessagesNumbersThatAreNotReadMayBeNaN) {
    const double expected = time("plain.json", plain);
    const auto with = [&](const std::string& word) {
        std::string text = plain;
        const std::string added = R"("note": "a \" NaN", "effort": [)" + word + "], ";
        for (std::size_t at = 0; (at = text.find("\"time_", at)) != std::string::npos; at += added.size() + 1)
            text.insert(at, added);
        return text;
    };
    for (const char* const word : {"NaN", "Infinity", "-Infinity", "1, NaN,Infinity"})
        EXPECT_EQ(time("with.json", with(word)), expected) << word;
    for (const std::string word : {"NaN", "Infinity", "-Infinity"}) {
        std::string text = plain;
        text.replace(text.find("1.5"), 3, word);
        EXPECT_EQ(error_line(command("bad.json", text)),
                  "chasles: bad.json: points: point 2: positions: joint 1: not a finite number: '" + word + "'");
    }
    EXPECT_TRUE(error_line(command("bad.json", with("nan"))).starts_with("chasles: bad.json: is not JSON: "));
}

} // namespace
} // namespace chasles
