// XML as robots' files have it: encodings, elements that come twice, and files that have to be expanded first.
#include "chasles/robot/xml_file.h"

#include "tests/robot/urdf_file.h"

namespace chasles::tests {
namespace {

class XmlFileTest : public UrdfFile {};

TEST_F(XmlFileTest, ReadsWhatEditorsAdd) {
    const auto links_of = [&](const std::string& text, const std::string& by) { return read(text, by).links.size(); };
    EXPECT_EQ(links_of("<?xml", "\xEF\xBB\xBF<?xml"), 2U) << "a byte order mark";
    EXPECT_EQ(links_of("<robot", "<!-- of -- two links -->\r\n<robot"), 2U);
    EXPECT_EQ(links_of("</robot>", "<gazebo:x/><transmission><joint name=\"turn\"/></transmission></robot>"), 2U);
    EXPECT_EQ(read("name=\"small\"", "name=\"kl\xC3\xA4rlich\"").name, "kl\xC3\xA4rlich");
}

TEST_F(XmlFileTest, RefusesOtherEncodings) {
    EXPECT_EQ(refused("<?xml version=\"1.0\"?>", "\xFF\xFE"),
              "robot.urdf:1: is text in UTF-16 or UTF-32; save it as UTF-8");
    for (const char* const wrong : {"\xE4", "\xC3", "a\xC3z", "\x80", "\xFF", "\xE2\x82", "\xC0\x80"})
        EXPECT_NE(refused("name=\"base\"", std::string("name=\"b") + wrong + "\"").find("is not in UTF-8"),
                  std::string::npos);
}

/// The parser takes time in proportion to the square of their number.
TEST_F(XmlFileTest, RefusesManyAttributesAndZeroBytes) {
    std::string wide = "<robot";
    for (int i = 0; i < 100'000; ++i)
        wide += " a" + std::to_string(i) + "='<'";
    EXPECT_EQ(refused("<robot", wide), "robot.urdf:1: an element has more than 1,000 attributes");
    EXPECT_EQ(refused("</robot>", std::string("\0</robot>", 9)), "robot.urdf:1: is no XML: has a zero byte");
}

/// Other readers leave these parts out without a message.
TEST_F(XmlFileTest, RefusesWhatWouldBeLeftOut) {
    EXPECT_EQ(refused("</robot>", "</robot><robot name=\"other\"/>"),
              "robot.urdf:11: <robot>: a file has one root element only");
    EXPECT_EQ(refused("<link name=\"base\"/>", "<link name=\"base\"/><xacro:arm prefix=\"left\"/>"),
              "robot.urdf:3: <xacro:arm>: is source of xacro; expand the file first (xacro FILE > ROBOT.urdf)");
    EXPECT_EQ(refused("xyz=\"1 2 3\"", "xyz=\"1 2 ${height}\""),
              "robot.urdf:5: <origin>: xyz: '1 2 ${height}' is source of xacro; expand the file first (xacro FILE > "
              "ROBOT.urdf)");
    EXPECT_EQ(refused("<axis xyz=\"0 0 2\"/>", "<axis xyz=\"0 0 2\"/><axis xyz=\"0 0 1\"/>"),
              "robot.urdf:8: <axis>: <joint> has another one already");
    EXPECT_EQ(read("<axis xyz=\"0 0 2\"/>", "<axis xyz=\"0 0 2\"/><axis xyz=\"0 0 2\"/>").joints[0].axis.z(), 2)
        << "the same again says nothing else";
    EXPECT_EQ(refused("xyz=\"1 2 3\"", "xyz=\"1, 2, 3\""),
              "robot.urdf:5: <origin>: xyz: '1,' is not a finite number; blanks separate numbers");
}

} // namespace
} // namespace chasles::tests
