// Neighbour lists against the distances of all pairs of triangles, and searches with a list against searches without.
#include "chasles/memory/neighbour_list.h"

#include "chasles/query/pair_query.h"
#include "chasles/search/near_features.h"
#include "chasles/search/piece_search.h"
#include "tests/memory/wanderer.h"

#include <gtest/gtest.h>

namespace chasles::memory {
namespace {

using contact::FeaturePair;
using search::NearFeatures;
using search::PieceContext;
using search::PieceResult;

std::uint32_t face_of(const Polyhedron& body, std::uint32_t leaf) {
    return body.body().bvh().nodes()[leaf].first;
}

TEST(NeighbourList, ListsAllThatComesNear) {
    Wanderer bodies;
    NeighbourList list(bodies.moving().body(), bodies.fixed().body());
    int near_pairs = 0, lists = 0;
    std::size_t listed = 0;
    for (int i = 0; i < 60; ++i) {
        const Motion way = bodies.next();
        const double margin = i % 2 == 0 ? 0.02 : 0.005;
        Work work;
        const auto found = list.pairs_worth_testing(bodies.context(way), margin, {}, work);
        if (!found)
            continue;
        ++lists;
        listed += found->size();
        std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
        for (const culling::NodePair& leaves : *found)
            EXPECT_TRUE(
                pairs.insert({face_of(bodies.moving(), leaves.moving), face_of(bodies.fixed(), leaves.fixed)}).second);
        for (const auto& near : sampled_near(bodies, way, margin * (1 - 1e-9))) {
            ++near_pairs;
            EXPECT_TRUE(pairs.contains(near)) << "piece " << i << ": faces " << near.first << ", " << near.second;
        }
    }
    EXPECT_GT(lists, 40);
    EXPECT_GT(near_pairs, 500);
    EXPECT_LT(double(listed), 1.5 * near_pairs); // hardly more than what is near
}

TEST(NeighbourList, SplitsLittleAnewWhileTheBodyStaysNearItsPlace) {
    const Wanderer bodies;
    NeighbourList list(bodies.moving().body(), bodies.fixed().body());
    Work first, later;
    const auto ask = [&](double shift, Work& work) {
        Pose goal = Wanderer::home();
        goal.translation.y() += shift;
        const Motion way = ScrewMotion::between(Wanderer::home(), goal);
        return list.pairs_worth_testing(bodies.context(way), 0.01, {}, work).has_value();
    };
    ASSERT_TRUE(ask(1e-3, first));
    EXPECT_GT(first.node_pairs, 0U);
    for (const double shift : {0.0, 1e-3, -1e-3})
        ASSERT_TRUE(ask(shift, later));
    EXPECT_LT(later.node_pairs, first.node_pairs / 10);
}

TEST(NeighbourList, GivesUpOnLongWaysAndOnEnclosedMotions) {
    const Wanderer bodies;
    NeighbourList list(bodies.moving().body(), bodies.fixed().body());
    Work work;
    const Motion far = ScrewMotion::between(Pose(), test::shifted(3, 0, 0));
    EXPECT_FALSE(list.pairs_worth_testing(bodies.context(far), 0.01, {}, work));
    const Motion enclosed =
        ConstantTwist::between(Wanderer::home(), test::turned({1.393, 0.1, 0.1}, {1, 0.1, 0}, 1.51));
    EXPECT_FALSE(list.pairs_worth_testing(bodies.context(enclosed), 0.01, {}, work));
}

std::set<FeaturePair> set_of(const NearFeatures& near) {
    return {near.pairs.begin(), near.pairs.end()};
}

TEST(NeighbourList, ChangesNoAnswer) {
    Wanderer bodies;
    NeighbourList list(bodies.moving().body(), bodies.fixed().body());
    int contacts = 0, at_start = 0, clear = 0, overlaps = 0;
    for (int i = 0; i < 600; ++i) {
        const Motion way = bodies.next();
        QueryOptions options{.margin = 1e-4 + 0.02 * (i % 10) / 10};
        options.find = i % 3 == 0 ? Find::any : i % 3 == 1 ? Find::first : Find::first_with_all_contacts;
        const Body &moving = bodies.moving().body(), &fixed = bodies.fixed().body();
        const FirstContact expected = query::answer({moving, fixed, way.trajectory(), options});
        const FirstContact found = query::answer({moving, fixed, way.trajectory(), options, 1, list});
        EXPECT_EQ(found.verdict == Verdict::clear, expected.verdict == Verdict::clear) << "piece " << i;
        if (options.find != Find::any) { // any contact may be another one
            EXPECT_EQ(found.verdict, expected.verdict) << "piece " << i;
            EXPECT_EQ(found.time.lower, expected.time.lower) << "piece " << i;
            EXPECT_EQ(found.clear_until, expected.clear_until) << "piece " << i;
        }
        contacts += found.verdict == Verdict::contact ? 1 : 0;
        at_start += found.verdict == Verdict::contact_at_start ? 1 : 0;
        clear += found.verdict == Verdict::clear ? 1 : 0;

        PieceContext rest = bodies.context(Motion::at_rest(way.pose_at(0)));
        const contact::RelativeConfiguration placed = rest.configuration_at(0);
        const contact::ContactScene scene{placed, true, options.margin,
                                          contact::touch_slack(placed, rest.error_scale(options.margin), 0)};
        const NearFeatures without = near_features(rest, scene, 0, {.finds_overlaps = true});
        const NearFeatures with = near_features(rest, scene, 0, {.finds_overlaps = true, .memory = list});
        EXPECT_EQ(with.overlap.has_value(), without.overlap.has_value()) << "piece " << i;
        if (!with.overlap) {
            EXPECT_EQ(set_of(with), set_of(without)) << "piece " << i;
        }
        overlaps += with.overlap ? 1 : 0;
    }
    EXPECT_GT(contacts, 20);
    EXPECT_GT(at_start, 50);
    EXPECT_GT(clear, 50);
    EXPECT_GT(overlaps, 10);
}

/// A small tip far from the axis of a turn, which passes a point of the fixed body on its arc. On their chords they
/// stay apart by more than the margin. A large triangle far away makes lists pay.
TEST(NeighbourList, ContactsBetweenChordAndArcAreFound) {
    constexpr double angle = 0.16, gap = 0.002, margin = 0.003;
    const Polyhedron moving = test::triangle({1, 0, 0}, {0.99, 0.002, 0}, {0.99, -0.002, 0}).polyhedron();
    test::Body corner = test::triangle({1 + gap, 0, 0}, {1 + 1.5 * gap, 0, 0.0005}, {1 + 1.5 * gap, 0, -0.0005});
    for (const Eigen::Vector3d& vertex : {Eigen::Vector3d(-5, -5, -9), {5, -5, -9}, {0, 5, -9}})
        corner.vertices.push_back(vertex);
    corner.faces.push_back({3, 4, 5});
    const Polyhedron fixed = corner.polyhedron();
    const Motion way = ScrewMotion::between(test::turned({0, 0, 0}, Eigen::Vector3d::UnitZ(), -angle / 2),
                                            test::turned({0, 0, 0}, Eigen::Vector3d::UnitZ(), angle / 2));
    PieceContext context(moving.body(), fixed.body(), way.trajectory().pieces()->at(0));
    NeighbourList list(moving.body(), fixed.body());
    Work work;
    ASSERT_TRUE(list.pairs_worth_testing(context, margin, {}, work));

    const PieceResult found = search_piece(context, {.margin = margin, .memory = list});
    ASSERT_FALSE(found.candidates.empty());
    const Eigen::Vector3d tip = context.configuration_at(found.candidates[0].tau.lower).moved({1, 0, 0});
    EXPECT_NEAR((tip - Eigen::Vector3d(1 + gap, 0, 0)).norm(), margin, 1e-9);
    EXPECT_LT(tip.y(), 0) << "on its way to the point";
}

} // namespace
} // namespace chasles::memory
