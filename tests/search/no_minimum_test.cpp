// A proof that features are no local minimum of the distance, against the distance at many later times.
#include "chasles/search/no_minimum.h"

#include "chasles/contact/relative_configuration.h"
#include "tests/query/bodies.h"
#include "tests/search/bodies_in_motion.h"

#include <gtest/gtest.h>

namespace chasles::search {
namespace {

using contact::FeaturePair;
using contact::RelativeConfiguration;
using test::BodiesInMotion;
using test::uniform;

/// Empty if the shortest connection of the lines of two edges ends beside an edge.
std::optional<double> descent_beside(const BodiesInMotion& scene, const FeaturePair& features, double tau) {
    const RelativeConfiguration bodies = scene.at(tau);
    const contact::NearestPoints nearest = bodies.nearest(features);
    if (features.kind == ContactKind::edge_edge) {
        const auto ends = [](const Body& body, const Feature& edge) {
            return body.vertices()[edge.second] - body.vertices()[edge.first];
        };
        const Eigen::Vector3d apart = nearest.apart().normalized();
        if (std::abs(apart.dot(ends(scene.fixed.body(), features.fixed))) > 1e-9 ||
            std::abs(apart.dot(bodies.turned(ends(scene.moving.body(), features.moving)))) > 1e-9)
            return std::nullopt;
    }
    return bodies.descent(features, nearest);
}

std::optional<double> falls_until(const BodiesInMotion& scene, const FeaturePair& features, double tau, double margin) {
    return no_minimum_until(scene.context, features, tau, margin, scene.context.error_scale(margin).length);
}

/// A pair of features of two octahedra of triangles.
FeaturePair random_features(std::mt19937& random, const BodiesInMotion& scene, ContactKind kind) {
    const auto feature = [&](const Body& body, FeatureKind what) -> Feature {
        const auto face = std::uint32_t(random() % body.face_count());
        const std::uint32_t from = body.face(face)[0];
        const std::uint32_t to = body.face(face)[1];
        return what == FeatureKind::face     ? Feature{face, face}
               : what == FeatureKind::vertex ? Feature{from, from}
                                             : Feature{from, to};
    };
    return {kind, feature(scene.moving.body(), moving_feature_kind(kind)),
            feature(scene.fixed.body(), fixed_feature_kind(kind))};
}

BodiesInMotion random_scene(std::mt19937& random) {
    const auto start = test::random_pose(random, 3, 3);
    const auto goal = test::random_pose(random, 3, 3);
    return {test::random_octahedron(random).polyhedron(), test::random_octahedron(random).polyhedron(),
            ScrewMotion::between(start, uniform(random, 0, 1) < 0.2 ? Pose(goal.translation, start.rotation) : goal)};
}

/// Checks that the distance falls beside the features at many times. Returns the number of times that tell.
int descents(const BodiesInMotion& scene, const FeaturePair& features, double tau, double until) {
    int count = 0;
    for (int sample = 0; sample <= 20; ++sample) {
        const auto descent = descent_beside(scene, features, std::min(1.0, tau + (until - tau) * sample / 20));
        EXPECT_GT(descent.value_or(1), 0) << "kind " << int(features.kind) << " at tau " << tau;
        count += descent ? 1 : 0;
    }
    return count;
}

TEST(NoMinimum, TheDistanceFallsBesideTheFeaturesForAsLongAsIsProven) {
    std::mt19937 random(71);
    for (const ContactKind kind : {ContactKind::vertex_face, ContactKind::face_vertex, ContactKind::edge_edge,
                                   ContactKind::vertex_edge, ContactKind::edge_vertex, ContactKind::vertex_vertex}) {
        int samples = 0;
        for (int i = 0; i < 5000 && samples < 3000; ++i) {
            const BodiesInMotion scene = random_scene(random);
            const FeaturePair features = random_features(random, scene, kind);
            const double tau = uniform(random, 0, 0.9);
            const double margin = scene.at(tau).nearest(features).apart().norm() * uniform(random, 0.8, 1.3);
            const auto until = falls_until(scene, features, tau, margin);
            if (!until)
                continue;
            EXPECT_GT(*until, tau);
            samples += descents(scene, features, tau, *until);
        }
        EXPECT_GT(samples, 1000) << "kind " << int(kind);
    }
}

TEST(NoMinimum, EndsBeforeTheConnectionOfNearlyParallelEdgesTurnsAway) {
    // The upper edge turns about an axis across both. Their connection turns twenty times as fast.
    constexpr double angle = 0.05;
    constexpr double slope = 0.2; // of the face beside the lower edge
    const FeaturePair edges{ContactKind::edge_edge, {0, 1}, {0, 1}};
    for (const double turn : {0.5, -0.5}) {
        const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0);
        const BodiesInMotion scene{
            test::triangle(-along, along, {0, 0, 1}).polyhedron(),
            test::triangle({-1, 0, 0}, {1, 0, 0}, {0, std::cos(slope), std::sin(slope)}).polyhedron(),
            ScrewMotion::between(test::shifted(0, 0, 0.2), test::turned({0, 0, 0.2}, {0, 1, 0}, turn))};
        const auto until = falls_until(scene, edges, 0, 0.2);
        ASSERT_TRUE(until);
        EXPECT_EQ(descents(scene, edges, 0, *until), 21);
    }
}

/// A corner runs around an edge of a box at a constant distance, from beyond its top to its outer side.
struct Orbit {
    static constexpr double distance = 0.2;
    double turn; ///< in radians
    BodiesInMotion scene{test::triangle({0, 0, 0}, {-0.02, 0.01, 0.1}, {-0.02, -0.01, 0.1}).polyhedron(),
                         test::box({1, 1, 1}).polyhedron(), ScrewMotion::between(at(0), at(turn))};
    FeaturePair corner_and_edge{ContactKind::vertex_edge, {0, 0}, {5, 7}};

    /// The pose after a turn about the edge. It begins above the top, beyond which the edge is not the nearest place.
    static Pose at(double angle) {
        constexpr double beyond = 0.5; // radians
        const Eigen::AngleAxisd about(angle - beyond, Eigen::Vector3d::UnitY());
        const Eigen::Vector3d edge(1, 0, 1);
        return {edge + about * (distance * Eigen::Vector3d::UnitZ()), Eigen::Quaterniond(about)};
    }
};

TEST(NoMinimum, EndsBeforeACornerComesOverTheEdge) {
    for (const double turn : {0.6, 1.0, 2.0, 3.0}) {
        const Orbit orbit{turn};
        double tau = 0;
        int steps = 0;
        while (const auto until = falls_until(orbit.scene, orbit.corner_and_edge, tau, Orbit::distance)) {
            tau = *until;
            ASSERT_LT(++steps, 1000);
            ASSERT_LE(orbit.scene.at(tau).moved(Eigen::Vector3d::Zero()).x(), 1) << "it is over the edge";
        }
        EXPECT_NEAR(orbit.scene.at(tau).moved(Eigen::Vector3d::Zero()).x(), 1, 1e-3) << "turn " << turn;
    }
}

TEST(NoMinimum, EndsBeforeACornerPassesOverAnEdge) {
    const BodiesInMotion scene{test::triangle({0, 0, 0}, {-0.02, 0.01, 0.1}, {-0.02, -0.01, 0.1}).polyhedron(),
                               test::box({1, 1, 1}).polyhedron(),
                               ScrewMotion::between(test::shifted(0.91, 0, 1.2), test::shifted(1.51, 0, 1.2))};
    const FeaturePair corner_and_edge{ContactKind::vertex_edge, {0, 0}, {5, 7}};
    double tau = 0;
    for (int step = 0; step < 1000; ++step) {
        const auto until = falls_until(scene, corner_and_edge, tau, 0.2);
        if (!until)
            break;
        tau = *until;
    }
    EXPECT_NEAR(tau, 0.15, 1e-3);
    EXPECT_LE(tau, 0.15);
}

TEST(NoMinimum, EndsBeforeACornerComesToThePlaneOfAFace) {
    // Beyond the plane, beside the face, the other side of the face is nearer.
    const BodiesInMotion scene{test::triangle({0, 0, 0}, {-0.02, 0.01, -0.1}, {-0.02, -0.01, -0.1}).polyhedron(),
                               test::box({1, 1, 1}).polyhedron(),
                               ScrewMotion::between(test::shifted(3, 0, 1.2), test::shifted(3, 0, -8))};
    const FeaturePair corner_and_top{ContactKind::vertex_face, {0, 0}, {5, 5}};
    const auto until = falls_until(scene, corner_and_top, 0, 0.2);
    ASSERT_TRUE(until);
    EXPECT_GE(scene.at(*until).moved(Eigen::Vector3d::Zero()).z(), 1.1);
}

TEST(NoMinimum, NothingIsProvenWhereRoundingHidesTheDirection) {
    const Orbit orbit{1};
    EXPECT_TRUE(falls_until(orbit.scene, orbit.corner_and_edge, 0, Orbit::distance));
    const double error = elementary::error_unit<double>;
    EXPECT_FALSE(
        no_minimum_until(orbit.scene.context, orbit.corner_and_edge, 0, Orbit::distance, Orbit::distance / error));
}

TEST(NoMinimum, NothingIsProvenOfFeaturesThatAreNearer) {
    const Orbit orbit{1};
    EXPECT_FALSE(falls_until(orbit.scene, orbit.corner_and_edge, 0, 2 * Orbit::distance));
}

} // namespace
} // namespace chasles::search
