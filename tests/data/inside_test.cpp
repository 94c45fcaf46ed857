// Real closed meshes in each other, against sums of solid angles. CHASLES_LONG=1: twenty thousand placements.
#include "tests/data/shared_data.h"
#include "tests/support/random_poses.h"
#include "tests/support/solid_angle.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace chasles::test {
namespace {

/// Around the origin, with its longest side 2.
Polyhedron scaled(const Polyhedron& given) {
    const MeshReport report = given.report();
    const Eigen::Vector3d middle = 0.5 * (report.lower + report.upper);
    const double size = (report.upper - report.lower).maxCoeff();
    std::vector<Eigen::Vector3d> vertices;
    for (const Eigen::Vector3d& vertex : given.vertices())
        vertices.emplace_back((vertex - middle) * (2 / size));
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t face = 0; face < given.face_count(); ++face)
        faces.emplace_back(given.face(face).begin(), given.face(face).end());
    return Polyhedron::from_polygons(vertices, faces, {.triangulate = true});
}

Polyhedron shrunk(const Polyhedron& given, double size, Solid solid) {
    std::vector<Eigen::Vector3d> vertices;
    for (const Eigen::Vector3d& vertex : given.vertices())
        vertices.emplace_back(vertex * size);
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t face = 0; face < given.face_count(); ++face)
        faces.emplace_back(given.face(face).begin(), given.face(face).end());
    return Polyhedron::from_polygons(vertices, faces, {.triangulate = true, .solid = solid});
}

std::vector<Polyhedron> closed_meshes() {
    std::vector<Polyhedron> found;
    for (const char* folder : {"meshes", "assembly-factory", "environments-hpp", "robots"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_data(folder))) {
            const std::string ending = entry.path().extension().string();
            if ((ending != ".obj" && ending != ".stl" && ending != ".ply") || entry.file_size() > 300'000)
                continue;
            const Polyhedron mesh = scaled(Polyhedron::load(entry.path(), {.triangulate = true}));
            const MeshReport report = mesh.report();
            if (report.solid_parts + report.inward_parts == report.parts && report.parts <= 8 &&
                mesh.face_count() < 4000)
                found.push_back(mesh);
        }
    return found;
}

TEST(InsideOfMeshes, AgreesWithSolidAngles) {
    CHASLES_REQUIRE_DATA("meshes/spot.obj");
    const std::vector<Polyhedron> meshes = closed_meshes();
    ASSERT_GT(meshes.size(), 10U);
    Random random(4406);
    const int rounds = std::getenv("CHASLES_LONG") ? 20'000 : 400; // NOLINT(concurrency-mt-unsafe)
    int nested = 0, clear = 0, meeting = 0;
    for (int round = 0; round < rounds; ++round) {
        const auto any = [&]() -> const Polyhedron& {
            return meshes[std::size_t(random.integer(0, int(meshes.size()) - 1))];
        };
        const Polyhedron& outer = any();
        const Polyhedron& shape = any();
        const double size = std::abs(random.scaled(-2.5, -0.3));
        const Polyhedron inner = shrunk(shape, size, Solid::automatic);
        const Pose pose = random_pose(random, 1), goal = random_goal(random, pose, 0.1, 0.001 * size);
        const Motion motion = random.chance(0.5) ? Motion::screw(pose, goal) : Motion::velocity(pose, goal);
        const FirstContact surfaces =
            first_contact({shrunk(shape, size, Solid::no), shrunk(outer, 1, Solid::no), motion});
        const FirstContact found = first_contact({inner, outer, motion});
        if (surfaces.verdict == Verdict::contact_at_start) {
            EXPECT_EQ(found.verdict, surfaces.verdict) << round;
            EXPECT_FALSE(found.inside) << round;
            ++meeting;
            continue;
        }
        const Eigen::Isometry3d place = pose.isometry();
        const bool moving_is_in = winding_by_solid_angles(outer, place * inner.vertices()[0]) > 0.5;
        const bool fixed_is_in = winding_by_solid_angles(inner, place.inverse() * outer.vertices()[0]) > 0.5;
        if (inner.report().parts == 1 && outer.report().parts == 1) {
            EXPECT_EQ(found.inside.has_value(), moving_is_in || fixed_is_in) << round;
        }
        if (found.inside) {
            EXPECT_EQ(found.verdict, Verdict::contact_at_start);
            EXPECT_TRUE(found.certain);
            const bool is_moving = found.inside->moving_is_inside;
            const Eigen::Vector3d vertex = (is_moving ? inner : outer).vertices()[found.inside->vertex.first];
            EXPECT_GT(winding_by_solid_angles(is_moving ? outer : inner,
                                              is_moving ? place * vertex : place.inverse() * vertex),
                      0.5)
                << round;
        } else {
            EXPECT_EQ(found.verdict, surfaces.verdict);
            EXPECT_FALSE(moving_is_in || fixed_is_in) << round;
        }
        nested += found.inside.has_value();
        clear += found.verdict == Verdict::clear;
    }
    print_figures("meshes in each other: %zu meshes, %d placements, %d nested, %d clear, %d meeting", meshes.size(),
                  rounds, nested, clear, meeting);
    EXPECT_GT(nested, rounds / 20);
    EXPECT_GT(clear, rounds / 20);
}

} // namespace
} // namespace chasles::test
