// Files from the field that once crashed a reader, were refused without need, or meant different things.
#include "chasles/io/mesh_files.h"
#include "tests/data/shared_data.h"
#include "tests/io/message_of.h"

#include <map>

namespace chasles::io {
namespace {

using test::shared_data;

TEST(FieldFiles, AreRead) {
    CHASLES_REQUIRE_DATA("field/02-3mf-with-a-picture");
    const std::map<std::string, std::size_t> faces{{"02-3mf-with-a-picture/plain.3mf", 4},
                                                   {"02-3mf-with-a-picture/thumb.3mf", 4},
                                                   {"03-collada-up-axis/post_y.dae", 12},
                                                   {"03-collada-up-axis/post_z.dae", 12},
                                                   {"06-stl-ends/assimp.stl", 4},
                                                   {"06-stl-ends/endfacetonly.stl", 4},
                                                   {"06-stl-ends/noend.stl", 4},
                                                   {"07-line-ends/cr.obj", 4},
                                                   {"07-line-ends/cr.stl", 4}};
    for (const auto& [name, count] : faces)
        EXPECT_EQ(load_polygons(shared_data("field/" + name)).faces.size(), count) << name;
}

TEST(FieldFiles, OfColladaStandUprightWhateverTheirUpAxis) {
    CHASLES_REQUIRE_DATA("field/03-collada-up-axis");
    for (const char* const name : {"post_y.dae", "post_z.dae"})
        for (const Eigen::Vector3d& vertex :
             load_polygons(shared_data(std::string("field/03-collada-up-axis/") + name)).vertices)
            EXPECT_TRUE((vertex.z() == 0 || vertex.z() == 1) && std::abs(vertex.y()) == 0.05) << name;
}

TEST(FieldFiles, AreRefusedInOneLine) {
    CHASLES_REQUIRE_DATA("field/24-file-eats-memory");
    const std::map<std::string, std::string> reasons{
        {"12-step/a.step", "is a STEP file, which holds curved surfaces"},
        {"24-file-eats-memory/dag.glb", "has more than 67108864 vertices and corners of faces"},
        {"24-file-eats-memory/nan.dae", "not a vertex index: 'nan'"}};
    for (const auto& [name, reason] : reasons)
        EXPECT_NE(
            tests::message_of([&, &file = name] { (void)load_polygons(shared_data("field/" + file)); }).find(reason),
            std::string::npos)
            << name;
}

} // namespace
} // namespace chasles::io
