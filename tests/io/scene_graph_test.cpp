// Scenes: names are unique, and neither deep, nor cyclic, nor exploding references cost more than one clear line.
#include "chasles/io/scene_graph.h"

#include "tests/io/message_of.h"

#include <gtest/gtest.h>

namespace chasles::io {
namespace {

PolygonSoup triangle() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
}

// A chain of nodes with a mesh at its end, in which each node has the next one as a child `copies` times.
SceneGraph chain(std::size_t length, std::size_t copies) {
    SceneGraph scene;
    scene.meshes = {triangle()};
    scene.nodes.resize(length);
    for (std::size_t node = 0; node + 1 < length; ++node)
        scene.nodes[node].children.assign(copies, node + 1);
    scene.nodes.back().meshes = {0};
    scene.roots = {0};
    return scene;
}

TEST(SceneGraph, DeepChainsAreRead) {
    SceneGraph scene = chain(100'000, 1);
    for (SceneNode& node : scene.nodes)
        node.to_parent.translation().x() = 0.25;
    const std::vector<MeshPart> parts = parts_of(scene);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].polygons.vertices[1], Eigen::Vector3d(25'001, 0, 0));
}

TEST(SceneGraph, ANodeThatContainsItselfIsRefused) {
    SceneGraph scene = chain(3, 1);
    scene.nodes[1].name = "loop";
    scene.nodes[2].children = {1};
    EXPECT_EQ(tests::message_of([&] { (void)parts_of(scene); }), "node 'loop' contains itself");
}

TEST(SceneGraph, MoreNodesThanAnyoneNeedsAreRefused) {
    EXPECT_EQ(parts_of(chain(15, 2)).size(), 1U << 14U);
    EXPECT_EQ(tests::message_of([&] { (void)parts_of(chain(41, 2)); }),
              "has more than 1,000,000 nodes, counting a node once for each path to it");
}

TEST(SceneGraph, MoreCornersThanAnyoneNeedsAreRefused) {
    SceneGraph scene = chain(17, 2); // 65,536 copies
    scene.meshes[0].faces.assign(1'000, {0, 1, 2});
    EXPECT_EQ(
        tests::message_of([&] { (void)parts_of(scene); }),
        "has more than 67108864 vertices and corners of faces, counting a mesh once for each node that places it");
}

TEST(SceneGraph, ALargeMeshIsCountedOnceForManyNodes) {
    SceneGraph scene = chain(1, 1);
    scene.meshes[0].faces.assign(100'000, {0, 1, 2});
    const SceneNode node_with_mesh = scene.nodes[0];
    scene.nodes.assign(100'000, node_with_mesh); // 10^10 faces
    scene.roots.resize(100'000);
    for (std::size_t node = 0; node < scene.roots.size(); ++node)
        scene.roots[node] = node;
    EXPECT_TRUE(tests::message_of([&] { (void)parts_of(scene); }).starts_with("has more than 67108864 vertices"));
}

TEST(SceneGraph, NamesComeFromTheNearestNodeAndAreUnique) {
    SceneGraph scene = chain(2, 3);
    scene.nodes[0].name = "bolt";
    scene.nodes.push_back({"bolt_2", Eigen::Affine3d::Identity(), {0}, {}});
    scene.nodes.push_back({"", Eigen::Affine3d::Identity(), {0}, {}});
    scene.roots = {0, 2, 3};
    std::vector<std::string> names;
    for (const MeshPart& part : parts_of(scene))
        names.push_back(part.name);
    EXPECT_EQ(names, (std::vector<std::string>{"bolt", "bolt_3", "bolt_4", "bolt_2", "part"}));
}

std::vector<std::string> names_of_triangles(const std::vector<std::string>& given) {
    SceneGraph scene;
    scene.meshes = {triangle()};
    for (const std::string& name : given) {
        scene.roots.push_back(scene.nodes.size());
        scene.nodes.push_back({name, Eigen::Affine3d::Identity(), {0}, {}});
    }
    std::vector<std::string> names;
    for (const MeshPart& part : parts_of(scene))
        names.push_back(part.name);
    return names;
}

TEST(SceneGraph, ANameOfTheFileStaysWithItsOwner) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(names_of_triangles({"wheel", "wheel", "wheel_2"}), (Names{"wheel", "wheel_3", "wheel_2"}));
    EXPECT_EQ(names_of_triangles({"wheel_2", "wheel", "wheel"}), (Names{"wheel_2", "wheel", "wheel_3"}));
    EXPECT_EQ(names_of_triangles({"a", "a", "a_2", "a_2", "a_2_2"}), (Names{"a", "a_3", "a_2", "a_2_3", "a_2_2"}));
    EXPECT_EQ(names_of_triangles({"", "part"}), (Names{"part_2", "part"})) << "a node without a name takes none";
}

TEST(SceneGraph, ANodeWithoutANameLeavesThatOfItsParentToOtherNodes) {
    SceneGraph scene = chain(2, 1);
    scene.nodes[0].name = "bolt";
    scene.nodes.push_back({"bolt", Eigen::Affine3d::Identity(), {0}, {}});
    scene.roots = {0, 2};
    const std::vector<MeshPart> parts = parts_of(scene);
    EXPECT_EQ(parts.at(0).name, "bolt_2");
    EXPECT_EQ(parts.at(1).name, "bolt");
}

TEST(SceneGraph, NamesAreTextInOneLine) {
    SceneGraph scene = chain(1, 1);
    scene.nodes[0].name = "caf\xe9\n";
    EXPECT_EQ(parts_of(scene).at(0).name, "caf? ");
}

TEST(SceneGraph, InfinitePlacesAreRefused) {
    SceneGraph scene = chain(2, 1);
    scene.nodes[1].name = "far";
    scene.nodes[0].to_parent.linear() *= 1e200;
    scene.nodes[1].to_parent.linear() *= 1e200;
    EXPECT_EQ(tests::message_of([&] { (void)parts_of(scene); }),
              "node 'far': NaN or infinity in its transform or its vertices");
}

TEST(SceneGraph, StripsAndFansKeepOneSide) {
    PolygonSoup strip = triangle(), fan = triangle();
    strip.faces.clear();
    fan.faces.clear();
    add_triangle_strip(strip, {0, 1, 2, 3, 3, 4});
    EXPECT_EQ(strip.faces, (std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {2, 1, 3}}));
    add_triangle_fan(fan, {9, 0, 1, 2});
    EXPECT_EQ(fan.faces, (std::vector<std::vector<std::uint32_t>>{{9, 0, 1}, {9, 1, 2}}));
}

TEST(SceneGraph, VerticesThatNoFaceUsesAreLeftOut) {
    PolygonSoup mesh;
    mesh.vertices = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {8, 8, 8}, {0, 1, 0}};
    mesh.faces = {{1, 2, 4}};
    SceneGraph scene;
    scene.meshes = {mesh};
    SceneNode node;
    node.name = "one";
    node.meshes = {0, 0};
    scene.nodes = {node};
    scene.roots = {0};
    const std::vector<MeshPart> parts = parts_of(scene);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].polygons.vertices.size(), 6u);
    EXPECT_EQ(parts[0].polygons.faces, (std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {3, 4, 5}}));
}

} // namespace
} // namespace chasles::io
