// CSV (comma-separated values) files of poses and motions: a bad row makes a whole path invalid, but only one motion.
#include "chasles/io/csv_table.h"
#include "chasles/io/motion_files.h"
#include "tests/io/message_of.h"

namespace chasles::io {
namespace {

using tests::message_of;

const std::string path_header = "x,y,z,qw,qx,qy,qz\n";
const std::string motion_header = "x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1\n";
const std::string motion = "0,0,1,1,0,0,0,0,0,2,1,0,0,0\n";

class MotionFiles : public tests::FileTest {
protected:
    [[nodiscard]] std::string path_message(const std::string& content) const {
        return without_folder(message_of([&] { (void)load_path(write("path.csv", content)); }));
    }
    [[nodiscard]] std::vector<MotionRow> motions(const std::string& content) const {
        return load_motions(write("motions.csv", content)).rows;
    }
};

TEST(SplitCsv, KnowsQuotesAndBlanks) {
    using Cells = std::vector<std::string>;
    EXPECT_EQ(split_csv("a, b ,,d"), (Cells{"a", "b", "", "d"}));
    EXPECT_EQ(split_csv("\"a,b\",\"say \"\"hi\"\"\",c"), (Cells{"a,b", "say \"hi\"", "c"}));
    EXPECT_EQ(split_csv(""), (Cells{""}));
    EXPECT_EQ(split_csv("a,"), (Cells{"a", ""}));
}

TEST(CsvCell, ReadsBackToTheSameText) {
    for (const char* const text : {"plain", "with, comma", "with \"quotes\"", " blanks ", "", "#3"})
        EXPECT_EQ(split_csv(csv_cell(text)).front(), text);
}

TEST_F(MotionFiles, ReadsPaths) {
    const Path path =
        load_path(write("path.csv", "\xEF\xBB\xBF x, y,z,qw,qx,qy,qz\r\n1,2,3,1,0,0,0\r\n\r\n-.5,0,1e-3,0,0,0,2\r\n"));
    ASSERT_EQ(path.poses.size(), 2U);
    EXPECT_EQ(path.poses[1].translation, Eigen::Vector3d(-0.5, 0, 1e-3));
    EXPECT_TRUE(path.stamps.empty());
}

TEST_F(MotionFiles, RefusesBadPaths) {
    EXPECT_EQ(path_message("\n\n"), "path.csv: has no header; it needs the columns x,y,z,qw,qx,qy,qz in any order");
    EXPECT_EQ(path_message("x,y,z\n1,2,3\n"),
              "path.csv: line 1: the header 'x, y, z' has no column qw, qx, qy, qz; it needs the columns x, y, z, qw, "
              "qx, qy, qz in any order, and may have t");
    EXPECT_EQ(path_message(path_header + "1,2,3\n"), "path.csv: line 2: 3 columns found, 7 expected");
    EXPECT_EQ(path_message(path_header + "1,2,3,1,0,0,0\n1,2,nan,1,0,0,0\n"),
              "path.csv: line 3: z: not a finite number: 'nan'");
    EXPECT_EQ(path_message(path_header + "1,2,,1,0,0,0\n"), "path.csv: line 2: z: not a finite number: ''");
    EXPECT_TRUE(path_message(path_header + "1,2,3,0,0,0,0\n").starts_with("path.csv: line 2: pose: quaternion: "));
    EXPECT_EQ(without_folder(message_of([&] { (void)load_path(path("no.csv")); })), "no.csv: no such file");
    EXPECT_EQ(path_message(path_header), "path.csv: line 1: the path has 0 poses, but needs at least two");
    EXPECT_EQ(path_message(path_header + "\n1,2,3,1,0,0,0\n"),
              "path.csv: line 3: the path has 1 pose, but needs at least two");
}

TEST_F(MotionFiles, ReadsStamps) {
    const Path path = load_path(
        write("path.csv", " t ," + path_header + "-1.5,1,2,3,1,0,0,0\n1e-3,1,2,4,1,0,0,0\n0.1,1,2,5,0,0,0,2\n"));
    EXPECT_EQ(path.stamps, (std::vector<double>{-1.5, 1e-3, 0.1}));
    ASSERT_EQ(path.poses.size(), 3U);
    EXPECT_EQ(path.poses[1].translation, Eigen::Vector3d(1, 2, 4));
}

TEST_F(MotionFiles, RefusesBadStamps) {
    const auto message = [&](const std::string& second, const std::string& first = "1") {
        return path_message("t," + path_header + first + ",1,2,3,1,0,0,0\n" + second + ",1,2,4,1,0,0,0\n");
    };
    EXPECT_EQ(message("0.5"), "path.csv: line 3: t: must increase, but is 0.5 after 1");
    EXPECT_EQ(message("1"), "path.csv: line 3: t: must increase, but is 1 after 1");
    EXPECT_EQ(message("nan"), "path.csv: line 3: t: not a finite number: 'nan'");
    EXPECT_EQ(message("2", "-inf"), "path.csv: line 2: t: not a finite number: '-inf'");
    EXPECT_EQ(message(""), "path.csv: line 3: t: not a finite number: ''");
    EXPECT_EQ(message("1e308", "-1e308"), "path.csv: line 3: t: 1e+308 is too far from the first stamp");
    EXPECT_EQ(path_message("t," + path_header + "1,2,3,1,0,0,0\n"), "path.csv: line 2: 7 columns found, 8 expected");
    EXPECT_EQ(path_message("t," + path_header + "7,1,2,3,1,0,0,0\n"),
              "path.csv: line 2: the path has 1 pose, but needs at least two");
}

TEST_F(MotionFiles, NumbersRowsFromZeroOrTakesTheirIds) {
    const auto numbered = motions(motion_header + motion + motion);
    ASSERT_EQ(numbered.size(), 2U);
    EXPECT_EQ(numbered[1].id, "1");
    EXPECT_EQ(numbered[1].goal.translation, Eigen::Vector3d(0, 0, 2));
    const auto named = motions("id," + motion_header + "\"a,b\"," + motion);
    ASSERT_EQ(named.size(), 1U);
    EXPECT_EQ(named[0].id, "a,b");
    EXPECT_TRUE(named[0].error.empty());
}

TEST_F(MotionFiles, KeepsGoodRowsBesideBadOnes) {
    const auto rows =
        motions(motion_header + motion + "1,2\n" + "0,0,1,1,0,0,0,0,0,2,0,0,0,0\n" + motion + "x" + motion);
    ASSERT_EQ(rows.size(), 5U);
    EXPECT_EQ(rows[1].error, "line 3: 2 columns found, 14 expected");
    EXPECT_TRUE(rows[2].error.starts_with("line 4: pose: quaternion: "));
    EXPECT_TRUE(rows[3].error.empty());
    EXPECT_EQ(rows[4].error, "line 6: x0: not a finite number: 'x0'");
}

TEST_F(MotionFiles, RefusesOtherHeaders) {
    const std::string short_header = without_folder(message_of([&] { (void)motions("id,x0,y0\na,1,2\n"); }));
    EXPECT_TRUE(short_header.starts_with("motions.csv: line 1: the header 'id, x0, y0' has no column z0, qw0, qx0, "))
        << short_header;
    EXPECT_TRUE(short_header.ends_with("qy1, qz1 in any order, and may have id")) << short_header;
    const std::string none = without_folder(message_of([&] { (void)motions(motion + motion); }));
    EXPECT_TRUE(none.starts_with("motions.csv: line 1: there is no header, but 14 numbers in the first line")) << none;
}

TEST_F(MotionFiles, ReadsMotionsByNameInAnyOrder) {
    const MotionList list =
        load_motions(write("motions.txt", "# two ends\nNote;QX1;qy1;qz1;qw1;z1;y1;x1;id;tx0;ty0;tz0;qx0;qy0;qz0;qw0;\n"
                                          "# \n"
                                          "a;1;2;3;4;30;20;10;#3;5;6;7;0;0;0;1\n"
                                          "#9;1;2;3;4;30;20;10;m;5;6;7;0;0;0;1\n"));
    ASSERT_EQ(list.rows.size(), 2U) << "of the comments only the last one may be a row";
    EXPECT_EQ(list.rows[0].id, "#3");
    EXPECT_EQ(list.rows[0].start.translation, Eigen::Vector3d(5, 6, 7));
    EXPECT_EQ(list.rows[0].goal.translation, Eigen::Vector3d(10, 20, 30));
    EXPECT_EQ(list.rows[0].goal.rotation.coeffs(), Eigen::Vector4d(1, 2, 3, 4)) << "x, y, z, w";
    EXPECT_TRUE(list.rows[1].error.starts_with("line 5: begins with #: it may be a comment, or a row"))
        << list.rows[1].error;
    ASSERT_EQ(list.warnings.size(), 1U);
    EXPECT_EQ(without_folder(list.warnings[0]),
              "motions.txt: line 2: ignored columns: 'Note'; x0 to qz1 and id are read");
}

} // namespace
} // namespace chasles::io
