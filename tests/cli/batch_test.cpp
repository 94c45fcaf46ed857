// chasles batch: one row per motion in the order of the input, also where some rows are wrong.
#include "tests/cli/cli_test_files.h"

#include "chasles/io/column_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace chasles {
namespace {

const std::string columns = "x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1\n";
const std::string hits = ".25,.5,3,1,0,0,0,.25,.5,-1,1,0,0,0\n";
const std::string misses = "3,0,0,1,0,0,0,9,0,0,1,0,0,0\n";
const std::string overlaps = ".5,.25,.25,1,0,0,0,9,0,0,1,0,0,0\n";

class Batch : public tests::CommandLine {
protected:
    [[nodiscard]] tests::Finished batch(const std::string& motions, const std::string& options = "") const {
        write("motions.csv", motions);
        return run("batch cube.obj cube.obj --motions motions.csv --out out.csv " + options);
    }
    [[nodiscard]] std::string output() const {
        std::ifstream file(path("out.csv"), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] std::vector<std::vector<std::string>> rows() const {
        const std::string text = output();
        io::ColumnTable table(text, [](std::string_view) { return false; });
        std::vector<std::vector<std::string>> rows;
        rows.push_back(table.names());
        while (const auto row = table.next())
            rows.push_back(row->cells);
        return rows;
    }
};

TEST_F(Batch, WritesOneRowAMotion) {
    const auto finished = batch("id," + columns + "\"a,b\"," + hits + "far," + misses + "in," + overlaps);
    EXPECT_EQ(finished.status, 1);
    EXPECT_EQ(finished.err, "");
    EXPECT_TRUE(output().starts_with(
        "id,verdict,time,time_upper,tau,tau_upper,certain,kind,moving_feature,fixed_feature,px,py,pz,nx,ny,nz\n"));
    const auto table = rows();
    ASSERT_EQ(table.size(), 4U);
    for (const auto& row : table)
        EXPECT_EQ(row.size(), 16U);
    EXPECT_EQ(table[1][0], "a,b");
    EXPECT_EQ(table[1][1], "contact");
    EXPECT_LE(std::stod(table[1][2]), 0.5);
    EXPECT_GE(std::stod(table[1][3]), 0.5);
    EXPECT_EQ(table[1][6], "true");
    EXPECT_EQ(output().find("far,clear,,,,,,,,,,,,,,\n") != std::string::npos, true) << output();
    EXPECT_EQ(table[3][1], "contact_at_start");
}

TEST_F(Batch, AnswersClearWhenAllAre) {
    EXPECT_EQ(batch(columns + misses + misses).status, 0);
    EXPECT_EQ(rows()[2][0], "1") << "the number of the row, from 0";
}

/// An enclosed motion that goes too far is refused (docs/decisions/0012-range-of-coordinates.md).
TEST_F(Batch, AnswersTheOthersWhereAMotionGoesTooFar) {
    const std::string far = "0,0,1e20,1,0,0,0,0,0,5,0.9,0.3,0,0\n", near = "0,0,9,1,0,0,0,0,0,5,0.9,0.3,0,0\n";
    const auto finished = batch(columns + near + far + near, "--motion velocity");
    EXPECT_EQ(finished.status, 2);
    EXPECT_TRUE(finished.err.starts_with(
        "chasles: motions.csv: 1 of 3 rows cannot be read; the first: row 1: motion: goes up to 1e+20 far"))
        << finished.err;
    const auto table = rows();
    ASSERT_EQ(table.size(), 4U);
    EXPECT_EQ(table[1][1], "clear");
    EXPECT_EQ(table[2][1], "error");
    EXPECT_EQ(table[3][1], "clear");
    EXPECT_EQ(batch(columns + near + far + near).status, 0) << "screws are exact";
}

TEST_F(Batch, AnswersTheOthersWhereRowsAreBad) {
    const auto finished = batch(columns + misses + "1,2\n" + hits + "x" + misses);
    EXPECT_EQ(finished.status, 2);
    EXPECT_EQ(finished.err,
              "chasles: motions.csv: 2 of 4 rows cannot be read; the first: line 3: 2 columns found, 14 expected\n");
    const auto table = rows();
    ASSERT_EQ(table.size(), 5U);
    EXPECT_EQ(table[1][1], "clear");
    EXPECT_EQ(table[2][1], "error");
    EXPECT_EQ(table[2][7], "line 3: 2 columns found, 14 expected");
    EXPECT_EQ(table[3][1], "contact");
    EXPECT_EQ(table[4][1], "error");
    for (const auto& row : table)
        EXPECT_EQ(row.size(), 16U);
}

TEST_F(Batch, DoesNotDependOnThreads) {
    std::string motions = columns;
    for (int i = 0; i < 1500; ++i)
        motions += std::to_string(i % 7) + ".125,.5,3,1,0,0,0,.25,.5,-1,1,0,0,0\n";
    EXPECT_EQ(batch(motions, "--threads 1").status, 1);
    const std::string alone = output();
    EXPECT_EQ(batch(motions, "--threads 4").status, 1);
    EXPECT_EQ(output(), alone);
    EXPECT_EQ(rows().size(), 1501U) << "more than one chunk";
}

TEST_F(Batch, TakesTheMotionsOfCheck) {
    const std::string turning = "3,.2,.3,1,0,0,0,-1,.2,.3,.9,.1,.2,.3\n";
    for (const std::string motion : {"screw", "sweep --centre -1 .5 .5", "velocity --centre -1 .5 .5", "twist"}) {
        EXPECT_EQ(batch(columns + turning + misses, "--motion " + motion).status, 1);
        const auto table = rows();
        const auto checked =
            run("check cube.obj cube.obj --json --start '3 .2 .3' --goal '-1 .2 .3 .9 .1 .2 .3' --motion " + motion);
        const auto answer = nlohmann::json::parse(checked.out);
        ASSERT_EQ(table.size(), 3U);
        for (const auto& row : table)
            EXPECT_EQ(row.size(), 16U) << motion;
        EXPECT_EQ(std::stod(table[1][2]), answer["time"]) << motion;
        EXPECT_EQ(std::stod(table[1][3]), answer["time_upper"]) << motion;
        EXPECT_EQ(table[1][6], "true");
        EXPECT_EQ(table[1][7], answer["contacts"][0]["kind"]) << motion;
        const bool has_tau = motion == "screw" || motion.starts_with("sweep");
        EXPECT_EQ(answer.contains("tau"), has_tau) << motion;
        EXPECT_EQ(table[1][4], has_tau ? fmt::format("{}", answer["tau"].get<double>()) : "") << motion;
        EXPECT_EQ(table[1][5], has_tau ? fmt::format("{}", answer["tau_upper"].get<double>()) : "") << motion;
        EXPECT_EQ(table[2][1], "clear") << motion;
    }
}

TEST_F(Batch, RefusesACentreThatHasNoMeaning) {
    write("motions.csv", columns + misses);
    EXPECT_EQ(error_line("batch cube.obj cube.obj --motions motions.csv --out out.csv --motion twist --centre 1 2 3"),
              "chasles: --centre: is for --motion sweep and --motion velocity, but the motion is a twist");
}

TEST_F(Batch, FindsOutBeforeTheWorkThatItCannotWrite) {
    write("motions.csv", columns + misses);
    const std::string batch = "batch cube.obj cube.obj --motions motions.csv --out ";
    EXPECT_EQ(error_line(batch + "no/out.csv"), "chasles: no/out.csv: cannot be written: No such file or directory");
    EXPECT_TRUE(error_line(batch + ".").starts_with("chasles: .: cannot be written: "));
    if (std::filesystem::exists("/dev/full")) {
        EXPECT_EQ(error_line(batch + "/dev/full"), "chasles: /dev/full: cannot be written: No space left on device");
    }
}

TEST_F(Batch, MayGoToStandardOutput) {
    write("motions.csv", columns + hits + misses);
    const auto finished = run("batch cube.obj cube.obj --motions motions.csv --out /dev/stdout");
    EXPECT_EQ(finished.status, 1);
    EXPECT_TRUE(finished.out.starts_with("id,verdict,")) << finished.out;
    EXPECT_EQ(std::count(finished.out.begin(), finished.out.end(), '\n'), 3) << "rows only: " << finished.out;
}

TEST_F(Batch, CountsInPlainEnglish) {
    EXPECT_EQ(batch(columns + misses).out, "1 motion: 1 clear, 0 in contact, 0 in contact at the start, 0 errors\n");
    EXPECT_EQ(batch(columns + "1\n").err,
              "chasles: motions.csv: 1 of 1 rows cannot be read; the first: line 2: 1 column found, 14 expected\n");
}

TEST_F(Batch, WritesWhatIsAnsweredWhenItIsInterrupted) {
    std::string motions = columns;
    for (int i = 0; i < 4000; ++i)
        motions += "2.45,0,0,1,0,0,0,2.45,0,0,.1,0,0,1\n"; // a turn by 169 degrees, in thousands of pieces
    write("motions.csv", motions);
    const auto finished =
        run("batch cube.obj cube.obj --motions motions.csv --out out.csv --max-turn-deg .05 & pid=$!; "
            "while ! grep -qs clear out.csv.part; do sleep .02; done; kill $pid; wait $pid");
    EXPECT_EQ(finished.status, 130);
    EXPECT_FALSE(std::filesystem::exists(path("out.csv")));
    std::filesystem::rename(path("out.csv.part"), path("out.csv"));
    const std::size_t answered = rows().size() - 1;
    EXPECT_GT(answered, 0U);
    EXPECT_LT(answered, 4000U);
    EXPECT_EQ(rows().back().size(), 16U);
    EXPECT_TRUE(finished.err.ends_with("chasles: interrupted: " + std::to_string(answered) +
                                       " of 4000 motions are answered, in out.csv.part; --resume goes on from there\n"))
        << finished.err;
}

TEST_F(Batch, LeavesAnEarlierOutputAloneWhenItsInputIsWrong) {
    write("out.csv", "precious");
    EXPECT_EQ(batch("x,y\n").status, 2);
    EXPECT_EQ(output(), "precious");
    EXPECT_EQ(batch(columns + misses, "--margin x").status, 2);
    EXPECT_EQ(output(), "precious");
}

} // namespace
} // namespace chasles
