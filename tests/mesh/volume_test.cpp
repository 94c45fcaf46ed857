// Which parts of a surface are solid, and the volume that they enclose.
#include "chasles/mesh/body.h"

#include "chasles/mesh/primitives.h"
#include "tests/mesh/shapes.h"
#include "tests/support/random.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Outlines = std::vector<std::vector<std::uint32_t>>;

/// A tetrahedron with its corner at a point.
void add_corner(std::vector<Eigen::Vector3d>& vertices, Outlines& faces, const Eigen::Vector3d& place, double size) {
    const auto first = std::uint32_t(vertices.size());
    vertices.push_back(place);
    for (int axis = 0; axis < 3; ++axis)
        vertices.push_back(place + size * Eigen::Vector3d::Unit(axis));
    for (const auto& [a, b, c] : {std::array{0U, 2U, 1U}, {0U, 1U, 3U}, {0U, 3U, 2U}, {1U, 2U, 3U}})
        faces.push_back({first + a, first + b, first + c});
}

TEST(Volume, ClosedSurfacesAreSolid) {
    const MeshReport box = make_box({1, 2, 3}).report();
    EXPECT_EQ(box.parts, 1U);
    EXPECT_EQ(box.solid_parts, 1U);
    EXPECT_EQ(box.unpaired_edges, 0U);
    EXPECT_NEAR(box.volume, 6, 1e-14);
    for (const Polyhedron& round :
         {enclosing_sphere(1, 0.01).shape, enclosing_cylinder(1, 2, 0.01).shape, enclosing_capsule(1, 2, 0.01).shape}) {
        EXPECT_EQ(round.report().solid_parts, 1U);
        EXPECT_GT(round.report().volume, 4.1);
    }
}

TEST(Volume, EachPartIsSolidByItself) {
    std::vector<Eigen::Vector3d> vertices;
    Outlines faces;
    add_corner(vertices, faces, {0, 0, 0}, 1);
    add_corner(vertices, faces, {0, 0, 5}, 1);
    faces.pop_back();                          // the second one is open
    add_corner(vertices, faces, {1, 0, 0}, 2); // shares a vertex with the first one
    const Polyhedron body = Polyhedron::from_polygons(vertices, faces);
    const MeshReport report = body.report();
    EXPECT_EQ(report.parts, 2U);
    EXPECT_EQ(report.solid_parts, 1U);
    EXPECT_EQ(report.unpaired_edges, 3U);
    EXPECT_NEAR(report.volume, 1 / 6. + 8 / 6., 1e-14);
    EXPECT_TRUE(body.body().volume().is_bounded_by(0));
    EXPECT_FALSE(body.body().volume().is_bounded_by(5));
    EXPECT_TRUE(body.body().volume().is_bounded_by(10));
}

TEST(Volume, FacesTurnedDifferentlyEncloseNothing) {
    std::vector<Eigen::Vector3d> vertices;
    Outlines faces;
    add_corner(vertices, faces, {0, 0, 0}, 1);
    std::ranges::reverse(faces[2]);
    const Polyhedron mixed = Polyhedron::from_polygons(vertices, faces);
    EXPECT_TRUE(mixed.report().closed);
    EXPECT_EQ(mixed.report().unpaired_edges, 3U);
    EXPECT_EQ(mixed.report().solid_parts, 0U);
    EXPECT_EQ(mixed.report().volume, 0);
    EXPECT_NE(refusal([&] { (void)Polyhedron::from_polygons(vertices, faces, {.solid = Solid::yes}); }), "accepted");
    std::ranges::reverse(faces[0]);
    std::ranges::reverse(faces[1]);
    std::ranges::reverse(faces[3]);
    EXPECT_NEAR(Polyhedron::from_polygons(vertices, faces).report().volume, -1 / 6., 1e-15);
    const std::string why = refusal([&] { (void)Polyhedron::from_polygons(vertices, faces, {.solid = Solid::yes}); });
    EXPECT_TRUE(why.starts_with("mesh: solid: the surface is turned inwards")) << why;
    EXPECT_EQ(Polyhedron::from_polygons(vertices, faces, {.solid = Solid::no}).report().solid_parts, 0U);
}

/// A room of normals that point into it encloses nothing solid; the cavity of a shell takes away from the part around
/// it.
TEST(Volume, PartsThatAreTurnedInwardsAreNotSolid) {
    const auto report_of = [](std::initializer_list<std::pair<Eigen::Vector3d, double>> corners) {
        std::vector<Eigen::Vector3d> vertices;
        Outlines faces;
        for (const auto& [place, size] : corners) // of a size below 0: mirrored, so turned inwards
            add_corner(vertices, faces, place, size);
        return Polyhedron::from_polygons(vertices, faces).report();
    };
    const MeshReport room = report_of({{{1, 2, 3}, -1}});
    EXPECT_TRUE(room.closed);
    EXPECT_EQ(room.solid_parts, 0U);
    EXPECT_EQ(room.inward_parts, 1U);
    EXPECT_NEAR(room.volume, -1 / 6., 1e-14);
    const MeshReport shell = report_of({{{0, 0, 0}, 9}, {{2, 2, 2}, -1}, {{50, 0, 0}, 1}});
    EXPECT_EQ(shell.parts, 3U);
    EXPECT_EQ(shell.solid_parts, 2U);
    EXPECT_EQ(shell.inward_parts, 1U);
    for (const double size :
         {1e-3, -1e-3}) { // its volume is far below the rounding of coordinates at this distance, cubed
        const MeshReport far = report_of({{{0, 0, 0}, 1}, {{1e7, 3e6, -2e6}, size}});
        EXPECT_EQ(far.inward_parts, size < 0 ? 1U : 0U);
        EXPECT_EQ(far.solid_parts, size < 0 ? 1U : 2U);
    }
    const Polyhedron inwards = make_box({1, 1, 1});
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t face = 0; face < inwards.face_count(); ++face)
        faces.emplace_back(inwards.face(face).rbegin(), inwards.face(face).rend());
    const Polyhedron box = Polyhedron::from_polygons(inwards.vertices(), faces, {.radius = -0.1});
    EXPECT_EQ(box.report().inward_parts, 1U) << "faces that moved";
    EXPECT_NEAR(box.report().volume, -1.728, 1e-12) << "the walls of a room move into the wall";
    EXPECT_EQ(box.with_radius(0.5).report().inward_parts, 1U);
}

/// A face without area closes the gap between an edge and two edges that meet on it.
TEST(Volume, FacesWithoutAreaCloseGaps) {
    std::vector<Eigen::Vector3d> vertices;
    Outlines faces;
    add_corner(vertices, faces, {0, 0, 0}, 1);
    vertices.emplace_back(0.5, 0, 0); // on the edge from 0 to 1, of the faces 0 and 1
    faces[0] = {0, 2, 1, 4};
    const MeshReport open = Polyhedron::from_polygons(vertices, faces).report();
    EXPECT_EQ(open.unpaired_edges, 3U);
    EXPECT_EQ(open.solid_parts, 0U);
    faces.push_back({0, 4, 1});
    const MeshReport closed = Polyhedron::from_polygons(vertices, faces).report();
    EXPECT_EQ(closed.unpaired_edges, 0U);
    EXPECT_EQ(closed.solid_parts, 1U);
    EXPECT_NEAR(closed.volume, 1 / 6., 1e-15);
}

/// A wire or a point is a part that encloses nothing.
TEST(Volume, WiresAreNotSolid) {
    std::vector<Eigen::Vector3d> vertices;
    Outlines faces;
    add_corner(vertices, faces, {0, 0, 0}, 1);
    vertices.insert(vertices.end(), {{5, 0, 0}, {6, 0, 0}});
    faces.push_back({4, 5, 5});
    const MeshReport report = Polyhedron::from_polygons(vertices, faces).report();
    EXPECT_EQ(report.parts, 2U);
    EXPECT_EQ(report.solid_parts, 1U);
}

/// A sphere by angles from 0 to 2 pi, as three.js makes it: the first and the last meridian, and the points of the
/// south pole, differ by rounding.
TEST(Volume, SeamsThatDifferByRoundingAreClosed) {
    const auto sphere = [](double radius, double gap) {
        std::vector<Eigen::Vector3d> vertices;
        Outlines faces;
        const std::uint32_t around = 24, along = 12;
        for (std::uint32_t i = 0; i <= along; ++i)
            for (std::uint32_t j = 0; j <= around; ++j) {
                const double polar = std::numbers::pi * i / along, angle = 2 * std::numbers::pi * j / around;
                vertices.emplace_back(-radius * std::cos(angle) * std::sin(polar), radius * std::cos(polar),
                                      radius * std::sin(angle) * std::sin(polar) + (j == around ? gap : 0));
            }
        for (std::uint32_t i = 0; i < along; ++i)
            for (std::uint32_t j = 0; j < around; ++j) {
                const std::uint32_t a = i * (around + 1) + j + 1, b = a - 1, c = b + around + 1, d = a + around + 1;
                if (i > 0)
                    faces.push_back({a, b, d});
                if (i < along - 1)
                    faces.push_back({b, c, d});
            }
        return Polyhedron::from_polygons(vertices, faces);
    };
    for (const double radius : {1e-6, 1.0, 1e9}) {
        const Polyhedron body = sphere(radius, 0);
        EXPECT_FALSE(body.report().closed);
        EXPECT_EQ(body.report().solid_parts, 1U);
        EXPECT_EQ(body.report().unpaired_edges, 0U);
        EXPECT_NEAR(body.report().volume, 4.19 * radius * radius * radius, 0.2 * radius * radius * radius);
        EXPECT_GT(body.body().volume().seam, 0);
        EXPECT_EQ(sphere(radius, 1e-9 * radius).report().solid_parts, 0U) << "a gap";
    }
    EXPECT_EQ(make_box({1, 1, 1}).body().volume().seam, 0);
}

TEST(Volume, BlocksEncloseTheirPoints) {
    Random random(4405);
    std::vector<Eigen::Vector3d> vertices;
    Outlines faces;
    for (int i = 0; i < 100; ++i) {
        const auto place = random.vector(10);
        add_corner(vertices, faces, {place.x, place.y, place.z}, 0.1);
    }
    const Polyhedron body = Polyhedron::from_polygons(vertices, faces);
    const Volume& volume = body.body().volume();
    ASSERT_EQ(volume.part_points.size(), 100U);
    std::size_t next = 0;
    for (const PartBlock& block : volume.blocks) {
        EXPECT_EQ(block.begin, next);
        for (; next < block.end; ++next) {
            const Eigen::Vector3d way = vertices[volume.part_points[next]] - block.centre;
            EXPECT_TRUE((way.cwiseAbs().array() <= block.half.array()).all());
        }
    }
    EXPECT_EQ(next, 100U);
}

} // namespace
} // namespace chasles::test
