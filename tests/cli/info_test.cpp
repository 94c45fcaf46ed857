// chasles info: the content of a mesh file.
#include "tests/cli/cli_test_files.h"

#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Info = tests::CommandLine;

TEST_F(Info, DescribesAMesh) {
    const auto finished = run("info cube.obj --json");
    EXPECT_EQ(finished.status, 0);
    const auto mesh = nlohmann::json::parse(finished.out);
    EXPECT_EQ(mesh["vertices"], 8);
    EXPECT_EQ(mesh["faces"], 6);
    EXPECT_EQ(mesh["triangles"], 12);
    EXPECT_EQ(mesh["edges"], 12);
    EXPECT_EQ(mesh["closed"], true);
    EXPECT_EQ(mesh["bounding_box"]["upper"], (nlohmann::json{1.0, 1.0, 1.0}));
    EXPECT_EQ(mesh["hierarchy"]["nodes"], 11);
    EXPECT_TRUE(run("info cube.obj").out.starts_with("cube.obj: closed\n"));
}

TEST_F(Info, CountsSegments) {
    write("wire.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 9\nf 1 2 3\nf 1 4 4\n");
    EXPECT_EQ(nlohmann::json::parse(run("info wire.obj --json").out)["segments"], 1);
    EXPECT_NE(run("info wire.obj").out.find("1 of them segments without area"), std::string::npos);
}

TEST_F(Info, SaysWhatWasDropped) {
    write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 0 -1 0\nf 1 2 4\nf 2 3 4\nf 1 3 5\nf 1 2 3\n");
    const auto mesh = nlohmann::json::parse(run("info flat.obj --json").out);
    EXPECT_EQ(mesh["dropped_faces"], 1);
    EXPECT_EQ(mesh["segments"], 0);
    EXPECT_EQ(mesh["closed"], false);
}

TEST_F(Info, CountsOnlyPartsThatEncloseSomethingAsSolid) {
    const std::string room = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 3 2 1\nf 4 2 1\nf 3 4 1\nf 4 3 2\n";
    const std::string inwards = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    const std::string outwards = "v 5 0 0\nv 7 0 0\nv 5 2 0\nv 5 0 2\nf -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n";
    write("room.obj", inwards);
    write("both.obj", inwards + outwards);
    write("mixed.obj", room);
    const auto parts = [&](const std::string& name) {
        const auto mesh = nlohmann::json::parse(run("info " + name + " --json").out);
        return std::array<int, 3>{mesh["surface_parts"], mesh["solid_parts"], mesh["inward_parts"]};
    };
    EXPECT_EQ(parts("room.obj"), (std::array{1, 0, 1}));
    EXPECT_EQ(parts("both.obj"), (std::array{2, 1, 1}));
    EXPECT_EQ(parts("mixed.obj"), (std::array{1, 0, 0}));
    const auto says = [&](const std::string& name, const std::string& words) {
        EXPECT_NE(run("info " + name).out.find(words), std::string::npos) << run("info " + name).out;
    };
    says("room.obj", "solid     no: turned inwards, volume -0.166666667: more of it is turned inwards");
    says("both.obj", "solid     yes, volume 1.16666667, 2 connected parts, 1 of them turned inwards");
    says("mixed.obj", "solid     no: along ");
}

} // namespace
} // namespace chasles
