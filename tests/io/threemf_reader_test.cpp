// 3MF and ZIP: items, components and parts mean what the specification says, and bad files get one line.
#include "chasles/io/mesh_files.h"
#include "chasles/io/zip_archive.h"
#include "tests/io/file_bytes.h"
#include "tests/io/message_of.h"

#include <gtest/gtest.h>

namespace chasles::io {
namespace {

using tests::message_of;
using tests::threemf;

const std::string mesh =
    R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/>
<vertex x="0" y="0" z="1"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/>
<triangle v1="1" v2="2" v3="3"/><triangle v1="0" v2="3" v3="2"/></triangles></mesh>)";

std::string model(const std::string& resources, const std::string& items, const std::string& attributes = "") {
    return R"(<model unit="inch" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" )"
           R"(xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" )" +
           attributes + "><resources>" + resources + "</resources><build>" + items + "</build></model>";
}

const std::string object = R"(<object id="1" name="wedge">)" + mesh + "</object>";
const std::string item = R"(<item objectid="1"/>)";

std::string message(const std::string& bytes) {
    return message_of([&] { (void)read_3mf(bytes); });
}

TEST(Read3mf, PlacesItemsAndComponents) {
    const std::string assembly = R"(<object id="2"><components>
<component objectid="1" transform="0 1 0 -1 0 0 0 0 1 5 0 0"/><component objectid="1"/></components></object>)";
    const std::vector<MeshPart> parts = read_3mf(threemf(
        model(object + assembly, R"(<item objectid="2" transform="2 0 0 0 2 0 0 0 2 0 0 7"/><item objectid="1"/>)")));
    ASSERT_EQ(parts.size(), 3U);
    EXPECT_EQ(parts[0].name, "wedge");
    EXPECT_EQ(parts[2].name, "wedge_3");
    // (1, 0, 0) is a row vector: its first row gives (0, 1, 0); then moved by (5, 0, 0), doubled, and raised by 7.
    EXPECT_EQ(parts[0].polygons.vertices[1], Eigen::Vector3d(10, 2, 7));
    EXPECT_EQ(parts[1].polygons.vertices[1], Eigen::Vector3d(2, 0, 7));
    EXPECT_EQ(parts[2].polygons.vertices[1], Eigen::Vector3d(1, 0, 0)) << "inches stay inches";
}

TEST(Read3mf, ReadsObjectsOfOtherParts) {
    const std::string other = model(R"(<object id="1"><components><component objectid="7"/></components></object>
<object id="7" name="inner">)" + mesh + "</object>",
                                    "");
    const std::string root = model(R"(<object id="1" name="outer"><components>
<component p:path="/3D/Objects/a.model" objectid="1"/></components></object>)",
                                   item, R"(requiredextensions="p")");
    const std::vector<MeshPart> parts = read_3mf(threemf(root, {{"3d/objects/A.model", other}}));
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].name, "inner");
    EXPECT_EQ(message(threemf(root)), "part '3D/3dmodel.model': has no part '3D/Objects/a.model'");
}

TEST(Read3mf, ASlicedFileHasNoMesh) {
    const std::string why = "has no mesh; if the file is sliced, export the project or the model instead";
    EXPECT_EQ(message(threemf(model("", ""), {{"Metadata/plate_1.gcode", "G1 X0\n"}})), why);
    EXPECT_EQ(message(threemf(model(object, ""))), why) << "the object is not placed";
}

TEST(Read3mf, APictureInTheArchiveIsIgnored) {
    EXPECT_EQ(read_3mf(threemf(model(object, item), {{"Metadata/thumbnail.png", std::string("\x89PNG\0", 5)}})).size(),
              1U);
}

TEST(Read3mf, RefusesWhatWouldBeLostByName) {
    const auto needs = [](const std::string& name) {
        return message(threemf(
            model(object, item,
                  R"(requiredextensions="b" xmlns:b="http://schemas.microsoft.com/3dmanufacturing/)" + name + "\"")));
    };
    const std::string end = ", which is not read; export as a plain mesh";
    EXPECT_EQ(needs("beamlattice/2017/02"), "part '3D/3dmodel.model': needs beam lattices" + end);
    EXPECT_EQ(needs("slice/2015/07"), "part '3D/3dmodel.model': needs slices" + end);
    EXPECT_EQ(needs("securecontent/2019/04"), "part '3D/3dmodel.model': needs encrypted content" + end);
    std::string lattice = object;
    lattice.insert(lattice.find("</mesh>"), "<b:beamlattice/>");
    EXPECT_EQ(message(threemf(model(lattice, item))),
              "part '3D/3dmodel.model': line 1: <mesh>: beam lattices are not read; export as a plain mesh");
    EXPECT_EQ(message(threemf(model(R"(<object id="1"><booleanshape/></object>)", item))),
              "part '3D/3dmodel.model': line 1: <booleanshape>: is not read; export as a plain mesh");
}

/// Slicers cut negative parts away, and only print with the others.
TEST(Read3mf, RefusesWhatSlicersDoNotPrintAsASolid) {
    const auto with = [](const std::string& name, const std::string& parts) {
        return threemf(model(object, item), {{name, R"(<config><object id="1">)" + parts + "</object></config>"}});
    };
    const std::string bambu = "Metadata/model_settings.config", prusa = "Metadata/Slic3r_PE_model.config";
    const std::string normal = R"(<part id="1" subtype="normal_part"><metadata key="name" value="plate"/></part>)";
    EXPECT_EQ(read_3mf(with(bambu, normal)).size(), 1U);
    for (const std::string kind : {"negative_part", "modifier_part", "support_blocker", "support_enforcer"})
        EXPECT_EQ(
            message(with(bambu, normal + "\n<part id=\"2\" subtype=\"" + kind +
                                    R"("><metadata key="name" value="hole"/></part>)")),
            "part 'Metadata/model_settings.config': line 2: <part>: 'hole' is a '" + kind +
                "', which is no solid body; cut it from the model, or remove it, in the slicer, and export again");
    const auto volume = [](const std::string& kind) {
        return R"(<volume firstid="0" lastid="3"><metadata type="volume" key="name" value="hole"/>)"
               R"(<metadata type="volume" key="volume_type" value=")" +
               kind + R"("/></volume>)";
    };
    EXPECT_EQ(read_3mf(with(prusa, volume("ModelPart"))).size(), 1U);
    EXPECT_NE(message(with(prusa, volume("ModelPart") + volume("NegativeVolume"))).find("'hole' is a 'NegativeVolume'"),
              std::string::npos);
}

TEST(Read3mf, TellsTheUnit) {
    EXPECT_EQ(read_3mf(threemf(model(object, item))).at(0).unit, "inch");
    std::string without = model(object, item);
    without.erase(without.find(" unit=\"inch\""), 12);
    EXPECT_EQ(read_3mf(threemf(without)).at(0).unit, "millimeter") << "the default of the specification";
}

TEST(Read3mf, RefusesUnknownElementsOfMeshes) {
    const auto with = [](const std::string& place, const std::string& text) {
        std::string changed = object;
        const std::size_t at = changed.find(place);
        EXPECT_NE(at, std::string::npos) << place;
        return threemf(model(changed.insert(std::min(at, changed.size()), text), item));
    };
    const auto refused = [&](const std::string& place, const std::string& text) { return message(with(place, text)); };
    EXPECT_EQ(refused("</triangles>", R"(<quad v1="0" v2="1" v3="2" v4="3"/>)"),
              "part '3D/3dmodel.model': line 3: <quad>: is not read; export as a plain mesh");
    EXPECT_EQ(refused("</vertices>", "<point/>"),
              "part '3D/3dmodel.model': line 2: <point>: is not read; export as a plain mesh");
    EXPECT_EQ(refused("</mesh>", "<curves/>"),
              "part '3D/3dmodel.model': line 3: <curves>: is not read; export as a plain mesh");
    EXPECT_EQ(read_3mf(with("</mesh>", R"(<t:trianglesets xmlns:t="x"><t:triangleset/></t:trianglesets>)")).size(), 1U);
}

TEST(Read3mf, RefusesWhatIsMissingOrOutOfRange) {
    EXPECT_EQ(message(threemf(model(object, R"(<item objectid="2"/>)"))), "line 3: <item>: there is no object '2'");
    std::string wrong = object;
    wrong.replace(wrong.find("v3=\"1\""), 6, "v3=\"4\"");
    EXPECT_EQ(message(threemf(model(wrong, item))),
              "part '3D/3dmodel.model': line 2: <triangle>: v3: vertex index 4 is out of range; there are 4 vertices, "
              "counted from 0");
    EXPECT_EQ(message(threemf(model(object, R"(<item objectid="1" transform="1 0"/>)"))),
              "line 3: <item>: transform: has 2 numbers instead of 12");
    EXPECT_EQ(
        message(threemf(model(R"(<object id="1"><components><component objectid="1"/></components></object>)", item))),
        "node 'part' contains itself");
    EXPECT_EQ(message(tests::zip({{"a", "b"}})), "is no 3MF: the archive has no part '_rels/.rels'");
    EXPECT_EQ(message("<xml/>"), "is no ZIP archive, or is truncated: has no directory at its end");
}

TEST(ZipArchive, ReadsStoredAndPackedEntriesByNamesInAnyCase) {
    const std::string text(100'000, 'x');
    const std::string bytes = tests::zip({{"A.txt", text}, {"b/C.txt", "stored"}}); // the archive refers to the bytes
    ZipArchive archive(bytes);
    EXPECT_EQ(archive.read("/a.TXT"), text);
    EXPECT_EQ(archive.read("b/c.txt"), "stored");
    EXPECT_FALSE(archive.has("d"));
    EXPECT_EQ(message_of([&] { (void)archive.read("d"); }), "has no part 'd'");
}

TEST(ZipArchive, RefusesDamageEncryptionAndBombs) {
    const std::string good = tests::zip({{"a", std::string(1'000, 'x')}});
    const std::size_t directory = good.find("PK\1\2");
    const auto refusal = [](const std::string& bytes) {
        return message_of([&] { (void)ZipArchive(bytes).read("a"); });
    };
    std::string bytes = good;
    bytes[directory + 8] = 1;
    EXPECT_EQ(refusal(bytes), "part 'a': is encrypted");
    bytes = good;
    bytes[directory + 10] = 12;
    EXPECT_EQ(refusal(bytes), "part 'a': is packed by method 12; only deflate is read");
    bytes = good;
    bytes[directory + 16] ^= 1;
    EXPECT_EQ(refusal(bytes), "part 'a': is damaged: its checksum is wrong");
    bytes = good;
    bytes[directory + 24] ^= 1; // the size
    EXPECT_EQ(refusal(bytes), "part 'a': cannot be unpacked: it is damaged");
    bytes[directory + 27] = 8; // 128 MiB of 1 kB
    EXPECT_TRUE(refusal(bytes).starts_with("part 'a': is too large when it is unpacked")) << refusal(bytes);
    const std::string bomb = tests::zip({{"a", std::string(std::size_t{80} << 20U, '\0')}});
    EXPECT_TRUE(refusal(bomb).starts_with("part 'a': is too large when it is unpacked")) << bomb.size();
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(refusal(good.substr(0, size)).empty()) << size;
}

TEST(ZipArchive, ReadsSizesInSixtyFourBits) {
    const std::string content = "content", name = "a";
    const std::string extra = tests::bytes_of(std::uint16_t{1}) + tests::bytes_of(std::uint16_t{16}) +
                              tests::bytes_of(std::uint64_t{7}) + tests::bytes_of(std::uint64_t{7});
    std::string bytes = tests::zip({{"first", ""}, {name, content}});
    const std::size_t entry = bytes.rfind("PK\1\2");
    bytes.replace(entry + 20, 8, std::string(8, '\xff'));
    bytes.replace(entry + 30, 2, tests::bytes_of(std::uint16_t(extra.size())));
    bytes.insert(entry + 46 + name.size(), extra);
    EXPECT_EQ(ZipArchive(bytes).read("a"), content);
}

} // namespace
} // namespace chasles::io
