// Paths of robots: columns by the names of variables, in radians or degrees.
#include "chasles/io/text_scan.h"
#include "chasles/robot/joint_columns.h"
#include "chasles/robot/joint_path_file.h"
#include "tests/io/message_of.h"

#include <algorithm>
#include <numbers>
#include <random>

namespace chasles::robot {
namespace {

using tests::message_of;

/// Joints in a chain, of these names and types.
Robot chain_of(const std::vector<std::pair<std::string, JointType>>& joints) {
    RobotDescription description;
    description.name = "chain";
    description.links.push_back({"link0"});
    for (std::size_t i = 0; i < joints.size(); ++i) {
        description.links.push_back({"link" + std::to_string(i + 1)});
        description.joints.push_back({.name = joints[i].first,
                                      .type = joints[i].second,
                                      .parent = "link" + std::to_string(i),
                                      .child = "link" + std::to_string(i + 1)});
    }
    return Robot(description);
}

Robot arm() {
    return chain_of({{"waist", JointType::revolute},
                     {"elbow", JointType::continuous},
                     {"slide", JointType::prismatic},
                     {"mount", JointType::fixed}});
}

/// The warning about columns that are missing.
std::string without(const std::string& variables) {
    return "line 1: no values for '" + variables + "': they stay at their neutral values";
}

std::string refused(const std::string& text, const Robot& robot) {
    return message_of([&] { (void)read_configurations(text, robot); });
}

TEST(JointPathFile, BinaryTablesAreNamed) {
    EXPECT_TRUE(refused(std::string("PAR1\x15\0", 6), arm()).starts_with("is a Parquet file"));
    EXPECT_TRUE(refused(std::string("waist\n1\n\0\n", 10), arm()).starts_with("is no text"));
    EXPECT_EQ(read_configurations("PAR1,PAR2\n0,1\n1,2\n",
                                  chain_of({{"PAR1", JointType::revolute}, {"PAR2", JointType::revolute}}))
                  .configurations.size(),
              2U);
}

/// Every separator, order of columns and spelling reads as the same path.
TEST(JointPathFile, ReadsColumnsByNameInAnyOrder) {
    const Robot robot = arm();
    std::mt19937 random(10);
    std::vector<std::string> columns = {"waist", "elbow", "slide", "t"};
    const std::vector<std::vector<std::string>> rows = {{"0.5", "-1.25", "3", "-1"}, {"0.75", "2", "-4", "6"}};
    std::vector<std::size_t> order = {0, 1, 2, 3};
    for (int i = 0; i < 200; ++i) {
        std::ranges::shuffle(order, random);
        const std::string separator = std::vector<std::string>{",", ";", "\t", " ", " , "}.at(random() % 5);
        columns[3] = std::vector<std::string>{"t", "time", "Timestamp"}.at(random() % 3);
        columns[0] = std::vector<std::string>{"waist", "Waist", "WAIST"}.at(random() % 3);
        std::string text = random() % 2 == 0 ? "# a comment\n" : "";
        const auto add = [&](const std::vector<std::string>& cells) {
            for (const std::size_t column : order)
                text += cells[column] + separator;
            text += "\n";
        };
        add(columns);
        add(rows[0]);
        add(rows[1]);
        const ConfigurationRows read = read_configurations(text, robot);
        ASSERT_EQ(read.configurations.size(), 2U) << text;
        EXPECT_EQ(read.configurations[0], Eigen::Vector3d(0.5, -1.25, 3)) << text;
        EXPECT_EQ(read.configurations[1], Eigen::Vector3d(0.75, 2, -4)) << text;
        EXPECT_EQ(read.stamps, (std::vector<double>{-1, 6})) << text;
        EXPECT_TRUE(read.warnings.empty()) << text;
    }
}

TEST(JointPathFile, ReadsDegreesByTheEndingDeg) {
    const ConfigurationRows rows = read_configurations("waist_deg,elbow,slide\n180,1,2\n-90,0,0\n", arm());
    EXPECT_EQ(rows.configurations[0], Eigen::Vector3d(std::numbers::pi, 1, 2));
    EXPECT_EQ(rows.configurations[1], Eigen::Vector3d(-std::numbers::pi / 2, 0, 0));
    EXPECT_EQ(read_configurations("Elbow_DEG\n180\n90\n", arm()).configurations[0][1], std::numbers::pi);
    EXPECT_EQ(refused("slide_deg\n1\n2\n", arm()),
              "line 1: the column 'slide_deg' has degrees, but the variable 'slide' is no angle");
    EXPECT_EQ(refused("waist,waist_deg\n1,2\n2,3\n", arm()),
              "line 1: the header 'waist, waist_deg' has two columns for one variable: 'waist' and 'waist_deg'");
    const Robot named = chain_of({{"waist_deg", JointType::revolute}});
    EXPECT_EQ(read_configurations("waist_deg\n1\n2\n", named).configurations[0][0], 1) << "its name, not its unit";
    const Robot both = chain_of({{"waist_deg", JointType::revolute}, {"waist", JointType::revolute}});
    EXPECT_EQ(refused("waist_deg\n1\n2\n", both),
              "line 1: the column 'waist_deg' may be the variable 'waist_deg', or 'waist' in degrees");
    const Robot planar = chain_of({{"base", JointType::planar}});
    EXPECT_EQ(read_configurations("base/theta_deg\n180\n0\n", planar).configurations[0][2], std::numbers::pi);
    EXPECT_NE(refused("base/x_deg\n180\n0\n", planar).find("is no angle"), std::string::npos);
}

/// A column that was left out would leave the joint where it is, and the answer would be about another motion.
TEST(JointPathFile, ReadsUnitsInBrackets) {
    for (const char* const header : {"waist[rad],slide[m]", "Waist [RAD] , SLIDE [ m ]", "waist[],slide",
                                     "waist (rad);slide (m)", "waist[radians],slide[]"}) {
        const ConfigurationRows rows =
            read_configurations(std::string(header) + "\n0.5" +
                                    (std::string(header).find(';') == std::string::npos ? ",2\n1,3\n" : ";2\n1;3\n"),
                                arm());
        EXPECT_EQ(rows.configurations[0], Eigen::Vector3d(0.5, 0, 2)) << header;
        EXPECT_EQ(rows.configurations[1], Eigen::Vector3d(1, 0, 3)) << header;
        EXPECT_EQ(rows.warnings, (std::vector<std::string>{without("elbow")})) << header;
    }
    for (const char* const header : {"waist[deg]", "WAIST [Degrees]", "waist(deg)", "waist_deg[deg]", "waist_deg[]"})
        EXPECT_EQ(read_configurations(std::string(header) + "\n180\n90\n", arm()).configurations[0][0],
                  std::numbers::pi)
            << header;
    const Robot named = chain_of({{"waist[deg]", JointType::revolute}});
    EXPECT_EQ(read_configurations("waist[deg]\n1\n2\n", named).configurations[0][0], 1) << "its name, not its unit";
    const ConfigurationRows comment = read_configurations("# slide[m]\n7\n8\n", arm());
    EXPECT_EQ(comment.configurations[1], Eigen::Vector3d(0, 0, 8));
}

/// Each pair of brackets is no unit of its own, which took gigabytes for some kilobytes.
TEST(JointPathFile, ManyBracketsTakeNoTime) {
    for (const char* const brackets : {"[]", " [", "()", " [a] "}) {
        std::string header = "slide";
        for (int i = 0; i < 100'000; ++i)
            header += brackets;
        EXPECT_THROW(static_cast<void>(read_configurations(header + ",waist\n1,2\n3,4\n", arm())), InvalidInput);
        EXPECT_THROW(static_cast<void>(read_configurations(header + " waist\n1 2\n3 4\n", arm())), InvalidInput);
    }
}

TEST(JointPathFile, ReadsStampsWithAUnit) {
    for (const char* const time :
         {"t[s]", "Time [s]", "timestamp [ns]", "time(ms)", "t[]", "time_from_start", "Time_From_Start [s]", "stamp",
          "stamp[ns]", "header.stamp", "header/stamp", "__time"}) {
        const ConfigurationRows rows = read_configurations(std::string(time) + ",waist\n1,0\n3,1\n", arm());
        EXPECT_EQ(rows.stamps, (std::vector<double>{1, 3})) << time;
        EXPECT_EQ(rows.warnings, (std::vector<std::string>{without("elbow, slide")})) << time;
    }
}

TEST(JointPathFile, RefusesUnitsThatItDoesNotRead) {
    const std::string is_not_read = " has a unit that is not read; the variable ";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"slide[mm]", "'slide[mm]'" + is_not_read + "'slide' may have [m], or no unit: convert the numbers"},
        {"slide[rad]", "'slide[rad]'" + is_not_read + "'slide' may have [m], or no unit: convert the numbers"},
        {"Waist [m]", "'Waist [m]'" + is_not_read + "'waist' may have [rad] or [deg], or no unit: convert the numbers"},
        {"waist_deg[rad]",
         "'waist_deg[rad]'" + is_not_read + "'waist' may have [rad] or [deg], or no unit: convert the numbers"},
        {"slide (deg)", "'slide (deg)' has degrees, but the variable 'slide' is no angle"},
    };
    for (const auto& [header, message] : cases)
        EXPECT_EQ(refused(header + ",elbow\n0,0\n1,1\n", arm()), "line 1: the column " + message);
    EXPECT_EQ(refused("waist,waist[deg]\n0,0\n1,1\n", arm()),
              "line 1: the header 'waist, waist[deg]' has two columns for one variable: 'waist' and 'waist[deg]'");
}

/// Columns of recordings, as PlotJuggler writes them.
TEST(JointPathFile, ReadsPositionsOfRecordings) {
    for (const char* const name : {"waist.position", "/joint_states/waist/position", "joint_states.Waist.Position",
                                   "/joint_states/waist.position", "/waist/position[rad]"}) {
        const ConfigurationRows rows =
            read_configurations("__time," + std::string(name) + ",/joint_states/waist/velocity\n1,0,0\n3,1,0\n", arm());
        EXPECT_EQ(rows.stamps, (std::vector<double>{1, 3})) << name;
        EXPECT_GT(rows.configurations[1][0], 0) << name;
        EXPECT_EQ(rows.warnings[0],
                  "line 1: ignored columns: '/joint_states/waist/velocity'; the robot has no variables "
                  "of these names");
    }
    EXPECT_EQ(refused("/goal/waist/position,/state/waist/position\n0,0\n1,1\n", arm()),
              "line 1: the header '/goal/waist/position, /state/waist/position' has two columns for one variable: "
              "'/goal/waist/position' and '/state/waist/position'");
    for (const char* const name : {"waistposition", "x_waist/position", "/position", "position", "/x/position"})
        EXPECT_NE(refused(std::string(name) + "\n0\n1\n", arm()), "") << name;
}

/// Other ways to write a unit are not read, and never left out either.
TEST(JointPathFile, LeavesNoColumnOfAJointOut) {
    for (const char* const name : {"slide_m", "slide_mm", "Slide.pos", "slide_position", "SLIDE_value", "slide_joint",
                                   "arm1/slide", "robot_slide", "sldie"})
        EXPECT_EQ(refused("waist," + std::string(name) + "\n0,0\n1,1\n", arm()),
                  "line 1: the column '" + std::string(name) +
                      "' is no variable of the robot; it may be a misspelt 'slide', which has no column, or one to "
                      "leave out of the file");
    EXPECT_NE(refused("waist_rad,slide\n0,0\n1,1\n", arm()).find("misspelt 'waist'"), std::string::npos);
    EXPECT_EQ(read_configurations("waist,waist_rad\n0,0\n1,1\n", arm()).warnings.size(), 2U) << "it has a column";
    for (const char* const name : {"slide_effort", "effort_slide", "wrist"})
        EXPECT_EQ(read_configurations("waist," + std::string(name) + "\n0,0\n1,1\n", arm()).warnings.size(), 2U)
            << name;
    const std::vector<std::string> names = {"waist", "slide[m]"};
    const Robot robot = arm();
    EXPECT_NE(message_of([&] { (void)JointColumns(names, robot, JointUnits::radians); }).find("misspelt 'slide'"),
              std::string::npos);
}

TEST(JointPathFile, NamesWhatItDoesNotRead) {
    const ConfigurationRows rows = read_configurations("effort,waist,mount,\nnone,0,x\n?,1,y\n", arm());
    EXPECT_EQ(rows.configurations[1], Eigen::Vector3d(1, 0, 0));
    EXPECT_EQ(rows.warnings,
              (std::vector<std::string>{"line 1: ignored columns: 'mount', which is fixed",
                                        "line 1: ignored columns: 'effort'; the robot has no variables of these names",
                                        without("elbow, slide")}));
}

TEST(JointPathFile, NamesJointsThatHaveNoVariable) {
    RobotDescription hand;
    hand.links = {{"palm"}, {"left"}, {"right"}, {"ball"}};
    hand.joints = {{.name = "left", .type = JointType::prismatic, .parent = "palm", .child = "left"},
                   {.name = "right", .type = JointType::prismatic, .parent = "palm", .child = "right"},
                   {.name = "ball", .type = JointType::floating, .parent = "palm", .child = "ball"}};
    hand.joints[1].mimic = MimicDescription{"left"};
    const std::vector<std::string> warnings =
        read_configurations("left,right,ball\n0,0,0\n1,1,1\n", Robot(hand)).warnings;
    ASSERT_EQ(warnings.size(), 3U);
    EXPECT_EQ(warnings[0], "line 1: ignored columns: 'right', which follows 'left'");
    EXPECT_EQ(warnings[1], "line 1: ignored columns: 'ball', which has several variables");
}

/// The line, the column and the number of the file, in its unit.
TEST(JointPathFile, NamesValuesThatAreTooLarge) {
    const std::string turns =
        " is beyond 1000 radians (57295.8 degrees), the largest value: take whole turns off all its "
        "values";
    EXPECT_EQ(refused("waist,slide,elbow_deg\n0,0,1\n0,0,100000\n", arm()), "line 3: elbow_deg: 100000" + turns);
    EXPECT_EQ(refused("waist,slide,elbow\n1001,0,1\n0,0,0\n", arm()), "line 2: waist: 1001" + turns);
    EXPECT_EQ(refused("waist,slide,elbow\n0,-2000,1\n0,0,0\n", arm()),
              "line 2: slide: -2000 is beyond 1000, the largest value: choose a larger unit of length");
}

/// Of two readings none is taken in silence.
TEST(JointPathFile, RefusesHeadersAndShowsThem) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"wrist,hand\n0,0\n",
         "line 1: the header 'wrist, hand' names no variable of the robot, which has 'waist, elbow, "
         "slide'; fixed joints and joints that follow others have none"},
        {"waist,elbo\n0,0\n",
         "line 1: the column 'elbo' is no variable of the robot; it may be a misspelt 'elbow', which "
         "has no column, or one to leave out of the file"},
        {"waist,elbow,waist\n0,0,0\n", "line 1: the column 'waist' comes twice in the header 'waist, elbow, waist'"},
        {"waist,Waist\n0,0\n",
         "line 1: the header 'waist, Waist' has two columns for one variable: 'waist' and 'Waist'"},
        {"t,time,waist\n0,0,0\n", "line 1: the header 't, time, waist' has two columns for the time: 't' and 'time'"},
        {"time_from_start,waist,stamp\n0,0,0\n", "line 1: the header 'time_from_start, waist, stamp' has two columns "
                                                 "for the time: 'time_from_start' and 'stamp'"},
        {"0,0\n1,1\n",
         "line 1: there is no header, but 2 numbers in the first line; the first line has to name variables "
         "of the robot, of 'waist, elbow, slide'"},
        {"waist;elbow\n0;0\n1;0,5\n", "line 3: elbow: not a finite number: '0,5'; write a decimal point"},
        {"waist elbow\n0\n", "line 2: 1 column found, 2 expected"},
        {"t,waist\n0,0\n0,1\n", "line 3: t: must increase, but is 0 after 0"},
        {"t,waist\n1732800000000000000,0\n1732800000000000100,1\n",
         "line 3: t: must increase, but is 1.7328e+18 after 1.7328e+18; doubles do not tell such numbers apart: "
         "count from the first one"},
        {"waist\n0\n", "a path needs at least two configurations, and there are 1; repeat the row to ask about this "
                       "configuration at rest"},
        {"t,waist\n0,0\n",
         "a path needs at least two configurations, and there are 1; repeat the row with a later time "
         "to ask about this configuration at rest"},
        {"waist\n", "a path needs at least two configurations, and there are 0"},
    };
    for (const auto& [text, message] : cases)
        EXPECT_EQ(refused(text, arm()), message);
    const Robot two = chain_of({{"A", JointType::revolute}, {"a", JointType::revolute}, {"T", JointType::revolute}});
    EXPECT_EQ(read_configurations("A,t\n1,2\n3,4\n", two).configurations[0], Eigen::Vector3d(1, 0, 2))
        << "a joint may be called T";
    const Robot pair = chain_of({{"Ab", JointType::revolute}, {"aB", JointType::revolute}});
    EXPECT_EQ(refused("ab\n0\n1\n", pair), "line 1: the column 'ab' may be the variable 'Ab' or 'aB'");
}

/// A robot's joints may be called 1, 2 and 3; and numpy writes the header as a comment.
TEST(JointPathFile, TellsNamesFromNumbers) {
    const Robot numbered = chain_of({{"1", JointType::revolute}, {"2", JointType::revolute}});
    EXPECT_EQ(read_configurations("2 1\n0.5 7\n1 8\n", numbered).configurations[1], Eigen::Vector2d(8, 1));
    EXPECT_EQ(read_configurations("# elbow waist\n0.5 7\n1 8\n", arm()).configurations[0], Eigen::Vector3d(7, 0.5, 0));
    EXPECT_EQ(read_configurations("# slide\n7\n8\n", arm()).configurations[1], Eigen::Vector3d(0, 0, 8));
}

} // namespace
} // namespace chasles::robot
