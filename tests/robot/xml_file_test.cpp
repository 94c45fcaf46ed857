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
    EXPECT_EQ(refused("xyz=\"1 2 3\"", "xyz=\"1,2 3\""),
              "robot.urdf:5: <origin>: xyz: '1,2' is not a finite number; blanks separate numbers");
}

TEST_F(XmlFileTest, NamesWhatOtherFilesAre) {
    const auto whole = [&](const std::string& content) {
        return without_folder(message_of([&] { (void)robot::read_urdf(write("robot.urdf", content), {}); }));
    };
    EXPECT_EQ(whole("<mujoco model=\"arm\"/>"),
              "robot.urdf:1: the root element must be <robot>, and is <mujoco>: models of "
              "MuJoCo (MJCF) are not read; write the robot as URDF");
    EXPECT_EQ(whole("\n<sdf version=\"1.6\"/>"),
              "robot.urdf:2: the root element must be <robot>, and is <sdf>: files of SDF "
              "(SDFormat) are not read; write the robot as URDF");
    EXPECT_EQ(whole("<svg/>"), "robot.urdf:1: the root element must be <robot>, and is <svg>");
    EXPECT_EQ(whole("PK\x03\x04"), "robot.urdf: is a ZIP archive; unpack it first, or name it .3mf if it is one");
    EXPECT_EQ(whole("\x1F\x8B\x08"), "robot.urdf: is compressed by gzip; unpack it first");
    for (const char* const text : {"v 0 0 0\nv 1 0 0\n", "shoulder,elbow\n0,0\n", "{\"links\": []}"})
        EXPECT_EQ(whole(text),
                  "robot.urdf: is no XML; a robot is read from a URDF file, and its pairs from an SRDF file");
}

/// A misspelt element would be left out, and with it a shape or a place.
TEST_F(XmlFileTest, RefusesMisspeltElements) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"<collision>", "colision"},
        {"<collision>", "Collision"},
        {"<collision>", "collisions"},
        {"<origin xyz", "orgin"},
        {"<geometry><box", "geomerty"},
        {"<link name=\"arm\"", "Link"},
        {"<joint", "Joint"},
        {"<joint", "jiont"},
        {"<axis", "Axis"},
        {"<limit", "limits"},
        {"<limit", "Limit"},
        {"<parent", "parnet"},
    };
    for (const auto& [before, wrong] : cases) {
        const std::string text = refused(before, '<' + wrong + " name=\"x\"/>" + before);
        EXPECT_NE(text.find(": <" + wrong + " x>: is not read; if <"), std::string::npos) << text;
    }
    EXPECT_EQ(refused("<collision>", "<colision/><collision>"),
              "robot.urdf:5: <colision>: is not read; if <collision> is meant, write it so");
    for (const auto& [right, wrong] :
         std::vector<std::pair<std::string, std::string>>{{"xyz=\"1 2 3\"", "xyx=\"1 2 3\""},
                                                          {"xyz=\"1 2 3\"", "XYZ=\"1 2 3\""},
                                                          {"rpy=\"0.1", "ryp=\"0.1"},
                                                          {"lower=", "lowr="},
                                                          {"upper=", "Upper="}})
        EXPECT_NE(refused(right, wrong).find("the attribute " + wrong.substr(0, wrong.find('=')) + " is not read; if "),
                  std::string::npos)
            << refused(right, wrong);
    EXPECT_NE(refused("<limit", "<mimic joint=\"x\" Offset=\"1\"/><limit").find("if offset is meant"),
              std::string::npos);
    EXPECT_EQ(refused("<box size=\"1 2 3\"/>", R"(<mesh filename="cube.obj" scales="2 2 2"/>)"),
              "robot.urdf:5: <mesh>: the attribute scales is not read; if scale is meant, write it so");
    for (const char* const other : {"<linkage/>", "<drake:Joint/>", "<sensor/>", "<contact/>", "<lin/>"})
        EXPECT_EQ(read("</robot>", std::string(other) + "</robot>").links.size(), 2U) << other;
}

/// A capsule that somebody has called a sphere would be a sphere.
TEST_F(XmlFileTest, RefusesAttributesOfOtherShapes) {
    const std::string box = "<box size=\"1 2 3\"/>";
    EXPECT_EQ(refused(box, R"(<sphere radius="1" length="3"/>)"),
              "robot.urdf:5: <sphere>: the attribute length is not read; a sphere has radius");
    EXPECT_EQ(refused(box, R"(<box size="1 2 3" radius="1"/>)"),
              "robot.urdf:5: <box>: the attribute radius is not read; a box has size");
    EXPECT_EQ(refused(box, R"(<capsule radius="1" length="3" Size="1"/>)"),
              "robot.urdf:5: <capsule>: the attribute Size is not read; a capsule has radius and length");
    EXPECT_EQ(refused(box, R"(<cylinder radius="1" length="3" scale="1 1 1"/>)"),
              "robot.urdf:5: <cylinder>: the attribute scale is not read; a cylinder has radius and length");
    EXPECT_EQ(refused(box, R"(<mesh filename="cube.obj" size="1 1 1"/>)"),
              "robot.urdf:5: <mesh>: the attribute size is not read; a mesh has filename and scale");
}

TEST_F(XmlFileTest, AShapeAndTheAddedRadiusStayAboveZero) {
    const auto shrunk = [&](const std::string& shape, double radius) {
        return without_folder(message_of([&] { (void)shape_of(shape, {.radius = radius}); }));
    };
    EXPECT_EQ(shrunk(R"(<capsule radius="0.0625" length="1"/>)", -0.125),
              "robot.urdf:5: <capsule>: radius: that of the shape, 0.0625, and the added one, -0.125, must be above 0 "
              "together");
    EXPECT_EQ(shrunk(R"(<sphere radius="0.0625"/>)", -0.0625),
              "robot.urdf:5: <sphere>: radius: that of the shape, 0.0625, and the added one, -0.0625, must be above 0 "
              "together");
}

} // namespace
} // namespace chasles::tests
