// Normal cones against their definition: directions in which the distance from a feature is locally least.
#include "chasles/mesh/normal_cones.h"

#include "chasles/mesh/adjacent_directions.h"
#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"
#include "tests/support/grid.h"
#include "tests/support/random.h"

#include <Eigen/Geometry>
#include <functional>
#include <numbers>

namespace chasles::test {
namespace {

bool contains(const NormalCone& cone, const Eigen::Vector3d& direction) {
    return std::abs(cone.axis.cast<double>().normalized().dot(direction)) >= std::cos(double(cone.angle));
}

Eigen::Vector3d random_direction(Random& random) {
    const auto v = random.vector(1);
    return Eigen::Vector3d(v.x, v.y, v.z).normalized();
}

/// Whether no direction from the feature into the surface has a positive product with d.
bool leads_away(const Eigen::Vector3d& d, const std::function<bool(std::function<bool(const Eigen::Vector3d&)>)>& any) {
    return !any([&](const Eigen::Vector3d& way) { return d.dot(way.normalized()) > 1e-9; });
}

/// Random directions at the vertices and edges of a body: those in which the distance is locally least must be in the
/// cones of all nodes above the face that owns the feature. Returns how many there were, and how many cones exclude a
/// random direction.
struct Seen {
    int least = 0;
    int excluded = 0;
};
Seen check(const Polyhedron& polyhedron, Random& random, int directions) {
    const chasles::Body& body = polyhedron.body();
    const auto nodes = body.bvh().nodes();
    std::vector<std::uint32_t> parent(nodes.size(), 0), leaf_of(body.face_count());
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].is_leaf())
            leaf_of[nodes[i].first] = i;
        else
            parent[nodes[i].first] = parent[nodes[i].first + 1] = i;
    }
    Seen seen;
    const auto expect_in_cones = [&](std::uint32_t face, const Eigen::Vector3d& d) {
        ++seen.least;
        for (std::uint32_t node = leaf_of[face];; node = parent[node]) {
            EXPECT_TRUE(contains(body.normal_cones()[node], d)) << "face " << face << " node " << node;
            if (node == 0)
                return;
        }
    };
    for (std::uint32_t face = 0; face < body.face_count(); ++face) {
        const auto corners = body.face(face);
        const Eigen::Vector3d& a = body.vertices()[corners[0]];
        expect_in_cones(face, (body.vertices()[corners[1]] - a).cross(body.vertices()[corners[2]] - a).normalized());
        for (int i = 0; i < directions; ++i) {
            const Eigen::Vector3d d = random_direction(random);
            seen.excluded += contains(body.normal_cones()[leaf_of[face]], d) ? 0 : 1;
            for (const std::uint32_t vertex : body.owned_vertices(face))
                if (leads_away(d, [&](auto test) { return any_direction_from_vertex(body, vertex, test); })) {
                    EXPECT_TRUE(contains(cone_of_vertex(body, vertex), d)) << "vertex " << vertex;
                    expect_in_cones(face, d);
                }
            for (const Edge& edge : body.owned_edges(face)) {
                const Eigen::Vector3d along = (body.vertices()[edge.to] - body.vertices()[edge.from]).normalized();
                const Eigen::Vector3d across = (d - along * along.dot(d)).normalized();
                if (leads_away(across, [&](auto test) { return any_direction_from_edge(body, edge, test); })) {
                    EXPECT_TRUE(contains(cone_of_edge(body, edge), across)) << "edge " << edge.from << " " << edge.to;
                    expect_in_cones(face, across);
                }
            }
        }
    }
    return seen;
}

Polyhedron torus_24_16() {
    const Soup soup = torus(24, 16);
    return Polyhedron::from_polygons(soup.vertices, soup.faces);
}

TEST(NormalCones, ContainEveryDirectionInWhichTheDistanceIsLeast) {
    Random random(77);
    const Seen torus = check(torus_24_16(), random, 20);
    EXPECT_GT(torus.least, 1000);
    EXPECT_GT(torus.excluded, 5000) << "the cones exclude most directions";
    std::mt19937 bodies(5);
    for (int i = 0; i < 20; ++i) {
        const Seen seen = check(random_octahedron(bodies).polyhedron(), random, 200);
        EXPECT_GT(seen.least, 300);
    }
}

TEST(NormalCones, HoldForOpenAndBranchedSurfaces) {
    Random random(78);
    const Seen fin =
        check(Body{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0.2}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}
                  .polyhedron(),
              random, 500);
    EXPECT_GT(fin.least, 500);
}

TEST(NormalCones, OfACubeAreTheLeastOnes) {
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    const chasles::Body& body = cube.body();
    EXPECT_LT(double(cone_of_face(body, 0).angle), 1e-3);
    EXPECT_NEAR(double(cone_of_edge(body, {0, 1}).angle), std::numbers::pi / 4, 1e-3);
    EXPECT_NEAR(double(cone_of_vertex(body, 0).angle), std::acos(1 / std::sqrt(3.0)), 1e-3);
    EXPECT_GE(double(body.normal_cones()[0].angle), 1.57) << "the cube has normals in every direction";
}

TEST(NormalCones, OfANearlyFlatSurfaceAreNarrow) {
    Body plate;
    for (std::uint32_t i = 0; i <= 8; ++i)
        for (std::uint32_t j = 0; j <= 8; ++j)
            plate.vertices.emplace_back(i, j, 0.01 * ((3 * i + 5 * j) % 4));
    plate.faces = grid_triangles(8, 8);
    const Polyhedron body = plate.polyhedron();
    int narrow = 0;
    for (const NormalCone& cone : body.body().normal_cones())
        narrow += cone.angle < 0.1F && cone.axis.z() > 0.99F ? 1 : 0;
    EXPECT_GT(narrow, 60) << "the leaves away from the rim";
}

TEST(NormalCones, EnclosingIsTheLeastConeAroundBoth) {
    const auto at = [](double angle) { return Eigen::Vector3f(float(std::cos(angle)), float(std::sin(angle)), 0); };
    const NormalCone both = enclosing({at(0), 0.1F}, {at(0.4), 0.2F});
    EXPECT_NEAR(double(both.angle), 0.35, 2e-4);
    EXPECT_NEAR(double(both.axis.dot(at(0.25))), 1, 1e-6) << "from -0.1 to 0.6";
    const NormalCone turned_over = enclosing({at(0), 0.1F}, {-at(0.4), 0.2F});
    EXPECT_NEAR(double(std::abs(turned_over.axis.dot(at(0.25)))), 1, 1e-6) << "either way along a line";
    EXPECT_EQ(enclosing({at(0), 0.5F}, {at(0.1), 0.1F}).angle, 0.5F) << "one contains the other";
    EXPECT_GE(double(enclosing({at(0), 1}, {at(1.5), 1}).angle), 1.57) << "every direction";
}

} // namespace
} // namespace chasles::test
