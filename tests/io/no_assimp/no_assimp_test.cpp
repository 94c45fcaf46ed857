// A build without Assimp: the reader that this program brings itself is not taken from the library.
#include "chasles/mesh/polyhedron.h"
#include "tests/io/message_of.h"

namespace chasles {
namespace {

using NoAssimp = tests::FileTest;

TEST_F(NoAssimp, RefusesOtherFormatsByName) {
    const std::filesystem::path file = write("body.gltf", "{}");
    EXPECT_EQ(without_folder(tests::message_of([&] { (void)Polyhedron::load(file); })),
              "body.gltf: no reader for the extension '.gltf'; this build, without Assimp, reads OBJ, OFF, PLY and STL "
              "only");
}

TEST_F(NoAssimp, ReadsItsOwnFormats) {
    EXPECT_EQ(Polyhedron::load(write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).face_count(), 1U);
}

} // namespace
} // namespace chasles
