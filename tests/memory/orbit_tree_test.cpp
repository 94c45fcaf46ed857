// The nodes of orbit trees against the coordinates of points of their faces.
#include "chasles/memory/orbit_tree.h"

#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles::memory {
namespace {

using Eigen::Vector3d;
using test::uniform;

algebra::Vector3<double> vector(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

motion::AxisFrame random_axis(std::mt19937& random) {
    const Eigen::Matrix3d turn = test::random_pose(random, 1, 3).rotation.toRotationMatrix();
    return {vector(test::random_vector(random, 1)), vector(turn.col(0)), vector(turn.col(1)), vector(turn.col(2))};
}

/// A point in the coordinates of an axis.
struct Seen {
    double radius, turn, height;
};

Seen seen(const motion::AxisFrame& axis, const Vector3d& point) {
    const algebra::Vector3<double> from = vector(point) - axis.origin;
    const double x = dot(from, axis.across), y = dot(from, axis.beside);
    return {std::sqrt(x * x + y * y), std::atan2(y, x), dot(from, axis.along)};
}

/// Whether the node has the point, with its turn plus some rounds.
bool contains(const OrbitTree& tree, const OrbitNode& node, const Seen& point, double pitch) {
    for (int round = -1; round <= 1; ++round) {
        const double turn = point.turn + 2 * round * EIGEN_PI;
        const OrbitPoint place{point.radius, point.height - pitch * turn};
        bool inside = turn >= node.first_turn - 1e-12 && turn <= node.last_turn + 1e-12 &&
                      place.radius >= node.lower.radius - 1e-12 && place.radius <= node.upper.radius + 1e-12 &&
                      place.rise >= node.lower.rise - 1e-12 && place.rise <= node.upper.rise + 1e-12 &&
                      place.radius >= node.nearest - 1e-12;
        for (double angle = 0; angle < 6.3 && inside; angle += 0.05) {
            const double c = std::cos(angle), s = std::sin(angle);
            double most = -1e300;
            for (const OrbitPoint& corner : tree.corners(node))
                most = std::max(most, c * corner.radius + s * corner.rise);
            most += (c < 0 ? -c * node.inward : 0) + std::abs(s) * node.rising + node.around;
            inside = c * place.radius + s * place.rise <= most + 1e-12;
        }
        if (inside)
            return true;
    }
    return false;
}

Vector3d random_point(const Body& body, std::size_t face, std::mt19937& random) {
    Vector3d point = Vector3d::Zero();
    double sum = 0;
    for (const std::uint32_t corner : body.face(face)) {
        const double share = uniform(random, 0, 1);
        point += share * body.vertices()[corner];
        sum += share;
    }
    return point / sum;
}

void expect_to_hold_all(const Body& body, double pitch, std::mt19937& random) {
    const motion::AxisFrame axis = random_axis(random);
    const OrbitTree tree(body, axis, pitch);
    ASSERT_EQ(tree.nodes().size(), 2 * body.face_count() - 1);
    std::vector<std::uint32_t> parent(tree.nodes().size());
    for (std::uint32_t i = 0; i < tree.nodes().size(); ++i)
        if (!tree.nodes()[i].is_leaf)
            parent[tree.nodes()[i].first] = parent[tree.nodes()[i].first + 1] = i;
    for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
        if (!tree.nodes()[i].is_leaf)
            continue;
        const std::size_t face = body.bvh().nodes()[tree.nodes()[i].first].first;
        const Seen point = seen(axis, random_point(body, face, random));
        for (std::uint32_t node = i;; node = parent[node]) {
            EXPECT_TRUE(contains(tree, tree.nodes()[node], point, pitch)) << "face " << face << ", node " << node;
            if (node == 0)
                break;
        }
    }
}

TEST(OrbitTree, HoldsAllPointsOfItsFaces) {
    std::mt19937 random(3);
    const test::Soup torus = test::torus(20, 9);
    const test::Soup cube = test::cube(); // squares, of which some surround the axis
    for (int i = 0; i < 12; ++i) {
        const double pitch = i % 3 == 0 ? 0 : uniform(random, -1, 1);
        expect_to_hold_all(Polyhedron::from_polygons(torus.vertices, torus.faces).body(), pitch, random);
        expect_to_hold_all(Polyhedron::from_polygons(cube.vertices, cube.faces).body(), pitch, random);
    }
}

} // namespace
} // namespace chasles::memory
