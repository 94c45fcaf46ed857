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

} // namespace
} // namespace chasles
