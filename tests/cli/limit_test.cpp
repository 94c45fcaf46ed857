// --seconds: an answer in time, with what is proven.
#include "tests/cli/cli_test_files.h"

#include "tests/support/grid.h"

#include <chrono>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

class Heartbeat : public tests::CommandLine {};

/// Each command, also one that counts nothing: here it waits for a file that comes late.
TEST_F(Heartbeat, ASlowCommandSaysThatItIsAtWork) {
    const tests::Finished found =
        run("--version; mkfifo late.obj; (sleep 6; echo > late.obj) & '" CHASLES_EXECUTABLE "' info late.obj");
    EXPECT_NE(found.err.find("chasles: progress: at work for 5 s\n"), std::string::npos) << found.err;
}

/// Two sheets of triangles that slide past each other at a billionth of their size: takes many seconds.
class Seconds : public tests::CommandLine {
protected:
    Seconds() {
        constexpr std::uint32_t n = 160;
        std::string mesh;
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t j = 0; j <= n; ++j)
                mesh += fmt::format("v {} {} 0\n", double(i) / n, double(j) / n);
        for (const auto& face : test::grid_triangles(n, n))
            mesh += fmt::format("f {} {} {}\n", face[0] + 1, face[1] + 1, face[2] + 1);
        write("sheet.obj", mesh);
        write("scene.json", R"({"bodies": [{"name": "lower", "mesh": "sheet.obj"},
            {"name": "upper", "mesh": "sheet.obj", "pose": [0, 0.1, 1e-9], "goal": [0.4, 0.1, 1e-9, 0.92, 0, 0, 0.39]}]})");
        write("motions.csv", "id,x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1\n"
                             "quick,0,0,9,1,0,0,0,0,0,8,1,0,0,0\nslow,0,.1,1e-9,1,0,0,0,.4,.1,1e-9,.92,0,0,.39\n");
    }
    /// Expects exit status 3 in time.
    [[nodiscard]] tests::Finished stopped(const std::string& arguments) const {
        const auto start = std::chrono::steady_clock::now();
        tests::Finished finished = run(arguments + " --seconds 0.1");
        EXPECT_EQ(finished.status, 3) << arguments << finished.out << finished.err;
        EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 3) << arguments;
        return finished;
    }
};

const std::string bodies = "sheet.obj sheet.obj ";
const std::string motion = "--start 0,.1,1e-9 --goal \"0.4 .1 1e-9 .92 0 0 .39\" --motion velocity";

TEST_F(Seconds, ACertificateIsWholeOrNotWritten) {
    const std::string slide = "check sheet.obj sheet.obj --start \"0 0.1 1e-9\" --goal \"0.4 0.1 1e-9 0.92 0 0 0.39\" ";
    const tests::Finished finished = stopped(slide + "--certificate a.cert --json");
    EXPECT_NE(finished.err.find("chasles: a.cert: not written: the time of --seconds was over\n"), std::string::npos)
        << finished.err;
    EXPECT_TRUE(Json::parse(finished.out)["certificate"]["file"].is_null());
    EXPECT_FALSE(std::filesystem::exists(path("a.cert")));
}

TEST_F(Seconds, AnswersSayWhatIsProven) {
    for (const std::string& question : {"check " + bodies + motion, std::string("scene scene.json")}) {
        EXPECT_TRUE(stopped(question).out.starts_with("UNKNOWN: the time was over; ")) << question;
        const Json answer = Json::parse(stopped(question + " --json").out);
        EXPECT_EQ(answer["verdict"], "unknown");
        EXPECT_FALSE(answer.contains("contacts"));
        EXPECT_LT(answer["clear_until"].get<double>(), 1);
    }
    EXPECT_EQ(Json::parse(stopped("scene scene.json --all --json").out)["verdict"], "unknown");
}

/// A bracket that the limit has cut says so.
TEST_F(Seconds, ClearancesSayThatTheTimeWasOver) {
    write("sheets.urdf", R"(<robot name="sheets"><link name="world"/>
        <link name="upper"><collision><origin xyz="0 0.1 1e-9"/><geometry><mesh filename="sheet.obj"/></geometry></collision></link>
        <joint name="turn" type="revolute"><parent link="world"/><child link="upper"/><axis xyz="0 0 1"/>
        <limit lower="-9" upper="9"/></joint></robot>)");
    write("floor.json", R"({"bodies": [{"name": "lower", "mesh": "sheet.obj"}]})");
    write("turn.csv", "turn\n0\n1\n");
    for (const std::string& question :
         {"clearance " + bodies + motion,
          std::string("robot sheets.urdf --clearance --path turn.csv --scene floor.json")}) {
        const Json bracket = Json::parse(stopped(question + " --json").out);
        EXPECT_EQ(bracket["verdict"], "unknown");
        EXPECT_EQ(bracket["distance"], 0);
        EXPECT_GE(bracket["distance_upper"].get<double>(), 1e-9);
        const std::string text = stopped(question).out;
        EXPECT_TRUE(text.starts_with("NO CLEARANCE PROVEN: the time was over; at most ")) << text;
        EXPECT_NE(text.find("certain   no: the time was over, and the bracket of the distance is wider"),
                  std::string::npos)
            << text;
    }
    EXPECT_FALSE(Json::parse(run("clearance cube.obj cube.obj --start 3,0,0 --goal 2,0,0 --json --seconds 100").out)
                     .contains("verdict"));
}

/// What comes before the segment that takes too long is proven.
TEST_F(Seconds, APathSaysWhichSegmentsAreProven) {
    const std::string rows = ",0,0,9,1,0,0,0\n,0,0,8,1,0,0,0\n,0,.1,1e-9,1,0,0,0\n,.4,.1,1e-9,.92,0,0,.39\n";
    std::string plain = "x,y,z,qw,qx,qy,qz\n", stamped = "t,x,y,z,qw,qx,qy,qz\n";
    int stamp = -40;
    for (std::size_t at = 0; at < rows.size(); at = rows.find('\n', at) + 1) {
        const std::string row = rows.substr(at, rows.find('\n', at) - at);
        plain += row.substr(1) + "\n";
        stamped += fmt::format("{}{}\n", stamp += 10, row);
    }
    write("plain.csv", plain);
    write("stamped.csv", stamped);
    const std::string path = "path " + bodies + "--motion velocity --poses ";
    const std::string text = stopped(path + "plain.csv").out;
    EXPECT_TRUE(text.starts_with("UNKNOWN: the time was over; proven that nothing touches before ")) << text;
    EXPECT_NE(text.find(" segment "), std::string::npos) << text;
    const Json answer = Json::parse(stopped(path + "plain.csv --json").out);
    EXPECT_EQ(answer["verdict"], "unknown");
    EXPECT_GE(answer["segment"], 1);
    const std::string held = stopped(path + "plain.csv --margin 5e-10 --hold 1e-10").out;
    EXPECT_NE(held.find("nothing comes within 1e-10, or nearer than at the start if that is less, before "),
              std::string::npos)
        << "bodies that are held may be within the margin: " << held;
    const std::string stamps = stopped(path + "stamped.csv --margin 1e-10").out;
    EXPECT_TRUE(stamps.starts_with("UNKNOWN: the time was over; proven that nothing comes within 1e-10 before t = -"))
        << "all stamps are negative: " << stamps;
}

/// A page without an answer would look like that of a clear one.
TEST_F(Seconds, NoPageShowsWhatIsUnknown) {
    write("page.html", "precious");
    for (const std::string& question :
         {"view " + bodies + motion + " --out page.html", std::string("scene scene.json --page page.html")}) {
        const tests::Finished finished = stopped(question);
        EXPECT_TRUE(finished.out.starts_with("UNKNOWN: the time was over; ")) << finished.out;
        EXPECT_EQ(finished.out.find("page.html"), std::string::npos) << finished.out;
        std::ifstream page(path("page.html"));
        EXPECT_EQ(std::string(std::istreambuf_iterator<char>(page), {}), "precious");
    }
}

TEST_F(Seconds, RowsOfABatchStay) {
    const std::string batch = "batch " + bodies + "--motions motions.csv --motion velocity --out out.csv";
    EXPECT_EQ(
        stopped(batch).err,
        "chasles: the time was over: 1 of 2 motions are answered, in out.csv.part; --resume goes on from there\n");
    std::ifstream rows(path("out.csv.part"));
    std::string text{std::istreambuf_iterator<char>(rows), {}};
    EXPECT_TRUE(text.ends_with("\nquick,clear,,,,,,,,,,,,,,\n")) << text;
}

TEST_F(Seconds, ChangesNoAnswerThatComesInTime) {
    const std::string question = "check cube.obj cube.obj --start 3,0,0 --goal 0.5,0,0 --json";
    EXPECT_EQ(run(question + " --seconds 100").out, run(question).out);
    EXPECT_EQ(error_line(question + " --seconds 0"), "chasles: --seconds: must be positive");
}

} // namespace
} // namespace chasles
