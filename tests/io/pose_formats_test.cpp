// One path of poses in the formats of many programs: each is read as the same path, or refused with its header.
#include "chasles/io/column_table.h"
#include "chasles/io/motion_files.h"
#include "chasles/io/pose_columns.h"
#include "tests/io/message_of.h"

#include <algorithm>
#include <array>
#include <random>

namespace chasles::io {
namespace {

using tests::message_of;
using Names = std::vector<std::string>;

/// x, y, z, qw, qx, qy, qz, t. All numbers differ, so that no two columns can be confused unseen.
constexpr std::array<std::array<const char*, 8>, 3> numbers = {
    {{"3", "0.25", "-1.5", "0.9", "0.1", "0.2", "0.3", "-2"},
     {"1e-3", "7", "2", "0.5", "-0.4", "0.75", "0.125", "0.5"},
     {"-4", "8", "6", "1", "0", "-0.6", "-0.7", "11"}}};

double value(std::size_t row, std::size_t column) {
    return std::stod(numbers.at(row).at(column));
}

void expect_the_path(const Path& path, bool has_stamps, const std::string& text) {
    ASSERT_EQ(path.poses.size(), numbers.size()) << text;
    ASSERT_EQ(path.stamps.size(), has_stamps ? numbers.size() : 0) << text;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        EXPECT_EQ(path.poses[i].translation, Eigen::Vector3d(value(i, 0), value(i, 1), value(i, 2))) << text;
        EXPECT_EQ(path.poses[i].rotation.coeffs(), Eigen::Vector4d(value(i, 4), value(i, 5), value(i, 6), value(i, 3)))
            << text;
        EXPECT_TRUE(!has_stamps || path.stamps[i] == value(i, 7)) << text;
    }
}

/// How a program writes the path.
struct Style {
    Names names;                    ///< of x to qz and t
    std::vector<std::size_t> order; ///< which of them, from left to right; 8 is a column of another meaning
    std::string separator = ",";
    std::string end_of_line = "\n";
    bool has_comments = false;
    bool is_header_comment = false;
};

std::string joined(const Names& cells, const Style& style, bool has_separator_at_end) {
    std::string line;
    for (const std::string& cell : cells)
        line += (line.empty() ? "" : style.separator) + cell;
    return line + (has_separator_at_end ? style.separator : "") + style.end_of_line;
}

std::string text_of(const Style& style, std::mt19937& random) {
    const auto at_random = [&] { return random() % 2 == 0; };
    const auto row = [&](const auto& cell) {
        Names cells;
        for (const std::size_t column : style.order)
            cells.push_back(column == 8 ? (style.is_header_comment ? "8" : "note") : cell(column));
        return joined(cells, style, at_random());
    };
    std::string text = style.has_comments ? "# made by a test" + style.end_of_line + style.end_of_line : "";
    text += (style.is_header_comment ? "# " : "") + row([&](std::size_t column) { return style.names[column]; });
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text += row([&](std::size_t column) { return std::string(numbers.at(i).at(column)); });
        if (style.has_comments)
            text += " # a comment" + style.end_of_line;
    }
    return text;
}

const std::vector<Names> dialects = {
    {"x", "y", "z", "qw", "qx", "qy", "qz", "t"},
    {"tx", "ty", "tz", "qw", "qx", "qy", "qz", "timestamp"},
    {"X", "Y", "Z", "QW", "QX", "QY", "QZ", "Time"},
    {"pos_x", "pos_y", "pos_z", "quat_w", "quat_x", "quat_y", "quat_z", "TIMESTAMP"},
    {"position.x", "position.y", "position.z", "orientation.w", "orientation.x", "orientation.y", "orientation.z", "t"},
    {"pose/position/x", "pose/position/y", "pose/position/z", "pose/orientation/w", "pose/orientation/x",
     "pose/orientation/y", "pose/orientation/z", "time"},
    {"p_x", "p_y", "p_z", "q_w", "q_x", "q_y", "q_z", "t"},
    {"\"x\"", "\"y\"", "\"z\"", "\"qw\"", "\"qx\"", "\"qy\"", "\"qz\"", "\"t\""},
};

/// Every dialect with every separator, line end and kind of comment, in random orders, with and without stamps.
TEST(PoseFormats, AreAllReadAsTheSamePath) {
    const unsigned seed = 41;
    std::mt19937 random(seed);
    std::size_t read = 0;
    for (const Names& names : dialects)
        for (const char* const separator : {",", ", ", ";", "\t", " ", "   ", " ; "})
            for (const char* const end : {"\n", "\r\n"})
                for (const unsigned kind : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U}) {
                    Style style{names, {0, 1, 2, 3, 4, 5, 6}, separator, end, (kind & 1U) != 0, (kind & 2U) != 0};
                    const bool has_stamps = (kind & 4U) != 0;
                    if (has_stamps)
                        style.order.push_back(7);
                    std::ranges::shuffle(style.order, random);
                    const std::string text = text_of(style, random);
                    const Path path = read_path(text);
                    expect_the_path(path, has_stamps, text);
                    EXPECT_TRUE(path.warnings.empty()) << text;
                    ++read;
                }
    EXPECT_EQ(read, dialects.size() * 7 * 2 * 8);
}

TEST(PoseFormats, NameTheColumnsThatAreNotRead) {
    std::mt19937 random(5);
    const Path path = read_path(text_of({dialects[0], {7, 8, 0, 1, 2, 6, 5, 4, 3}, ";"}, random));
    expect_the_path(path, true, "with a note");
    ASSERT_EQ(path.warnings.size(), 1U);
    EXPECT_EQ(path.warnings[0], "line 1: ignored columns: 'note'; x, y, z, qw, qx, qy, qz and t are read");
}

/// The output of `chasles drag` has a torque tx, ty, tz: x, y and z are the place.
TEST(PoseFormats, PreferTheirOwnNames) {
    const Path path =
        read_path("TIME,t,tx,x,y,z,ty,tz,qw,qx,qy,qz\n5,0,9,1,2,3,9,9,1,0,0,0\n4,1,9,1,2,4,9,9,1,0,0,0\n");
    EXPECT_EQ(path.poses[1].translation, Eigen::Vector3d(1, 2, 4));
    EXPECT_EQ(path.stamps, (std::vector<double>{0, 1}));
    ASSERT_EQ(path.warnings.size(), 1U);
    EXPECT_EQ(path.warnings[0], "line 1: ignored columns: 'TIME, tx, ty, tz'; x, y, z, qw, qx, qy, qz and t are read");
}

TEST(PoseFormats, ReadTumTrajectories) {
    const std::string rows =
        "-2 3 0.25 -1.5 0.1 0.2 0.3 0.9\n0.5 1e-3 7 2 -0.4 0.75 0.125 0.5\n11 -4 8 6 0 -0.6 -0.7 1\n";
    for (const char* const before :
         {"# timestamp tx ty tz qx qy qz qw\n", "#timestamp tx ty tz qx qy qz qw\n", "timestamp tx ty tz qx qy qz qw\n",
          "# ground truth trajectory\n# file: 'desk.bag'\n# timestamp tx ty tz qx qy qz qw\n"})
        expect_the_path(read_path(before + rows), true, before);
    expect_the_path(read_path(rows, WithoutHeader::tum), true, "by the name of the file");
    expect_the_path(read_path("# by hand\n" + rows, WithoutHeader::tum), true, "by the name of the file");
    EXPECT_EQ(message_of([&] { (void)read_path(rows); }),
              "line 1: there is no header, and 8 numbers may be t,x,y,z,qw,qx,qy,qz or t,x,y,z,qx,qy,qz,qw (as in TUM "
              "trajectories): write the names in the line above");
}

/// The ground truth of EuRoC: more columns, units, and the header is a comment with commas.
TEST(PoseFormats, ReadEuroc) {
    const std::string text = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
                             "q_RS_z [], v_RS_R_x [m s^-1]\n-2,3,0.25,-1.5,0.9,0.1,0.2,0.3,9\n"
                             "0.5,1e-3,7,2,0.5,-0.4,0.75,0.125,9\n11,-4,8,6,1,0,-0.6,-0.7,9\n";
    const Path path = read_path(text);
    expect_the_path(path, true, text);
    EXPECT_EQ(path.warnings.size(), 1U);
}

TEST(PoseFormats, StampsMayHaveAnyUnitOfTime) {
    for (const char* const time : {"t[s]", "Time [ns]", "timestamp (s)", "time[ms]", "t [us]", "time [seconds]",
                                   "time_from_start", "stamp", "Stamp [ns]", "header.stamp", "header/stamp [s]"}) {
        const Path path = read_path(std::string(time) + ",x[m],y (m),z,qw [],qx,qy,qz\n1,1,2,3,1,0,0,0\n"
                                                        "3,1,2,4,1,0,0,0\n");
        EXPECT_EQ(path.stamps, (std::vector<double>{1, 3})) << time;
        EXPECT_TRUE(path.warnings.empty()) << time;
    }
    EXPECT_EQ(pose_column("t(x)"), "") << "no unit of time";
    EXPECT_EQ(pose_column("header.stamp.secs"), "") << "a part of the time";
}

TEST(PoseFormats, ListsOfMotionsMayHaveUnits) {
    const MotionList motions = read_motions("x0 [m],y0 [m],z0 [m],qw0,qx0,qy0,qz0,x1[m],y1[m],z1[m],qw1[],qx1,qy1,qz1\n"
                                            "1,2,3,1,0,0,0,4,5,6,1,0,0,0\n");
    ASSERT_EQ(motions.rows.size(), 1U);
    EXPECT_EQ(motions.rows[0].error, "");
    EXPECT_EQ(motions.rows[0].goal.translation, Eigen::Vector3d(4, 5, 6));
}

/// Where two readings are possible, both are named; and every refusal of a header shows it.
TEST(PoseFormats, AreRefusedWithTheirHeader) {
    const auto refused = [](const std::string& text, WithoutHeader without = WithoutHeader::refused) {
        return message_of([&] { (void)read_path(text, without); });
    };
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"x,y;z,qw,qx,qy,qz\n", "'x,y;z,qw,qx,qy,qz' has commas and semicolons"},
        {"x\ty z\tqw\tqx\tqy\tqz\n", "has tabs and blanks between the names, so that y z may be one name or more"},
        {"x,y,z,qw,qx,qy,qz,x\n", "the column 'x' comes twice in the header 'x, y, z, qw, qx, qy, qz, x'"},
        {"x,y,z,qw,qx,qy,qz,X\n", "two columns for x: 'x' and 'X'"},
        {"pos_x,y,z,qw,qx,qy,qz,tx\n", "two columns for x: 'pos_x' and 'tx'"},
        {"time,x,y,z,qw,qx,qy,qz,timestamp\n", "two columns for t: 'time' and 'timestamp'"},
        {"x,y,z,w,qx,qy,qz\n", "the header 'x, y, z, w, qx, qy, qz' has no column qw;"},
        {"x,y,z,roll_deg,pitch_deg,yaw_deg\n", "the angles of the column 'roll_deg' are not read"},
        {"x_deg,y,z,qw,qx,qy,qz\n", "'x_deg, y, z, qw, qx, qy, qz' has no column x;"},
        {"0,0,0,1,0,0,0\n", "7 numbers may be x,y,z,qw,qx,qy,qz or x,y,z,qx,qy,qz,qw"},
        {"1,2,3\n", "there is no header, but 3 numbers"},
        {"# x y z qx qy qz qw\n0 1 2 3 0 0 0 1\n",
         "the comment 'x, y, z, qx, qy, qz, qw' may be the header, but it has 7"},
        {"# x y z qw qx qy qz\n# x y z qx qy qz qw\n1 2 3 0 0 0 1\n", "the comments in the lines 1 and 2 both may be"},
        {"# t x y z qw qx qy qz covariance\n0 1 2 3 0 0 0 1\n",
         "has 9 names, and the first row '0 1 2 3 0 0 0 1' has 8"},
    };
    for (const auto& [text, expected] : cases) {
        const std::string message = refused(text, WithoutHeader::tum);
        EXPECT_NE(message.find(expected), std::string::npos) << message;
        EXPECT_TRUE(message.starts_with("line ")) << message;
    }
    EXPECT_EQ(refused("x;y;z;qw;qx;qy;qz\n0,5;0;0;1;0;0;0\n"),
              "line 2: x: not a finite number: '0,5'; write a decimal point");
    EXPECT_EQ(refused("x\ty\tz\tqw\tqx\tqy\tqz\n1\t\t3\t1\t0\t0\t0\n"), "line 2: y: not a finite number: ''");
    EXPECT_EQ(refused("x y z qw qx qy qz\n1 3 1 0 0 0\n"), "line 2: 6 columns found, 7 expected");
}

/// A file with another name than .tum or .txt is not taken for a TUM trajectory, nor one with commas.
TEST(PoseFormats, NeedAHeaderWithoutTheEndingOfTum) {
    const std::string row = "0 1 2 3 0 0 0 1\n1 1 2 3 0 0 0 1\n";
    EXPECT_NO_THROW((void)read_path(row, WithoutHeader::tum));
    std::string commas = row;
    std::ranges::replace(commas, ' ', ',');
    EXPECT_THROW((void)read_path(commas, WithoutHeader::tum), InvalidInput);
    EXPECT_THROW((void)read_path(row, WithoutHeader::refused), InvalidInput);
}

TEST(PoseFormats, SkipLinesOfSeparatorsAlone) {
    EXPECT_EQ(read_path("x,y,z,qw,qx,qy,qz,,\n1,2,3,1,0,0,0\n,,,,,,,,\n1,2,4,1,0,0,0,,,,\n,,,\n").poses.size(), 2U);
}

TEST(PoseColumn, KnowsNoOtherNames) {
    for (const char* const name : {"", "w", "q", "qq", "px", "rx", "roll", "x0", "x [mm]", "vel_x", "ttx", "x y", "tw"})
        EXPECT_EQ(pose_column(name), "") << name;
}

} // namespace
} // namespace chasles::io
