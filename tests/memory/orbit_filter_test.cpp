// Searches with and without what is known about their axis.
#include "chasles/memory/orbit_filter.h"

#include "chasles/query/pair_query.h"
#include "scenes/nut_motions.h"
#include "scenes/threaded_fastener.h"
#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles::memory {
namespace {

using Eigen::Vector3d;
using search::PieceContext;
using test::uniform;

/// A nut on its thread, in steps of ten degrees.
struct Thread {
    Polyhedron nut = scenes::nut({});
    Polyhedron bolt = scenes::bolt({});

    static Motion step(int from, int to) {
        return ScrewMotion::between(scenes::nut_pose({.height = 10}, from / 36.0),
                                    scenes::nut_pose({.height = 10}, to / 36.0));
    }
    [[nodiscard]] PieceContext context(const Motion& way) const {
        return {nut.body(), bolt.body(), way.trajectory().pieces()->at(0)};
    }
};

/// More than enough for trees to pay.
Work dear() {
    Work work;
    work.node_pairs = 100'000'000;
    return work;
}

TEST(OrbitFilter, ServesTheNextTurnsAboutAnAxisThatWasDear) {
    const Thread thread;
    OrbitFilter filter(thread.nut.body(), thread.bolt.body());
    Work work;
    const auto asks = [&](const Motion& way) { return filter.pairs_worth_testing(thread.context(way), 0, {}, work); };
    EXPECT_FALSE(asks(Thread::step(0, 1)));
    filter.learn(thread.context(Thread::step(0, 1)), {});
    EXPECT_FALSE(asks(Thread::step(1, 2))); // it was cheap
    filter.learn(thread.context(Thread::step(0, 1)), dear());
    EXPECT_EQ(work.node_pairs, 0U);
    for (const Motion& way : {Thread::step(1, 2), Thread::step(9, 7), Thread::step(-30, -29)}) {
        const auto pairs = asks(way);
        ASSERT_TRUE(pairs);
        EXPECT_LT(pairs->size(), thread.nut.face_count() * thread.bolt.face_count() / 10000);
    }
    EXPECT_GT(work.node_pairs, 0U);
}

TEST(OrbitFilter, KnowsNothingOfOtherAxes) {
    const Thread thread;
    OrbitFilter filter(thread.nut.body(), thread.bolt.body());
    filter.learn(thread.context(Thread::step(0, 1)), dear());
    Work work;
    const Pose start = scenes::nut_pose({.height = 10}, 0);
    const Pose turned = scenes::nut_pose({.height = 10}, 1.0 / 36);
    Pose steeper = turned, aside = turned;
    steeper.translation.z() += 0.2;
    aside.translation.x() += 0.2;
    const Motion steep = ScrewMotion::between(start, steeper);
    for (const Motion& way :
         {steep, Motion(ScrewMotion::between(start, aside)), Motion(ConstantTwist::between(start, steeper)),
          Motion(ConstantVelocity::between(start, turned, {0.5, 0, 0})), Motion(ScrewMotion::between(start, start))})
        EXPECT_FALSE(filter.pairs_worth_testing(thread.context(way), 0, {}, work));
    // A dear search about another axis takes the place of the first one.
    filter.learn(thread.context(steep), dear());
    EXPECT_TRUE(filter.pairs_worth_testing(thread.context(steep), 0, {}, work));
    EXPECT_FALSE(filter.pairs_worth_testing(thread.context(steep), 0, {0, 0.5}, work))
        << "its windows are of the whole piece";
    EXPECT_FALSE(filter.pairs_worth_testing(thread.context(Thread::step(0, 1)), 0, {}, work));
}

/// The helix of a constant twist, and the same one by a constant velocity, are near the paper's screw.
TEST(OrbitFilter, ServesEnclosedMotionsOnAHelix) {
    const Thread thread;
    OrbitFilter filter(thread.nut.body(), thread.bolt.body());
    const Pose start = scenes::nut_pose({.height = 10}, 0);
    const Pose turned = scenes::nut_pose({.height = 10}, 1.0 / 36);
    const Motion twist = ConstantTwist::between(start, turned);
    filter.learn(thread.context(twist), dear());
    Work work;
    for (const Motion& way : {twist, Motion(ConstantVelocity::between(start, turned)), Thread::step(9, 8)}) {
        const auto pairs = filter.pairs_worth_testing(thread.context(way), 0, {}, work);
        ASSERT_TRUE(pairs);
        EXPECT_LT(pairs->size(), thread.nut.face_count() * thread.bolt.face_count() / 5000);
    }
}

/// A tip turns about the axis and reaches out on its way, by less than a part in ten thousand of its arm. At both ends,
/// from which the cubic motion is made, it is on one circle.
TEST(OrbitFilter, CountsHowFarAnEnclosedMotionIsFromTheCubicOne) {
    constexpr double reach = 6e-5;
    const Motion way =
        Motion::hinge({0, 0, 0}, {0, 0, 1}, {-0.05, 0.1}) * Motion::slider({1, 0, 0}, {0, 4 * reach, -4 * reach});
    const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const std::vector<Vector3d> tip{{1, 0, 0}, {0, 0.1, 0}, {0, -0.1, 0}, {0, 0, 0.1}};
    constexpr double place = 1 + reach / 2;
    const std::vector<Vector3d> plate{
        {place, 0, 0.004}, {place, -0.004, -0.004}, {place, 0.004, -0.004}, {place + 0.01, 0, 0}};
    const Polyhedron arm = Polyhedron::from_polygons(tip, faces);
    const Polyhedron stop = Polyhedron::from_polygons(plate, faces);
    OrbitFilter filter(arm.body(), stop.body());
    const PieceContext context{arm.body(), stop.body(), way.trajectory().pieces()->at(0)};
    ASSERT_TRUE(context.is_enclosed());
    filter.learn(context, dear());
    Work work;
    EXPECT_TRUE(filter.pairs_worth_testing(context, 0, {}, work));
    EXPECT_EQ(query::answer({arm.body(), stop.body(), way.trajectory(), {}, 1, filter}).verdict, Verdict::contact);
}

TEST(OrbitFilter, GivesUpWhereItDoesNotPay) {
    const Thread thread;
    OrbitFilter filter(thread.nut.body(), thread.bolt.body());
    Work just_enough;
    just_enough.node_pairs = 6000; // of which a quarter may be tested
    const Motion way = Thread::step(0, 1);
    for (int i = 0; i < 1000; ++i)
        filter.learn(thread.context(way), just_enough);
    Work work;
    EXPECT_FALSE(filter.pairs_worth_testing(thread.context(way), 2, {}, work)); // within 2 mm is a lot
    EXPECT_GT(work.node_pairs, 1000U);
    EXPECT_LT(work.node_pairs, 2000U);
    const Work tested = work;
    for (int i = 0; i < 200; ++i)
        filter.learn(thread.context(way), just_enough);
    EXPECT_FALSE(filter.pairs_worth_testing(thread.context(way), 2, {}, work));
    EXPECT_EQ(work.node_pairs, tested.node_pairs); // it waits longer now
}

TEST(OrbitFilter, ChangesNoAnswer) {
    const auto ring = [](std::uint32_t around, std::uint32_t across) {
        const test::Soup soup = test::torus(around, across);
        return Polyhedron::from_polygons(soup.vertices, soup.faces);
    };
    const Polyhedron moving = ring(24, 10);
    const Polyhedron fixed = ring(26, 11);
    std::mt19937 random(17);
    int contacts = 0, clear = 0, filtered[2] = {0, 0};
    for (int i = 0; i < 600; ++i) {
        const bool is_enclosed = i % 2 == 1;
        const Pose home = test::turned({uniform(random, 1.2, 1.6), 0, 0}, Vector3d::UnitX(), 1.5);
        const double slide = is_enclosed ? 0.1 : 0.3;
        const Pose next = test::composed(home, test::random_pose(random, slide, 0.6));
        const Motion way = is_enclosed ? Motion(ConstantTwist::between(home, next)) : ScrewMotion::between(home, next);
        QueryOptions options;
        options.margin = i % 3 == 0 ? uniform(random, 0, 0.2) : 0;
        options.find = i % 5 == 0 ? Find::any : Find::first;
        OrbitFilter filter(moving.body(), fixed.body());
        filter.learn({moving.body(), fixed.body(), way.trajectory().pieces()->at(0)}, dear());
        const FirstContact found[2] = {
            query::answer({moving.body(), fixed.body(), way.trajectory(), options}),
            query::answer({moving.body(), fixed.body(), way.trajectory(), options, 1, filter})};
        EXPECT_EQ(found[0].verdict == Verdict::clear, found[1].verdict == Verdict::clear) << "motion " << i;
        if (options.find == Find::any) // any contact may be another one
            continue;
        EXPECT_EQ(found[0].verdict, found[1].verdict) << "motion " << i;
        EXPECT_EQ(found[0].certain, found[1].certain) << "motion " << i;
        EXPECT_NEAR(found[0].time.lower, found[1].time.lower, 2e-12) << "motion " << i;
        contacts += found[0].verdict == Verdict::contact ? 1 : 0;
        clear += found[0].verdict == Verdict::clear ? 1 : 0;
        filtered[is_enclosed] += found[1].work.face_pairs < found[0].work.face_pairs ? 1 : 0;
    }
    EXPECT_GT(contacts, 40);
    EXPECT_GT(clear, 25);
    EXPECT_GT(filtered[0], 10);
    EXPECT_GT(filtered[1], 10);
}

} // namespace
} // namespace chasles::memory
