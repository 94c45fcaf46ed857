// Features that are rejected before any root is computed, against the directions into the surface at many times.
#include "chasles/search/minimum_filter.h"

#include "chasles/contact/relative_configuration.h"
#include "chasles/search/birth_filter.h"
#include "tests/query/bodies.h"
#include "tests/search/bodies_in_motion.h"

#include <gtest/gtest.h>
#include <set>

namespace chasles::search {
namespace {

using contact::FeaturePair;
using contact::NearestPoints;
using test::BodiesInMotion;
using test::uniform;

/// Two squares that share the edge from vertex 2 to vertex 3, with the outer sides at a height: a roof or a gutter.
Polyhedron folded_squares(double height) {
    const test::Vertices vertices{{-1, -1, height}, {-1, 1, height}, {0, 1, 0},
                                  {0, -1, 0},       {1, 1, height},  {1, -1, height}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}};
    return Polyhedron::from_polygons(vertices, faces);
}

/// An octahedron, a roof or a gutter.
Polyhedron random_shape(std::mt19937& random) {
    if (uniform(random, 0, 1) < 0.5)
        return test::random_octahedron(random).polyhedron();
    return folded_squares(uniform(random, -1, 1));
}

BodiesInMotion random_scene(std::mt19937& random) {
    const Pose start = test::random_pose(random, 2, 3);
    const double step = std::pow(10, uniform(random, -4, -0.5));
    const Pose goal = test::composed(
        start, test::turned(test::random_vector(random, step), test::random_vector(random, 1).normalized(), step));
    return {random_shape(random), random_shape(random), ScrewMotion::between(start, goal)};
}

/// The direction of an edge, in its body's frame.
Eigen::Vector3d along(const Body& body, const Feature& edge) {
    return (body.vertices()[edge.second] - body.vertices()[edge.first]).normalized();
}

/// Whether the nearest points are inside both features, and no direction into the surfaces leads nearer.
bool is_minimum(const contact::RelativeConfiguration& bodies, const FeaturePair& features) {
    const NearestPoints nearest = bodies.nearest(features);
    const Eigen::Vector3d apart = nearest.apart().normalized();
    constexpr double across = 1e-9;
    if (fixed_feature_kind(features.kind) == FeatureKind::edge &&
        std::abs(apart.dot(along(bodies.fixed(), features.fixed))) > across)
        return false;
    if (moving_feature_kind(features.kind) == FeatureKind::edge &&
        std::abs(apart.dot(bodies.turned(along(bodies.moving(), features.moving)))) > across)
        return false;
    return bodies.descent(features, nearest) <= 0;
}

/// Whether the foot of the vertex on the plane of the face is in the triangle.
bool is_over_face(const contact::RelativeConfiguration& bodies, const FeaturePair& features) {
    const bool face_is_fixed = features.kind == ContactKind::vertex_face;
    const NearestPoints nearest = bodies.nearest(features);
    const Eigen::Vector3d foot = face_is_fixed ? nearest.on_fixed : nearest.on_moving;
    const Body& body = face_is_fixed ? bodies.fixed() : bodies.moving();
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = body.vertices()[body.face(face_is_fixed ? features.fixed.first : features.moving.first)[i]];
        if (!face_is_fixed)
            corners[i] = bodies.moved(corners[i]);
    }
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    for (std::size_t i = 0; i < 3; ++i)
        if (normal.dot((corners[(i + 1) % 3] - corners[i]).cross(foot - corners[i])) < 0)
            return false;
    return true;
}

/// Nothing is culled by sides.
struct AllSides {
    static bool may_meet(std::uint32_t /*vertex*/) { return true; }
    static bool may_meet(const Edge& /*edge*/) { return true; }
};

struct Tally {
    int minima = 0;
    int rejected = 0;
    int tested = 0;
    int faces_rejected = 0;
};

/// All features of two faces at some times of the piece.
void check(BodiesInMotion& scene, const TwoFaces& faces, BirthFilter& filter, double deviation, Tally& tally) {
    const bool may_be = filter.may_be_in({faces.moving, faces.fixed, {}, {}, 0, deviation});
    tally.faces_rejected += may_be ? 0 : 1;
    for_each_owned_pair<true>(
        scene.moving.body(), scene.fixed.body(), faces, AllSides(), AllSides(), [&](const FeaturePair& features) {
            const bool is_allowed = may_be && filter.allows(features);
            ++tally.tested;
            tally.rejected += is_allowed ? 0 : 1;
            for (const double tau : {0.0, 0.3, 0.7, 1.0}) {
                const contact::RelativeConfiguration bodies = scene.at(tau);
                const bool has_face =
                    features.kind == ContactKind::vertex_face || features.kind == ContactKind::face_vertex;
                if (!is_minimum(bodies, features) || (has_face && !is_over_face(bodies, features)))
                    continue;
                ++tally.minima;
                EXPECT_TRUE(is_allowed) << "kind " << int(features.kind) << " at " << tau;
            }
        });
}

TEST(MinimumFilter, RejectsNoLocalMinimumDuringAPiece) {
    std::mt19937 random(81);
    Tally tally;
    for (int i = 0; i < 600; ++i) {
        BodiesInMotion scene = random_scene(random);
        const culling::PieceParts parts = scene.context.parts(1);
        BirthFilter filter(scene.context, parts, 1);
        const double deviation = scene.context.deviation(1, {});
        for (std::uint32_t f = 0; f < scene.moving.face_count(); ++f)
            for (std::uint32_t g = 0; g < scene.fixed.face_count(); ++g)
                check(scene, {f, g}, filter, deviation, tally);
    }
    EXPECT_GT(tally.minima, 2000);
    EXPECT_GT(tally.rejected, tally.tested / 3);
    EXPECT_GT(tally.faces_rejected, 1000);
}

/// A gutter holds a small triangle. All that is nearest is a face of the gutter.
TEST(MinimumFilter, RejectsAnEdgeAtTheBottomOfAGutter) {
    const Polyhedron gutter = folded_squares(1);
    const Polyhedron small = test::triangle({0, -0.1, 0.4}, {0.1, 0.1, 0.5}, {-0.1, 0.1, 0.5}).polyhedron();
    BodiesInMotion scene{small, gutter, ScrewMotion::between(Pose(), test::shifted(0, 0.01, 0))};
    BirthFilter filter(scene.context, scene.context.parts(1), 1);
    for (std::uint32_t face = 0; face < 4; ++face) {
        static_cast<void>(filter.may_be_in({0, face, {}, {}, 0, 1e-6}));
        for (const Edge& edge : gutter.body().owned_edges(face)) {
            const bool is_bottom = std::set{edge.from, edge.to} == std::set<std::uint32_t>{2, 3};
            if (is_bottom) {
                EXPECT_FALSE(filter.allows({ContactKind::vertex_edge, {0, 0}, {edge.from, edge.to}}));
            }
        }
    }
}

} // namespace
} // namespace chasles::search
