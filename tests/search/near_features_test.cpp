// The traversal at rest against the test of every pair of features.
#include "chasles/search/near_features.h"

#include "chasles/contact/near_pair.h"
#include "chasles/search/owned_pairs.h"
#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"
#include "tests/support/grid.h"

#include <gtest/gtest.h>
#include <set>

namespace chasles::search {
namespace {

using contact::FeaturePair;
using test::uniform;

/// Excludes no feature.
struct AllMayMeet {
    static bool may_meet(std::uint32_t) { return true; }
    static bool may_meet(const Edge&) { return true; }
};

/// Two bodies at rest.
struct Scene {
    Polyhedron moving;
    Polyhedron fixed;
    Motion motion;
    PieceContext context{moving.body(), fixed.body(), motion.trajectory().pieces()->at(0)};
    contact::RelativeConfiguration bodies{moving.body(), fixed.body(), context.maps(), 0};

    Scene(Polyhedron mover, Polyhedron target, const Pose& pose)
        : moving(std::move(mover)), fixed(std::move(target)), motion(ScrewMotion::between(pose, pose)) {}

    [[nodiscard]] contact::ContactScene within(double margin) const {
        return {bodies, true, margin, contact::touch_slack(bodies, context.error_scale(margin), 0)};
    }
    NearFeatures find(double margin, const NearSearch& search = {}) {
        return near_features(context, within(margin), 0, search);
    }
};

/// Every pair of features, owned by whatever faces, that passes the test of one pair.
std::set<FeaturePair> all_in_contact(const Scene& scene, double margin) {
    const contact::ContactScene within = scene.within(margin);
    contact::NearTest test(within);
    std::set<FeaturePair> found;
    const auto add = [&](const FeaturePair& features) {
        if (test.are_in_contact(features))
            found.insert(features);
    };
    for (std::uint32_t f = 0; f < scene.moving.face_count(); ++f)
        for (std::uint32_t g = 0; g < scene.fixed.face_count(); ++g)
            for_each_owned_pair<true>(scene.moving.body(), scene.fixed.body(), {f, g}, AllMayMeet(), AllMayMeet(), add);
    return found;
}

std::set<FeaturePair> set_of(const NearFeatures& near) {
    std::set<FeaturePair> pairs(near.pairs.begin(), near.pairs.end());
    EXPECT_EQ(pairs.size(), near.pairs.size()) << "each once";
    return pairs;
}

/// A bumpy plate of 2 n^2 triangles.
Polyhedron bumpy(std::uint32_t n, std::mt19937& random) {
    test::Body body;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            body.vertices.emplace_back(2.0 * i / n - 1, 2.0 * j / n - 1, uniform(random, -0.1, 0.1));
    body.faces = test::grid_triangles(n, n);
    return body.polyhedron();
}

TEST(NearFeatures, WithinAMarginAreThoseOfEveryPair) {
    std::mt19937 random(41);
    std::size_t most = 0;
    for (int i = 0; i < 60; ++i) {
        const bool is_plate = i % 2 == 0;
        Scene scene(is_plate ? bumpy(6, random) : test::random_octahedron(random).polyhedron(),
                    is_plate ? bumpy(5, random) : test::random_octahedron(random).polyhedron(),
                    test::turned({0.1, 0.2, is_plate ? 0.4 : 2.5}, test::random_vector(random, 1),
                                 is_plate ? 0.1 : uniform(random, 0, 3)));
        const double margin = uniform(random, 0.1, 3);
        const NearFeatures near = scene.find(margin, {.most_visits = 1 << 24});
        EXPECT_FALSE(near.is_cut);
        EXPECT_EQ(near.complete_within, margin);
        EXPECT_EQ(set_of(near), all_in_contact(scene, margin)) << "scene " << i;
        most = std::max(most, near.pairs.size());
    }
    EXPECT_GT(most, 10U);
}

TEST(NearFeatures, OfSmoothBodiesThatAreFarWithinTheMarginAreThoseOfEveryPair) {
    const test::Soup soup = test::torus(16, 10);
    const Polyhedron torus = Polyhedron::from_polygons(soup.vertices, soup.faces);
    std::mt19937 random(44);
    const double size = torus.body().bvh().radius();
    std::size_t most = 0;
    for (int i = 0; i < 8; ++i) {
        Scene scene(torus, torus,
                    test::turned(uniform(random, 0.5, 2) * size * test::random_vector(random, 1).normalized(),
                                 test::random_vector(random, 1), uniform(random, 0, 3)));
        const double margin = 5 * size; // everything is within it, and the cones cull nearly everything
        const NearFeatures near = scene.find(margin, {.most_visits = 1 << 24});
        EXPECT_EQ(set_of(near), all_in_contact(scene, margin)) << "scene " << i;
        most = std::max(most, near.pairs.size());
        EXPECT_LT(near.work.face_pairs, 320U * 320 / 4);
    }
    EXPECT_GT(most, 5U);
}

TEST(NearFeatures, OfATouchAreTheThreeKindsOfPairs) {
    const Polyhedron cube = test::box({1, 1, 1}).polyhedron();
    Scene scene(cube, cube, test::turned({0.2, 0.1, 2}, {0, 0, 1}, 0.3));
    std::size_t found = 0;
    for (const FeaturePair& features : set_of(scene.find(0))) {
        EXPECT_LE(features.kind, ContactKind::edge_edge);
        ++found;
    }
    EXPECT_GT(found, 4U);
}

TEST(NearFeatures, NothingIsNearBodiesThatAreApart) {
    const Polyhedron cube = test::box({1, 1, 1}).polyhedron();
    Scene scene(cube, cube, test::shifted(0, 0, 2.5));
    EXPECT_TRUE(scene.find(0).pairs.empty());
    EXPECT_TRUE(scene.find(0.4).pairs.empty());
    EXPECT_FALSE(scene.find(0.6).pairs.empty());
}

TEST(NearFeatures, AListThatIsCutHoldsTheNearest) {
    std::mt19937 random(43);
    Scene scene(bumpy(30, random), bumpy(30, random), test::turned({0, 0, 0.4}, {1, 2, 3}, 0.01));
    const NearFeatures all = scene.find(1, {.most_pairs = 1 << 20, .most_visits = 1 << 30});
    const NearFeatures some = scene.find(1, {.most_pairs = all.pairs.size() / 2, .most_visits = 1 << 30});
    ASSERT_FALSE(all.is_cut);
    ASSERT_TRUE(some.is_cut);
    EXPECT_LT(some.pairs.size(), all.pairs.size());
    ASSERT_GT(some.complete_within, 0);
    std::size_t nearer = 0;
    for (const FeaturePair& features : all.pairs)
        nearer += scene.bodies.nearest(features).apart().norm() <= some.complete_within ? 1 : 0;
    EXPECT_EQ(nearer, some.pairs.size());
    EXPECT_TRUE(scene.find(1, {.most_visits = 100}).is_cut);
}

TEST(NearFeatures, RefinementsMakeAListThatIsCutLonger) {
    std::mt19937 random(43);
    Scene scene(bumpy(30, random), bumpy(30, random), test::turned({0, 0, 0.4}, {1, 2, 3}, 0.01));
    const NearFeatures all = scene.find(1, {.most_pairs = 1 << 20, .most_visits = 1 << 30});
    const NearSearch coarse{.most_pairs = all.pairs.size() / 2, .most_visits = 1 << 30};
    NearSearch fine = coarse;
    fine.refinements = 6;
    const NearFeatures some = scene.find(1, coarse), more = scene.find(1, fine);
    EXPECT_GT(more.complete_within, some.complete_within);
    EXPECT_LT(more.complete_within, 2 * some.complete_within);
    EXPECT_GT(more.pairs.size(), some.pairs.size());
    EXPECT_LE(more.pairs.size(), coarse.most_pairs);
    EXPECT_GT(double(more.pairs.size()), 0.9 * double(coarse.most_pairs)) << "nearly as many as allowed";
    EXPECT_TRUE(more.is_cut);
    std::set<FeaturePair> nearer;
    for (const FeaturePair& features : all.pairs)
        if (scene.bodies.nearest(features).apart().norm() <= more.complete_within)
            nearer.insert(features);
    EXPECT_EQ(set_of(more), nearer);
}

TEST(NearFeatures, RefinementsFindSomethingWhereNothingIsNearerThanHalfTheMargin) {
    std::mt19937 random(44);
    Scene scene(bumpy(30, random), bumpy(30, random), test::turned({0, 0, 0.75}, {1, 2, 3}, 0.01));
    const NearFeatures all = scene.find(1, {.most_pairs = 1 << 20, .most_visits = 1 << 30});
    const NearFeatures some = scene.find(1, {.most_pairs = 10, .refinements = 12});
    ASSERT_FALSE(some.pairs.empty());
    EXPECT_TRUE(some.is_cut);
    EXPECT_GT(some.complete_within, 0.5);
    double nearest = 1, nearest_found = 1;
    for (const FeaturePair& features : all.pairs)
        nearest = std::min(nearest, scene.bodies.nearest(features).apart().norm());
    for (const FeaturePair& features : some.pairs)
        nearest_found = std::min(nearest_found, scene.bodies.nearest(features).apart().norm());
    EXPECT_EQ(nearest_found, nearest);
}

/// A box above a table, tilted: its upper corners are no local minima, and neither are its edges beside an edge of the
/// table. Corners count by the normal of the table, edges only if they are nearly minima.
TEST(NearFeatures, SlopesCountByTheKindOfPair) {
    Scene scene(test::box({1, 1, 1}).polyhedron(), test::box({0.9, 0.9, 1}).polyhedron(),
                test::turned({0, 0, 2.3}, {1, 1, 0}, 0.1));
    const auto count = [&](const contact::Slopes& slopes) {
        contact::ContactScene within = scene.within(0.5);
        within.slopes = slopes;
        std::size_t flat = 0, others = 0;
        for (const FeaturePair& features : near_features(scene.context, within, 0, {}).pairs)
            ++(features.kind == ContactKind::vertex_face || features.kind == ContactKind::face_vertex ? flat : others);
        return std::pair(flat, others);
    };
    const auto [strict_flat, strict_others] = count({});
    const auto [flat, few] = count({.vertex_face = 0.25});
    const auto [same, many] = count({.vertex_face = 0.25, .others = 0.25});
    EXPECT_GT(flat, strict_flat);
    EXPECT_EQ(few, strict_others);
    EXPECT_EQ(same, flat);
    EXPECT_GT(many, few);
}

TEST(NearFeatures, AListThatIsCutHoldsTheNearestWhereNothingIsNearerThanHalfTheMargin) {
    std::mt19937 random(44);
    Scene scene(bumpy(30, random), bumpy(30, random), test::turned({0, 0, 0.75}, {1, 2, 3}, 0.01));
    ASSERT_TRUE(scene.find(0.5).pairs.empty());
    const NearFeatures all = scene.find(1, {.most_pairs = 1 << 20, .most_visits = 1 << 30});
    double nearest = 1;
    for (const FeaturePair& features : all.pairs)
        nearest = std::min(nearest, scene.bodies.nearest(features).apart().norm());
    for (const NearSearch& search : {NearSearch{.most_pairs = 10}, NearSearch{.most_pairs = 1},
                                     NearSearch{.most_visits = 100}, NearSearch{.most_visits = 1000}}) {
        const NearFeatures some = scene.find(1, search);
        EXPECT_TRUE(some.is_cut);
        EXPECT_NEAR(some.complete_within, nearest, (1 - nearest) / 2);
        EXPECT_GE(some.complete_within, nearest * (1 - 1e-12));
        double least = 1;
        for (const FeaturePair& features : set_of(some))
            least = std::min(least, scene.bodies.nearest(features).apart().norm());
        EXPECT_EQ(least, nearest) << search.most_pairs << " pairs, " << search.most_visits << " visits";
    }
}

TEST(NearFeatures, AnOverlapIsFoundIfAsked) {
    const Polyhedron cube = test::box({1, 1, 1}).polyhedron();
    Scene scene(cube, cube, test::turned({1.2, 0.9, 1.1}, {1, 2, 3}, 0.3));
    const NearFeatures near = scene.find(0.1, {.finds_overlaps = true});
    ASSERT_TRUE(near.overlap);
    EXPECT_TRUE(near.overlap->certain);
    EXPECT_FALSE(scene.find(0.1).overlap);
}

} // namespace
} // namespace chasles::search
