// COLLADA: polygons, nodes and units mean what the specification says, and bad files get one line.
#include "chasles/io/mesh_files.h"
#include "tests/io/message_of.h"
#include "tests/io/post_files.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::io {
namespace {

using tests::message_of;
using Face = std::vector<std::uint32_t>;

// A document with the corners of a unit square, and these primitives, nodes, unit and further libraries.
struct Document {
    std::string primitives = R"(<polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<vcount>4</vcount><p>0 1 2 3</p></polylist>)";
    std::string nodes = R"(<node name="n"><instance_geometry url="#g"/></node>)";
    std::string unit = R"(<unit meter="1"/>)";
    std::string libraries{};

    [[nodiscard]] std::string text() const {
        return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
               unit + R"(<up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)" +
               primitives + "</mesh></geometry></library_geometries>" + libraries +
               R"(<library_visual_scenes><visual_scene id="s">)" + nodes +
               R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
    }
};

std::vector<MeshPart> read(const Document& document) {
    return read_collada(document.text());
}

std::string message(const Document& document) {
    return message_of([&] { (void)read(document); });
}

// `element` with one input and these lists.
Document with(const std::string& element, const std::string& lists) {
    return {.primitives = "<" + element + R"(><input semantic="VERTEX" source="#v" offset="0"/>)" + lists + "</" +
                          element.substr(0, element.find(' ')) + ">"};
}

std::vector<Face> faces(const Document& document) {
    return read(document).at(0).polygons.faces;
}

TEST(ReadCollada, ReadsEveryKindOfPolygons) {
    EXPECT_EQ(faces({}), (std::vector<Face>{{0, 1, 2, 3}})) << "polygons are not cut";
    EXPECT_EQ(faces(with(R"(triangles count="2")", "<p>0 1 2 0 2 3</p>")), (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(faces(with("polygons", "<p>0 1 2</p><p>0 1 2 3</p>")), (std::vector<Face>{{0, 1, 2}, {0, 1, 2, 3}}));
    EXPECT_EQ(faces(with("tristrips", "<p>0 1 2 3</p>")), (std::vector<Face>{{0, 1, 2}, {2, 1, 3}}));
    EXPECT_EQ(faces(with("trifans", "<p>0 1 2 3</p>")), (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(faces(with("polylist", "<vcount>2 3 1</vcount><p>0 1 1 2 3 0</p>")), (std::vector<Face>{{0, 1, 2}}))
        << "points and lines have no area";
    EXPECT_TRUE(read(with("lines", "<p>0 1</p>")).empty());
}

TEST(ReadCollada, TakesTheVerticesAmongSeveralInputs) {
    const Document document{.primitives = R"(<triangles count="1"><input semantic="NORMAL" source="#n" offset="0"/>
<input semantic="VERTEX" source="#v" offset="1"/><input semantic="TEXCOORD" source="#t" offset="2"/>
<p>9 1 9 9 2 9 9 3 9</p></triangles>)"};
    EXPECT_EQ(faces(document), (std::vector<Face>{{0, 1, 2}}));
    const std::vector<Eigen::Vector3d> all = read({}).at(0).polygons.vertices;
    EXPECT_EQ(read(document).at(0).polygons.vertices, (std::vector<Eigen::Vector3d>{all[1], all[2], all[3]}));
}

TEST(ReadCollada, AppliesUnitsAndTransformsInOrder) {
    Document document;
    document.unit = R"(<unit meter="0.25" name="quarter"/>)";
    document.nodes = R"(<node name="n"><translate>4 0 0</translate><rotate>0 0 1 90</rotate><scale>2 3 4</scale>
<node><matrix>1 0 0 8  0 1 0 0  0 0 1 0  0 0 0 1</matrix><instance_geometry url="#g"/></node></node>)";
    const PolygonSoup mesh = read(document).at(0).polygons;
    // (1, 1, 0) + (8, 0, 0), scaled to (18, 3, 0), turned to (-3, 18, 0), moved to (1, 18, 0), in metres.
    EXPECT_EQ(mesh.vertices[2], Eigen::Vector3d(0.25, 4.5, 0)) << "a quarter turn is exact";
    document.unit = "";
    EXPECT_EQ(read(document).at(0).polygons.vertices[2], Eigen::Vector3d(1, 18, 0)) << "metres without a unit";
    document.unit = R"(<unit meter="0"/>)";
    EXPECT_EQ(message(document), "line 1: <unit>: meter: must be one positive number, not '0'");
}

TEST(ReadCollada, TurnsAboutAnyAxis) {
    Document document;
    document.unit = "";
    const Eigen::Vector3d axis(1, 2, 3);
    for (const double degrees : {120.0, -30.0, 0.1, 179.0, 540.0, 725.0}) {
        document.nodes = "<node name=\"n\"><rotate>1 2 3 " + std::to_string(degrees) +
                         "</rotate><instance_geometry url=\"#g\"/></node>";
        Document plain;
        plain.unit = "";
        plain.nodes = R"(<node name="n"><instance_geometry url="#g"/></node>)";
        const PolygonSoup turned = read(document).at(0).polygons, mesh = read(plain).at(0).polygons;
        const Eigen::AngleAxisd expected(degrees * std::numbers::pi / 180, axis.normalized());
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
            EXPECT_NEAR((turned.vertices[i] - expected * mesh.vertices[i]).norm(), 0, 1e-14) << degrees;
    }
}

TEST(ReadCollada, PlacesInstancesOfNodesAndNamesThem) {
    Document document;
    document.libraries = R"(<library_nodes><node id="lib"><instance_geometry url="#g"/></node></library_nodes>)";
    document.nodes = R"(<node name="left"><instance_node url="#lib"/></node>
<node name="right"><translate>5 0 0</translate><instance_node url="#lib"/></node><node><instance_geometry url="#g"/></node>)";
    const std::vector<MeshPart> parts = read(document);
    ASSERT_EQ(parts.size(), 3U);
    EXPECT_EQ(parts[0].name, "lib");
    EXPECT_EQ(parts[1].name, "lib_2");
    EXPECT_EQ(parts[2].name, "g") << "neither the node nor one above it has a name";
    EXPECT_EQ(parts[1].polygons.vertices[1], Eigen::Vector3d(6, 0, 0));
    document.libraries = R"(<library_nodes><node id="lib"><instance_node url="#lib"/></node></library_nodes>)";
    EXPECT_EQ(message(document), "node 'lib' contains itself");
}

TEST(ReadCollada, TakesSkinsInTheirBindPose) {
    Document document;
    document.libraries = R"(<library_controllers><controller id="c"><skin source="#g">
<bind_shape_matrix>2 0 0 1  0 2 0 0  0 0 2 0  0 0 0 1</bind_shape_matrix></skin></controller></library_controllers>)";
    document.nodes = R"(<node name="n"><instance_controller url="#c"/></node>)";
    EXPECT_EQ(read(document).at(0).polygons.vertices[1], Eigen::Vector3d(3, 0, 0));
    EXPECT_EQ(read(document).at(0).name, "n");
}

TEST(ReadCollada, RefusesWhatWouldBeLostWithItsLine) {
    EXPECT_EQ(message(with("polygons", "\n<ph><p>0 1 2</p><h>0 1 3</h></ph>")),
              "line 5: <polygons>: polygons with holes are not read; triangulate them");
    EXPECT_EQ(message(with(R"(triangles count="2")", "<p>0 1 2</p>")),
              "line 5: <triangles>: announces 2 items, but there are 1");
    EXPECT_EQ(message(with("triangles", "<p>0 1</p>")), "line 5: <triangles>: 2 corners are no whole triangles");
    EXPECT_EQ(message(with("triangles", "\n<p>0 1 4</p>")),
              "line 6: <p>: vertex index 4 is out of range; there are 4 vertices, counted from 0");
    EXPECT_EQ(message(with("polylist", "<vcount>3</vcount><p>0 1 2 3</p>")),
              "line 5: <polylist>: <vcount> announces 3 corners, but there are 4");
    EXPECT_EQ(message({.nodes = R"(<node><skew>1 0 0 0 1 0 0</skew></node>)"}),
              "line 6: <skew>: shearing transforms are not read; export the node with a <matrix>");
    EXPECT_EQ(message({.nodes = R"(<node><instance_geometry url="other.dae#g"/></node>)"}),
              "line 6: <instance_geometry>: refers to another file, which is not read: 'other.dae#g'");
    EXPECT_EQ(message({.nodes = R"(<node><instance_geometry url="#x"/></node>)"}),
              "line 6: <instance_geometry>: there is no <geometry> with the id 'x'");
    EXPECT_TRUE(read({.nodes = ""}).empty());
    EXPECT_EQ(message_of([] { (void)read_collada("<a/>"); }), "the root element must be <COLLADA>, not 'a'");
    EXPECT_EQ(message_of([] { (void)read_collada("<COLLADA>"); }),
              "line 1: is no well-formed XML (XML_ERROR_MISMATCHED_ELEMENT)");
}

TEST(ReadCollada, RefusesNumbersThatAreNotFinite) {
    std::string text = tests::post_collada("Y_UP");
    text.replace(text.find("0.0625"), 6, "nan");
    EXPECT_EQ(message_of([&] { (void)read_collada(text); }), "line 4: <float_array>: '-nan' is not a finite number");
    text.replace(text.find("-nan"), 4, "0,0625");
    EXPECT_EQ(message_of([&] { (void)read_collada(text); }),
              "line 4: <float_array>: '0,0625' is not a finite number; write a decimal point");
}

TEST(ReadCollada, DeepAndWideElementsCostOneLine) {
    std::string deep = "<COLLADA>";
    for (int i = 0; i < 30'000; ++i)
        deep += "<node>";
    EXPECT_EQ(message_of([&] { (void)read_collada(deep); }),
              "line 1: is no well-formed XML (XML_ELEMENT_DEPTH_EXCEEDED)");
    for (const char* const value : {"=''", "=\"<a\"", "='>'", "=\"<!--\""}) {
        std::string wide = "<?xml version='1.0'?><!-- < ' --><COLLADA";
        for (int i = 0; i < 100'000; ++i)
            wide += " a" + std::to_string(i) + value;
        EXPECT_EQ(message_of([&] { (void)read_collada(wide + "/>"); }), "an element has more than 1,000 attributes");
    }
    EXPECT_TRUE(message_of([&] { (void)read_collada("<COLLADA a='"); }).starts_with("line 1: is no well-formed XML"));
    Document chain; // of nodes that refer to nodes
    chain.libraries = "<library_nodes>";
    for (int i = 0; i < 30'000; ++i)
        chain.libraries +=
            "<node id=\"n" + std::to_string(i) + "\"><instance_node url=\"#n" + std::to_string(i + 1) + "\"/></node>";
    chain.libraries += "<node id=\"n30000\"><instance_geometry url=\"#g\"/></node></library_nodes>";
    chain.nodes = R"(<node><instance_node url="#n0"/></node>)";
    EXPECT_EQ(read(chain).at(0).name, "n30000");
}

TEST(ReadCollada, TakesTimeInProportionToTheFile) {
    constexpr std::size_t count = 30'000; // a square of it would take minutes
    std::string outlines;
    std::string primitives;
    for (std::size_t i = 0; i < count; ++i) {
        outlines += "<p>0 1 2</p>";
        primitives +=
            R"(<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>)";
    }
    EXPECT_EQ(faces(with("polygons", outlines)).size(), count);
    EXPECT_EQ(faces({.primitives = primitives}).size(), count);
}

} // namespace
} // namespace chasles::io
