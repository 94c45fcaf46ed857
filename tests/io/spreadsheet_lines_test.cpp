// Lines that spreadsheets write: no row is lost as a comment, and decimal commas and units are named. So are tables
// that are no text.
#include "chasles/io/motion_files.h"
#include "chasles/io/point_files.h"
#include "tests/io/message_of.h"

#include <functional>

namespace chasles::io {
namespace {

using tests::message_of;

const std::string first_row = "3;0;0;1;0;0;0\n", last_row = "3;3;0;1;0;0;0\n";

std::string path_with(const std::string& line) {
    return "x;y;z;qw;qx;qy;qz\n" + first_row + line + "\n" + last_row;
}

std::string refusal_of_path(const std::string& text) {
    return message_of([&] { (void)read_path(text); });
}

TEST(SpreadsheetLines, AnErrorInTheFirstCellIsNoComment) {
    for (const char* const line :
         {"#N/A;0;0;1;0;0;0", "#REF!;0;0;1;0;0;0", "#NAME?;0;0;1;0;0;0", " #DIV/0! ;0;0;1;0;0;0;", "#NV;0;0;1;0;0;0",
          "#BEZUG!;0;0;1;0;0;0", "#N/A;#N/A;#N/A;#N/A;#N/A;#N/A;#N/A", "####;0;0;1;0;0;0", "#N/A;0,5;0;1;0;0;0",
          "#\xC3\x9C"
          "BERLAUF!;0;0;1;0;0;0",
          "#SPILL;0;0;1;0;0;0", "#N/A;;;;;;", "##N/A;0;0;1;0;0;0"}) {
        const std::string why = refusal_of_path(path_with(line));
        EXPECT_TRUE(why.starts_with("line 3: begins with '#")) << line << ": " << why;
        EXPECT_NE(why.find("an error of a spreadsheet, or a comment"), std::string::npos) << why;
    }
    EXPECT_EQ(
        refusal_of_path("x y z qw qx qy qz\n3 0 0 1 0 0 0\n#N/A 0 0 1 0 0 0\n"),
        "line 3: begins with '#N/A': it may be a cell with an error of a spreadsheet, or a comment; mend the cell "
        "or delete the line, or begin the comment with # and a blank");
}

TEST(SpreadsheetLines, CommentsStayComments) {
    for (const char* const line :
         {"#1.0;2;3;1;0;0;0", "# 1.0;2;3;1;0;0;0", "#1,5;2,5;3;1;0;0;0", "##1;2;3;1;0;0;0", "# N/A;0;0;1;0;0;0", "#",
          "# the second part", "#N/A;0;0", "#;;;;;;", "#x;y;z;qw;qx;qy;qz", "#-----"})
        EXPECT_EQ(read_path(path_with(line)).poses.size(), 2U) << line;
    EXPECT_EQ(read_path("#N/A;0;0;1;0;0;0\n" + path_with("")).poses.size(), 2U) << "before the header";
    EXPECT_EQ(read_path("# t x y z qw qx qy qz\n0 3 0 0 1 0 0 0\n# 1 2 3 4 1 0 0\n2 3 3 0 1 0 0 0\n").poses.size(), 2U);
}

TEST(SpreadsheetLines, EachTableNamesTheError) {
    EXPECT_TRUE(message_of([] {
                    (void)read_point_table("x;y;z\n1;2;3\n#N/A;2;3\n");
                }).starts_with("line 3: begins with '#N/A'"));
    EXPECT_TRUE(message_of([] { (void)read_point_table("#N/A 2 3\n1 2 3\n"); }).starts_with("line 1: begins with"))
        << "there is no header";
    const std::string header = "x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1";
    const std::string numbers = ",0,1,1,0,0,0,0,0,2,1,0,0,0";
    for (const char* const id : {"", ",id"}) {
        const MotionList list = read_motions(header + id + "\n#N/A" + numbers + (*id ? ",first\n" : "\n") + "0" +
                                             numbers + (*id ? ",second\n" : "\n"));
        ASSERT_EQ(list.rows.size(), 2U) << id;
        EXPECT_NE(list.rows[0].error.find("an error of a spreadsheet"), std::string::npos) << list.rows[0].error;
        EXPECT_EQ(list.rows[1].error, "");
    }
}

TEST(SpreadsheetLines, TheFirstLineMayNameTheSeparator) {
    const Path path = read_path("\xEF\xBB\xBFsep=;\r\n" + path_with(""));
    EXPECT_EQ(path.poses.at(1).translation, Eigen::Vector3d(3, 3, 0));
    EXPECT_EQ(read_point_table("\"SEP=,\"\nx,y,z\n1,2,3\n").size(), 1U);
    EXPECT_TRUE(
        refusal_of_path("sep=;\nx;y;z;qw;qx;qy;qz\n" + first_row + "#N/A;0;0;1;0;0;0\n").starts_with("line 4:"));
    EXPECT_EQ(refusal_of_path("sep=|\nx|y\n"),
              "line 1: names the separator '|'; commas, semicolons, tabs and blanks are read");
}

TEST(SpreadsheetLines, NamesUnitsAndDecimalCommas) {
    const std::string why = refusal_of_path("x [mm];y [mm];z [mm];qw;qx;qy;qz\n" + first_row + last_row);
    EXPECT_NE(why.find("has no column x, y, z"), std::string::npos) << why;
    EXPECT_TRUE(why.ends_with("; the unit of 'x [mm]' is not read: convert the numbers, and leave it out")) << why;
    EXPECT_EQ(message_of([] { (void)read_point_table("x;y;z\n1;2,5;3\n"); }),
              "line 2: has no number y in column 2; write a decimal point");
    EXPECT_EQ(message_of([] { (void)read_point_table("1,5;2;3\n"); }),
              "line 1: '1,5;2;3' has decimal commas; write decimal points");
    EXPECT_EQ(message_of([] { (void)read_point_table("1,5 2 3,25\n"); }),
              "line 1: '1,5 2 3,25' has decimal commas; write decimal points");
    EXPECT_EQ(read_point_table("1, 2, 3\n").size(), 1U);
    EXPECT_EQ(read_point_table("1,2,3\n").size(), 1U);
}

TEST(BinaryTables, AreNamedAndNotQuoted) {
    using namespace std::string_view_literals;
    const auto read_rows = [](std::string_view text) { (void)read_motions(text); };
    const auto read_poses = [](std::string_view text) { (void)read_path(text, WithoutHeader::tum); };
    const auto read_points = [](std::string_view text) { (void)read_point_table(text); };
    for (const auto& read : std::vector<std::function<void(std::string_view)>>{read_rows, read_poses, read_points}) {
        EXPECT_EQ(message_of([&] { read("PAR1\x15\x04\x15\0\x18,PAR1"sv); }),
                  "is a Parquet file, which is no text: write the table as CSV, or read it in Python "
                  "(chasles.distributed, or pandas and arrays)");
        for (const std::string_view bytes : {"PK\3\4\x14\0x,y\n"sv, "x\0,\0y\0\n\0"sv, "x,y\n1,2\n3,4\0\n"sv})
            EXPECT_EQ(message_of([&] { read(bytes); }),
                      "is no text: it has zero bytes, as spreadsheets (.xlsx), compressed files and text in UTF-16 "
                      "have; save the table as CSV in UTF-8");
        EXPECT_EQ(message_of([&] { read("\xFF\xFEx\0"sv); }), "is text in UTF-16 or UTF-32; save it as UTF-8");
    }
    EXPECT_TRUE(refusal_of_path("PAR1,PAR2\n1,2\n").starts_with("line 1: the header 'PAR1, PAR2' has no column x"));
}

} // namespace
} // namespace chasles::io
