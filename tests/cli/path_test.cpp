// chasles path: the first contact on a sequence of screws, and its segment.
#include "tests/cli/cli_test_files.h"

#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

const std::string header = "x,y,z,qw,qx,qy,qz\n";
const std::string around = header + "3,.25,.25,1,0,0,0\n3,3,.25,1,0,0,0\n.25,3,.25,1,0,0,0\n";

using Path = tests::CommandLine;

TEST_F(Path, AnswersClear) {
    write("path.csv", around);
    const auto finished = run("path cube.obj cube.obj --poses path.csv --json");
    EXPECT_EQ(finished.status, 0);
    EXPECT_EQ(Json::parse(finished.out)["verdict"], "clear");
    EXPECT_EQ(Json::parse(finished.out)["segment"], 1) << "the last one";
    EXPECT_TRUE(run("path cube.obj cube.obj --poses path.csv").out.starts_with("CLEAR"));
}

TEST_F(Path, AnswersTheSegmentAndTheTimeWithinIt) {
    write("path.csv", around + ".25,0,.25,1,0,0,0\n");
    const auto finished = run("path cube.obj cube.obj --poses path.csv --json");
    EXPECT_EQ(finished.status, 1);
    const Json answer = Json::parse(finished.out);
    EXPECT_EQ(answer["segment"], 2);
    EXPECT_LE(answer["time"], 2.0 / 3);
    EXPECT_GE(answer["time_upper"], 2.0 / 3);
    EXPECT_EQ(answer["motion"]["slide"], 3.0);
    EXPECT_TRUE(run("path cube.obj cube.obj --poses path.csv --any").out.starts_with("CONTACT"));
}

TEST_F(Path, RefusesBadFiles) {
    const std::string path = "path cube.obj cube.obj --poses ";
    EXPECT_EQ(error_line(path + "no.csv"), "chasles: no.csv: no such file");
    write("bad.csv", around + "1,2,x,1,0,0,0\n");
    EXPECT_EQ(error_line(path + "bad.csv"), "chasles: bad.csv: line 5: z: not a finite number: 'x'");
    write("one.csv", header + "3,0,0,1,0,0,0\n");
    EXPECT_EQ(error_line(path + "one.csv"), "chasles: one.csv: line 2: the path has 1 pose, but needs at least two");
}

} // namespace
} // namespace chasles
