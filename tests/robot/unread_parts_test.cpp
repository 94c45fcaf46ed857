// Warnings about parts of a robot's files that are not read.
#include "chasles/robot/unread_parts.h"

#include "tests/robot/urdf_file.h"

#include <gtest/gtest.h>
#include <utility>

namespace chasles::tests {
namespace {

using Texts = std::vector<std::string>;

class UnreadParts : public UrdfFile {
protected:
    [[nodiscard]] Texts named(const RobotDescription& robot) const {
        Texts warnings;
        for (const std::string& warning : robot.warnings)
            warnings.push_back(without_folder(warning));
        return warnings;
    }
    [[nodiscard]] Texts of_urdf(const std::string& text, const std::string& by) const { return named(read(text, by)); }
    [[nodiscard]] Texts of_srdf(const std::string& content) const {
        RobotDescription robot = read("", "");
        robot::read_srdf(write("robot.srdf", "<robot name=\"small\">\n" + content + "\n</robot>"), robot);
        return named(robot);
    }
};

TEST_F(UnreadParts, AnAttributeOfAnyElementOfAURDFFileMakesAWarning) {
    const std::vector<std::pair<std::string, std::string>> elements{
        {"<robot", "2: <robot small>"}, {"<link", "3: <link base>"}, {"<collision", "5: <collision>"},
        {"<origin", "5: <origin>"},     {"<geometry><box", ""},      {"<box", "5: <box>"},
        {"<joint", "7: <joint turn>"},  {"<parent", "8: <parent>"},  {"<child", "8: <child>"},
        {"<axis", "8: <axis>"},         {"<limit", "9: <limit>"}};
    for (const auto& [begin, place] : elements)
        for (const std::string name : {"bogus", "other:bogus"}) {
            const bool is_geometry = place.empty();
            const std::string changed =
                is_geometry ? "<geometry " + name + "=\"1\"><box" : begin + " " + name + "=\"1\"";
            EXPECT_EQ(of_urdf(begin, changed), Texts({"robot.urdf:" + (is_geometry ? "5: <geometry>" : place) +
                                                      ": the attribute " + name + " is not read"}));
        }
    EXPECT_EQ(of_urdf("</joint>", "<mimic joint=\"none\" bogus=\"1\"/></joint>").size(), 2U);
}

TEST_F(UnreadParts, AnElementInAnyElementOfAURDFFileMakesAWarning) {
    for (const std::string name : {"bogus", "other:bogus"}) {
        const std::string added = "<" + name + "/>", is_not_read = ": <" + name + ">: is not read";
        EXPECT_EQ(of_urdf("</robot>", added + "</robot>"), Texts({"robot.urdf:11" + is_not_read}));
        EXPECT_EQ(of_urdf("</collision>", added + "</collision>"),
                  Texts({"robot.urdf:5" + is_not_read + " in <collision>"}));
        EXPECT_EQ(of_urdf("</link>", added + "</link>"), Texts({"robot.urdf:6" + is_not_read + " in <link>"}));
        EXPECT_EQ(of_urdf("</joint>", added + "</joint>"), Texts({"robot.urdf:10" + is_not_read + " in <joint>"}));
    }
    EXPECT_EQ(
        of_urdf("<box size=\"1 2 3\"/>", "<mesh filename=\"cube.obj\"><drake:declare_convex/></mesh>"),
        Texts({"robot.urdf:5: <drake:declare_convex>: is not read in <mesh>: the mesh is taken as it is, without its "
               "convex hull"}));
    EXPECT_EQ(of_urdf("<box size=\"1 2 3\"/>", "<box size=\"1 2 3\"/><other:ellipsoid/>"),
              Texts({"robot.urdf:5: <other:ellipsoid>: is not read in <geometry>"}));
}

TEST_F(UnreadParts, AnElementOrAnAttributeOfAnSRDFFileMakesAWarning) {
    EXPECT_EQ(of_srdf("<collision_margins default_margin=\"0.5\"><pair_margin/></collision_margins>"),
              Texts({"robot.srdf:2: <collision_margins>: is not read: the margins are those of the question"}));
    EXPECT_EQ(of_srdf("<link_sphere_approximation link=\"arm\"/>"),
              Texts({"robot.srdf:2: <link_sphere_approximation>: is not read"}));
    EXPECT_EQ(of_srdf("<disable_collisions link1=\"base\" link2=\"arm\" until=\"1\"/>"),
              Texts({"robot.srdf:2: <disable_collisions>: the attribute until is not read"}));
    EXPECT_EQ(of_srdf("<group name=\"g\"><frame name=\"f\"/></group>"),
              Texts({"robot.srdf:2: <frame f>: is not read in <group>"}));
    EXPECT_EQ(of_srdf("<group_state name=\"s\"><joint name=\"turn\" value=\"0\" speed=\"1\"/></group_state>"),
              Texts({"robot.srdf:2: <joint turn>: the attribute speed is not read"}));
}

/// A large robot says the same thing many times.
TEST_F(UnreadParts, AreCounted) {
    EXPECT_EQ(of_urdf("<limit", "<bogus/><bogus/><limit"),
              Texts({"robot.urdf:9: <bogus>: is not read in <joint>; it comes 2 times"}));
    std::string many;
    for (int i = 0; i < 25; ++i)
        many += "<bogus" + std::to_string(i) + "/>";
    const Texts warnings = of_urdf("</robot>", many + many + "</robot>");
    ASSERT_EQ(warnings.size(), 21U);
    EXPECT_EQ(warnings[19], "robot.urdf:11: <bogus19>: is not read; it comes 2 times");
    EXPECT_EQ(warnings[20], "robot.urdf: 5 more kinds of elements and attributes are not read");
}

TEST_F(UnreadParts, MakeNoWarningIfTheyCannotChangeWhatCollides) {
    EXPECT_EQ(of_urdf("<robot", "<robot xmlns=\"a\" xmlns:t=\"b\" t:make_convex=\"false\" xsi:schemaLocation=\"c\""),
              Texts());
    EXPECT_EQ(
        of_urdf("</robot>", "<!-- x --><material/><gazebo><any thing=\"1\"/></gazebo><transmission/><sensor/></robot>"),
        Texts());
    EXPECT_EQ(of_urdf("</link>", "<inertial><mass value=\"1\"/></inertial><contact/></link>"), Texts());
    EXPECT_EQ(of_urdf("<limit", "<dynamics damping=\"1\"/><safety_controller/><calibration/><limit acceleration=\"1\""),
              Texts());
    EXPECT_EQ(of_srdf("<end_effector name=\"e\"/><passive_joint name=\"turn\"/>"), Texts());
}

} // namespace
} // namespace chasles::tests
