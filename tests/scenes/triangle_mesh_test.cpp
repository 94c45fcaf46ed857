#include "scenes/triangle_mesh.h"

#include "chasles/base/invalid_input.h"
#include "tests/scenes/mesh_measures.h"

#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

namespace chasles::scenes {
namespace {

// A tube of square section about the axis from z = -3 to z = 3, open at both ends, with outward orientation.
TriangleMesh tube() {
    TriangleMesh mesh;
    for (const double z : {-3.0, 3.0}) {
        for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
            mesh.add(Eigen::Vector3d(x, y, z));
        }
    }
    for (Index i = 0; i < 4; ++i) {
        const Index next = (i + 1) % 4;
        mesh.triangles.push_back({i, next, next + 4});
        mesh.triangles.push_back({i, next + 4, i + 4});
    }
    return mesh;
}

TEST(TriangleMesh, ATubeCutAtTwoPlanesAndClosedIsABox) {
    TriangleMesh mesh = cut_off(cut_off(tube(), Side::above, -1, 1e-9), Side::below, 2.5, 1e-9);
    close_with_fan(mesh, rim(mesh, -1));
    close_with_fan(mesh, rim(mesh, 2.5));
    const Polyhedron box = mesh.polyhedron();
    EXPECT_EQ(unpaired_edges(box), 0);
    EXPECT_DOUBLE_EQ(volume(box), 4 * 3.5);
}

TEST(TriangleMesh, ACutThroughVerticesAddsNone) {
    const TriangleMesh mesh = cut_off(tube(), Side::above, -3 + 1e-12, 1e-9);
    EXPECT_EQ(mesh.vertices.size(), 8U);
    EXPECT_EQ(mesh.triangles.size(), 8U);
    EXPECT_EQ(rim(mesh, -3 + 1e-12).size(), 4U);
}

TEST(TriangleMesh, ARingJoinsARimToAPolygonAroundIt) {
    TriangleMesh mesh = tube();
    std::vector<Index> outer;
    for (int i = 0; i < 6; ++i) {
        const double angle = (i + 0.3) * std::numbers::pi / 3;
        outer.push_back(mesh.add({4 * std::cos(angle), 4 * std::sin(angle), -3}));
    }
    const std::size_t before = mesh.triangles.size();
    close_with_ring(mesh, rim(mesh, -3), outer);
    double area = 0;
    for (std::size_t i = before; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = mesh.triangles[i];
        const Eigen::Vector3d normal = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
        EXPECT_GT(normal.z(), 0) << "a ring at the lower end of a tube is a collar that faces up";
        area += normal.z() / 2;
    }
    EXPECT_NEAR(area, 1.5 * std::numbers::sqrt3 * 16 - 4, 1e-12);
}

TEST(TriangleMesh, WhatIsNotOneRimIsRefused) {
    EXPECT_THROW((void)rim(tube(), 0), InvalidInput);
    TriangleMesh twice = tube();
    for (Index i = 0; i < 8; ++i)
        twice.add(2 * twice.vertices[i].cwiseProduct(Eigen::Vector3d(1, 1, 0.5)));
    for (std::size_t i = 0; i < 8; ++i) {
        const auto [a, b, c] = twice.triangles[i];
        twice.triangles.push_back({a + 8, b + 8, c + 8});
    }
    EXPECT_THROW((void)rim(twice, -3), InvalidInput) << "two loops";
    TriangleMesh torn = tube();
    torn.triangles.erase(torn.triangles.begin());
    EXPECT_THROW((void)rim(torn, -3), InvalidInput);
}

TEST(TriangleMesh, SavedNumbersReadBackToTheSameDoubles) {
    TriangleMesh mesh;
    for (const double x : {1.0 / 3, 2e-17, -12345.678901234567})
        mesh.add({x, x * x, 1 / x});
    mesh.triangles.push_back({0, 1, 2});
    const Polyhedron body = mesh.polyhedron();
    std::istringstream in(obj_text(body));
    std::string tag;
    for (const Eigen::Vector3d& vertex : body.vertices()) {
        std::string text[3];
        in >> tag >> text[0] >> text[1] >> text[2];
        EXPECT_EQ(tag, "v");
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(std::stod(text[k]), vertex[k]);
    }
    std::string face;
    std::getline(in >> std::ws, face);
    EXPECT_EQ(face, "f 1 2 3");
}

} // namespace
} // namespace chasles::scenes
