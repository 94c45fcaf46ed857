// Every error ends with exit status 2 and one line that names the input, the place and the reason.
#include "tests/cli/cli_test_files.h"

namespace chasles {
namespace {

class Errors : public tests::CommandLine {
protected:
    const std::string poses = " --start '3 0 0' --goal '0 0 0'";

    [[nodiscard]] std::string mesh_error(const std::string& name, const std::string& content) const {
        write(name, content);
        return error_line("check " + name + " cube.obj" + poses);
    }
    [[nodiscard]] std::string pose_error(const std::string& pose) const {
        return error_line("check cube.obj cube.obj --goal '0 0 0' --start '" + pose + "'");
    }
};

TEST_F(Errors, MissingFile) {
    EXPECT_EQ(error_line("check cube.obj no.obj" + poses), "chasles: no.obj: no such file");
}

TEST_F(Errors, Folder) {
    EXPECT_EQ(error_line("info ."), "chasles: .: is a directory, not a file");
}

TEST_F(Errors, DeviceWithoutEnd) {
    EXPECT_EQ(error_line("info /dev/zero"),
              "chasles: /dev/zero: is a device, which need not end; give a file or a pipe");
    EXPECT_EQ(error_line("path cube.obj cube.obj --poses /dev/zero"),
              "chasles: /dev/zero: is a device, which need not end; give a file or a pipe");
}

TEST_F(Errors, EmptyFile) {
    EXPECT_EQ(mesh_error("empty.stl", ""), "chasles: empty.stl: is empty");
}

TEST_F(Errors, TruncatedFile) {
    EXPECT_EQ(mesh_error("part.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"),
              "chasles: part.off: line 4: the file ends before vertex 2 of the 3 announced");
    EXPECT_EQ(mesh_error("part.stl", std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(50, '\0')),
              "chasles: part.stl: is truncated: 2 triangles are announced, but 1 are present");
}

TEST_F(Errors, NotANumber) {
    EXPECT_EQ(mesh_error("nan.obj", "v 0 0 0\nv 1 nan 0\n"),
              "chasles: nan.obj: line 2: a vertex needs three finite numbers: 'v 1 nan 0'");
}

TEST_F(Errors, IndexOutOfRange) {
    EXPECT_EQ(mesh_error("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
              "chasles: far.obj: line 4: vertex index 9 is out of range; there are 3 vertices");
}

TEST_F(Errors, FaceThatCrossesItself) {
    const std::string line = mesh_error("tie.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n");
    EXPECT_EQ(line,
              "chasles: tie.obj: line 5: face 0: has no area beyond rounding (its outline crosses itself or turns "
              "back); the option triangulate accepts it");
    EXPECT_EQ(run("info tie.obj --triangulate").status, 0);
}

TEST_F(Errors, PolygonThatIsNotPlanar) {
    const std::string line = mesh_error("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4\n");
    EXPECT_TRUE(line.starts_with("chasles: bent.obj: line 5: face 0: ")) << line;
    const auto cut = run("check bent.obj cube.obj --triangulate" + poses);
    EXPECT_NE(cut.status, 2);
    EXPECT_TRUE(cut.err.starts_with("chasles: warning: bent.obj: 1 polygon leaves its plane by ")) << cut.err;
}

TEST_F(Errors, OptionsWithoutTheirNumbers) {
    EXPECT_EQ(error_line("check cube.obj cube.obj --start= --goal=-1,.2,.3"),
              "chasles: --start: is empty, but takes POSE");
    EXPECT_EQ(error_line("check cube.obj cube.obj --start '' --goal '3 0 0'"),
              "chasles: --start: is empty, but takes POSE");
    EXPECT_EQ(error_line("check cube.obj cube.obj --margin=" + poses), "chasles: --margin: is empty, but takes D");
}

TEST_F(Errors, ACentreMovesStraight) {
    const std::string check = "check cube.obj cube.obj" + poses;
    const std::string right = "chasles: --centre: is for --motion sweep and --motion velocity, but the motion is a ";
    EXPECT_EQ(error_line(check + " --centre 1,2,3"), right + "screw");
    EXPECT_EQ(error_line(check + " --motion twist --centre -1 -2 -3"), right + "twist");
    EXPECT_NE(run(check + " --motion sweep --centre 1,2,3").status, 2);
    EXPECT_NE(run(check + " --motion velocity --centre -1 -2 -3").status, 2);
    EXPECT_EQ(error_line(check + " --motion velocity --centre 1 2"),
              "chasles: --centre: 2 numbers found; a point has 3 (x y z)");
}

TEST_F(Errors, ACentreOfTheFixedBodyIsForTwoBodiesAtConstantVelocity) {
    const std::string check = "check cube.obj cube.obj" + poses;
    const std::string both = check + " --fixed-start 0 0 0 --fixed-goal 0 0 1 --fixed-centre -1 -2 -3 --motion ";
    for (const std::string motion : {"screw", "sweep", "twist"})
        EXPECT_EQ(error_line(both + motion),
                  "chasles: --fixed-centre: is for --motion velocity, but the motion is a " + motion);
    EXPECT_NE(run(both + "velocity").status, 2);
    EXPECT_EQ(error_line(check + " --motion velocity --fixed-centre 1 2 3"),
              "chasles check: --fixed-centre requires --fixed-start (see chasles check --help)");
}

TEST_F(Errors, Poses) {
    EXPECT_EQ(pose_error("1 2"), "chasles: --start: 2 numbers found; a pose has 3 (x y z), 7 (x y z qw qx qy qz) "
                                 "or 16 (4x4, row by row)");
    EXPECT_EQ(pose_error("1 2 nan"), "chasles: --start: not a finite number: 'nan'");
    EXPECT_TRUE(pose_error("1 2 3 0 0 0 0").starts_with("chasles: --start: pose: quaternion: "));
    EXPECT_TRUE(pose_error("2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1").starts_with("chasles: --start: pose: matrix: "));
    EXPECT_EQ(error_line("check cube.obj cube.obj --goal 0 0 0 --start -nan 0 0"),
              "chasles: --start: not a finite number: '-nan'");
}

TEST_F(Errors, OptionsOutOfRange) {
    const std::string check = "check cube.obj cube.obj" + poses;
    EXPECT_TRUE(error_line(check + " --margin -.1").starts_with("chasles: query: margin: "));
    EXPECT_EQ(error_line(check + " --margin nan"), "chasles: --margin: not a finite number: 'nan'");
    EXPECT_TRUE(error_line(check + " --hold 1").starts_with("chasles: query: hold: "));
    EXPECT_TRUE(error_line(check + " --margin 1 --hold 1").starts_with("chasles: query: hold: "));
    EXPECT_TRUE(error_line(check + " --max-turn-deg 0").starts_with("chasles: motion: max_turn: "));
    EXPECT_EQ(error_line(check + " --max-turn-deg 181"),
              "chasles: --max-turn-deg: must be at most 180, which leaves a screw in one piece");
    EXPECT_TRUE(error_line(check + " --time-tolerance 2").starts_with("chasles: query: time_tolerance: "));
    EXPECT_EQ(error_line(check + " --max-turn-deg '1 2'"), "chasles: --max-turn-deg: needs one number");
    EXPECT_EQ(error_line(check + " --motion twist --max-turn-deg 10"),
              "chasles: --max-turn-deg: is for --motion screw, but the motion is a twist");
}

/// The parser of the command line would leave an empty entry out.
TEST_F(Errors, EmptyEntriesOfLists) {
    const std::string is_empty = ": an entry before or after a comma is empty";
    for (const std::string list : {"1.2,,1.5", ",1.2", "1.2,", ","})
        EXPECT_EQ(error_line("profile cube.obj cube.obj" + poses + " --margins " + list),
                  "chasles: --margins: '" + list + "'" + is_empty);
    EXPECT_EQ(error_line("profile cube.obj cube.obj" + poses + " --margins=1,,2"),
              "chasles: --margins: '1,,2'" + is_empty);
    EXPECT_EQ(error_line("profile cube.obj cube.obj" + poses + " --margins 1 '2, ,3'"),
              "chasles: --margins: '2,,3'" + is_empty);
    for (const std::string list : {"1,", ",1", "1,,2"})
        EXPECT_EQ(error_line("check cube.obj cube.obj" + poses + " --radius " + list),
                  "chasles: --radius: a number is missing before or after a comma");
    write("table.urdf", "<robot name=\"t\"><link name=\"a\"/></robot>");
    for (const std::string list : {"a,", ",a", ","})
        EXPECT_TRUE(error_line("robot table.urdf --allow " + list).starts_with("chasles: --allow: ")) << list;
    for (const std::string given : {"a,,'0 0 0'", ",cube.obj,'0 0 0'", "a,cube.obj,"})
        EXPECT_TRUE(error_line("robot table.urdf --attach " + given).starts_with("chasles: --attach: ")) << given;
    for (const std::string given : {"=folder", "name=", "="})
        EXPECT_TRUE(error_line("robot table.urdf --packages " + given).starts_with("chasles: --packages: ")) << given;
}

TEST_F(Errors, Usage) {
    const std::string check = "check cube.obj cube.obj" + poses;
    const std::string hint = " (see chasles check --help)";
    EXPECT_EQ(error_line(check + " --foo"), "chasles check: The following argument was not expected: --foo" + hint);
    EXPECT_EQ(error_line("check cube.obj cube.obj --start 0 0 0"), "chasles check: --goal is required" + hint);
    EXPECT_EQ(error_line("check cube.obj"), "chasles check: FIXED is required" + hint);
    EXPECT_EQ(error_line(check + " --fixed-start 0 0 0"), "chasles check: --fixed-start requires --fixed-goal" + hint);
    EXPECT_EQ(error_line(check + " --motion helix"),
              "chasles check: --motion: helix not in {screw,sweep,velocity,twist}" + hint);
    EXPECT_EQ(error_line(""), "chasles: A subcommand is required (see chasles --help)");
    EXPECT_EQ(error_line("unscrew"), "chasles: no subcommand 'unscrew' (see chasles --help)");
}

TEST_F(Errors, OutputThatCannotBeWritten) {
    const std::string why = "chasles: standard output: cannot be written: ";
    if (std::filesystem::exists("/dev/full")) {
        EXPECT_EQ(error_line("info cube.obj >/dev/full"), why + "No space left on device");
        EXPECT_TRUE(error_line("info --help >/dev/full").starts_with(why));
    }
    EXPECT_TRUE(error_line("info cube.obj >&-").starts_with(why));
}

TEST_F(Errors, HelpIsNone) {
    for (const char* const arguments : {"--help", "check --help", "clearance --help", "view --help", "path --help",
                                        "batch --help", "info --help", "demo --help"}) {
        const auto finished = run(arguments);
        EXPECT_EQ(finished.status, 0) << arguments;
        EXPECT_EQ(finished.err, "") << arguments;
        EXPECT_NE(finished.out.find("Usage: chasles"), std::string::npos) << arguments;
    }
    EXPECT_TRUE(run("--version").out.starts_with("chasles "));
}

} // namespace
} // namespace chasles
