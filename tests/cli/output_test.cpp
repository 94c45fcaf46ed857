// What the command line writes: no input is overwritten, a cut run leaves the file of before, and rows are gone on
// from.
#include "tests/cli/cli_test_files.h"

#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <map>

namespace chasles {
namespace {

constexpr const char* columns = "x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1\n";
constexpr const char* hits = ".25,.5,3,1,0,0,0,.25,.5,-1,1,0,0,0\n";
constexpr const char* long_turn = "2.45,0,0,1,0,0,0,2.45,0,0,.1,0,0,1\n"; // by 169 degrees

class Output : public tests::CommandLine {
protected:
    Output() {
        write("motions.csv", std::string(columns) + hits);
        write("scene.json", R"({"bodies": [{"name": "table", "mesh": "in_scene.obj", "scale": 4, "pose": [-2, -2, -4]},
                                           {"name": "box", "mesh": "cube.obj", "pose": [0, 0, 1]}]})");
        write("goals.csv", "t,x,y,z,qw,qx,qy,qz\n0,0,0,1,1,0,0,0\n1,0,0,2,1,0,0,0\n");
        write("path.csv", "turn\n0\n1\n");
        write("arm.urdf", R"(<robot name="arm">
          <link name="base"><collision><geometry><mesh filename="in_robot.obj"/></geometry></collision></link>
          <link name="tip"/><joint name="turn" type="continuous"><parent link="base"/><child link="tip"/></joint></robot>)");
        write("arm.srdf", R"(<robot name="arm"/>)");
        for (const char* const copy : {"in_scene.obj", "in_robot.obj"})
            write(copy, content("cube.obj"));
    }
    [[nodiscard]] std::string content(const std::string& file) const {
        std::ifstream stream(path(file), std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    /// The content of all files, by name.
    [[nodiscard]] std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> files;
        for (const auto& file : std::filesystem::directory_iterator(path("")))
            if (const std::string name = file.path().filename(); file.is_regular_file() && !name.starts_with("std"))
                files[name] = content(name);
        return files;
    }
};

/// A command that ends with an option for an output, and the files that it reads.
struct Writer {
    std::string command;
    std::vector<std::string> inputs;
};

const std::vector<Writer> writers{
    {"view cube.obj cube.obj --start 3,0,0 --goal 2,0,0 --out ", {"cube.obj"}},
    {"batch cube.obj in_scene.obj --motions motions.csv --out ", {"cube.obj", "in_scene.obj", "motions.csv"}},
    {"scene scene.json --page ", {"scene.json", "cube.obj", "in_scene.obj"}},
    {"drag scene.json --body box --goals goals.csv --out ", {"scene.json", "cube.obj", "in_scene.obj", "goals.csv"}},
    {"drag scene.json --body box --goals goals.csv --out rows.csv --page ",
     {"scene.json", "in_scene.obj", "goals.csv"}},
    {"robot arm.urdf --srdf arm.srdf --path path.csv --scene scene.json --page ",
     {"arm.urdf", "arm.srdf", "path.csv", "scene.json", "in_scene.obj", "in_robot.obj"}},
    {"acm arm.urdf --srdf arm.srdf --out ", {"arm.urdf", "arm.srdf", "in_robot.obj"}}};

TEST_F(Output, NeverReplacesAnInput) {
    std::filesystem::create_directory(path("folder"));
    const auto before = files();
    for (const auto& [command, inputs] : writers)
        for (const std::string& input : inputs) {
            std::filesystem::create_symlink(path(input), path("link"));
            std::filesystem::create_hard_link(path(input), path("other_name"));
            for (const std::string& name :
                 {input, "folder/../" + input, std::string("link"), std::string("other_name")})
                EXPECT_EQ(error_line(command + name),
                          "chasles: " + name + ": is an input of this command; give the output another name")
                    << command;
            std::filesystem::remove(path("link"));
            std::filesystem::remove(path("other_name"));
            EXPECT_EQ(files(), before) << command << input;
        }
}

TEST_F(Output, NeverReplacesAnInputThatIsNamedLikeAPart) {
    for (const auto& [command, inputs] : writers)
        for (const std::string& input : inputs) {
            std::filesystem::create_symlink(path(input), path("out.part"));
            EXPECT_EQ(error_line(command + "out"),
                      "chasles: out.part: is an input of this command; give the output another name")
                << command;
            std::filesystem::remove(path("out.part"));
        }
    const std::string mesh = content("in_robot.obj");
    std::filesystem::create_symlink(path("in_robot.obj"), path("out.part"));
    EXPECT_EQ(run("scene scene.json --page out").status, 2) << "no link is followed";
    EXPECT_EQ(content("in_robot.obj"), mesh);
}

TEST_F(Output, TheMeshesOfTheDemoNeedTheirFolder) {
    EXPECT_EQ(error_line("demo --save /no/such/folder"),
              "chasles: /no/such/folder/bolt.obj: cannot be written: No such file or directory");
}

TEST_F(Output, ADashIsNoFile) {
    for (const std::string command :
         {"scene scene.json --matrix --csv ", "scene scene.json --matrix --plot ", "scene scene.json --page ",
          "drag scene.json --body box --goals goals.csv --out "})
        EXPECT_EQ(error_line(command + "-"),
                  "chasles: -: is no file: name a file, ./- for one of this name, or /dev/stdout");
    EXPECT_FALSE(std::filesystem::exists(path("-")));
    EXPECT_NE(run("scene scene.json --matrix --csv ./-").status, 2);
    EXPECT_TRUE(std::filesystem::exists(path("-")));
}

TEST_F(Output, EachHasANameOfItsOwn) {
    write("rows.csv", "precious");
    std::filesystem::create_symlink(path("rows.csv"), path("link"));
    for (const std::string page : {"rows.csv", "./rows.csv", "link"})
        EXPECT_EQ(error_line("drag scene.json --body box --goals goals.csv --out rows.csv --page " + page),
                  "chasles: " + page + ": is named by two options; give each output a name of its own");
    EXPECT_EQ(content("rows.csv"), "precious");
    for (const std::string page : {"new.csv", "./new.csv", "new.csv.part"})
        EXPECT_EQ(error_line("drag scene.json --body box --goals goals.csv --out new.csv --page " + page),
                  "chasles: " + page + ": is named by two options; give each output a name of its own");
    EXPECT_EQ(error_line("scene scene.json --page ''"), "chasles: --page: is empty, but takes FILE");
}

TEST_F(Output, ReplacesTheFileBehindALinkAndKeepsItsMode) {
    write("rows.csv", "old");
    std::filesystem::permissions(path("rows.csv"), std::filesystem::perms(0640));
    std::filesystem::create_symlink("rows.csv", path("link"));
    EXPECT_EQ(run("drag scene.json --body box --goals goals.csv --out link").status, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
    EXPECT_TRUE(content("rows.csv").starts_with("t,x,y,z"));
    EXPECT_EQ(std::filesystem::status(path("rows.csv")).permissions(), std::filesystem::perms(0640));
    EXPECT_FALSE(std::filesystem::exists(path("rows.csv.part")));
}

TEST_F(Output, ALimitOfFileSizesLeavesTheFileOfBefore) {
    for (const auto& [command, inputs] : writers) {
        if (command.starts_with("acm") || command.starts_with("batch"))
            continue; // a block is enough for these
        write("out", "precious");
        const auto finished = run("--version; ulimit -f 1; " CHASLES_EXECUTABLE " " + command + "out > /dev/null");
        const bool fits = finished.status < 2; // the rows of a hand
        EXPECT_TRUE(fits || finished.err == "chasles: out: cannot be written: File too large\n") << finished.err;
        EXPECT_EQ(content("out") == "precious", !fits) << command;
        EXPECT_FALSE(std::filesystem::exists(path("out.part"))) << command;
        EXPECT_EQ(fits, command.ends_with("--out ") && command.starts_with("drag")) << command;
    }
}

TEST_F(Output, AClosedStandardOutputIsNoFile) {
    for (const char* const closed : {" >&-", " <&- >&-", " <&- >&- 2>&-"}) {
        const auto finished = run("batch cube.obj cube.obj --motions motions.csv --out out.csv" + std::string(closed));
        EXPECT_EQ(finished.status, 2) << closed;
        EXPECT_EQ(std::ranges::count(content("out.csv"), '\n'), 2) << content("out.csv");
        std::filesystem::remove(path("out.csv"));
    }
}

TEST_F(Output, AKillLeavesTheFileOfBefore) {
    std::string motions = columns;
    for (int i = 0; i < 300; ++i)
        motions += long_turn;
    write("motions.csv", motions + hits);
    const std::string batch = "batch cube.obj cube.obj --motions motions.csv --max-turn-deg .05 --out ";
    ASSERT_EQ(run(batch + "whole.csv").status, 1);
    write("out.csv", "precious");
    EXPECT_EQ(run(batch +
                  "out.csv & pid=$!; while ! grep -qs clear out.csv.part; do sleep .02; done; kill -9 $pid; wait $pid")
                  .status,
              137);
    EXPECT_EQ(content("out.csv"), "precious");
    EXPECT_EQ(error_line(batch + "out.csv"),
              "chasles: out.csv.part: is left by a run that was cut; go on from it with --resume, or remove it");
    std::ofstream(path("out.csv.part"), std::ios::app) << "299,cle"; // a torn row
    EXPECT_EQ(run(batch + "out.csv --resume").status, 1);
    EXPECT_EQ(content("out.csv"), content("whole.csv"));
    EXPECT_FALSE(std::filesystem::exists(path("out.csv.part")));
}

TEST_F(Output, GoesOnFromTheRowsOfTheSameQuestionOnly) {
    std::string motions = std::string("id,") + columns + "a," + hits + "b,1\nc," + hits;
    write("motions.csv", motions);
    const std::string batch = "batch cube.obj cube.obj --motions motions.csv --out ";
    ASSERT_EQ(run(batch + "whole.csv").status, 2) << "row b cannot be read";
    const std::string whole = content("whole.csv");
    const auto resumed = [&](const std::string& kept, const std::string& options = "") {
        write("out.csv.part", kept);
        const auto finished = run(batch + "out.csv --resume" + options);
        return finished.err.substr(0, finished.err.find('\n'));
    };
    const std::string unreadable =
        "chasles: motions.csv: 1 of 3 rows cannot be read; the first: line 3: 2 columns found, "
        "15 expected";
    const std::size_t third = whole.rfind("c,");
    for (const std::string& kept :
         {std::string(), whole.substr(0, 10), whole.substr(0, third), whole.substr(0, third + 9), whole})
        EXPECT_EQ(resumed(kept), unreadable) << kept;
    EXPECT_EQ(content("out.csv"), whole);

    const auto other = [&](int line) {
        return fmt::format(
            "chasles: out.csv.part: line {}: answers another question than this; remove the file to begin anew", line);
    };
    EXPECT_EQ(resumed(whole, " --margin .5"), other(2));
    EXPECT_EQ(resumed("id,verdict\n"), other(1));
    EXPECT_EQ(resumed(whole + "d,clear,,,,,,,,,,,,,,\n"), other(5));
    std::string renamed = whole;
    renamed[third] = 'x';
    EXPECT_EQ(resumed(renamed), other(4));
    EXPECT_EQ(content("out.csv.part"), renamed) << "what is refused stays";
}

/// Rows of clear motions are the same for all motions between poses.
TEST_F(Output, GoesOnFromRowsOfTheSameMotionOnly) {
    const std::string misses = "0,0,9,1,0,0,0,1,0,9,1,0,0,0\n";
    write("motions.csv", std::string("id,") + columns + "a," + misses + "b," + hits + "c," + misses + "d," + misses);
    const std::string batch = "batch cube.obj cube.obj --motions motions.csv --out ";
    ASSERT_EQ(run(batch + "whole.csv").status, 1);
    const std::string whole = content("whole.csv");
    write("out.csv.part", whole.substr(0, whole.rfind("d,")));
    EXPECT_EQ(error_line(batch + "out.csv --resume --motion twist"),
              "chasles: out.csv.part: line 3: answers another question than this; remove the file to begin anew");
    EXPECT_EQ(run(batch + "out.csv --resume").status, 1);
    EXPECT_EQ(content("out.csv"), whole);
}

} // namespace
} // namespace chasles
