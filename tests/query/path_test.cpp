// Paths of poses, and batches on any number of threads.
#include "chasles/query/path.h"

#include "chasles/base/invalid_input.h"
#include "chasles/query/batch.h"
#include "scenes/nut_motions.h"
#include "scenes/threaded_fastener.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

TEST(Path, TellsTheSegmentAndTheTimeWithinIt) {
    const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    const std::vector<Pose> poses{shifted(-4, 0, 0), shifted(-3, 0, 0), shifted(-2, 0, 0), shifted(2, 0, 0)};
    std::vector<std::size_t> reported;
    const PathContact found = first_contact_on_path(
        {.moving = body, .fixed = body, .motions = screws_along(poses), .progress = [&](std::size_t done) {
             reported.push_back(done);
         }});
    EXPECT_EQ(found.contact.verdict, Verdict::contact);
    EXPECT_EQ(found.segment, 2u);
    EXPECT_NEAR(found.contact.time.lower, 0.25, 1e-11);
    EXPECT_EQ(reported, (std::vector<std::size_t>{1, 2, 3}));
}

TEST(Path, ClearPathCountsTheWorkOfAllSegments) {
    const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    const std::vector<Pose> poses{shifted(-4, 1.00001, 0), shifted(0, 1.00001, 0), shifted(4, 1.00001, 0)};
    const PathContact found = first_contact_on_path({.moving = body, .fixed = body, .motions = screws_along(poses)});
    EXPECT_EQ(found.contact.verdict, Verdict::clear);
    EXPECT_EQ(found.segment, 1u);
    EXPECT_GE(found.contact.work.node_pairs, 2u);
}

TEST(Path, FewerThanTwoPosesAreRefused) {
    const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    const std::vector<Pose> poses{Pose()};
    EXPECT_THROW(static_cast<void>(screws_along(poses)), InvalidInput);
    EXPECT_THROW(static_cast<void>(first_contact_on_path({.moving = body, .fixed = body, .motions = {}})),
                 InvalidInput);
}

std::vector<Motion> twists_along(std::span<const Pose> poses) {
    std::vector<Motion> twists;
    for (std::size_t i = 1; i < poses.size(); ++i)
        twists.emplace_back(ConstantTwist::between(poses[i - 1], poses[i]));
    return twists;
}

/// The steps of a nut off its bolt. After the first ones the axis is known (note 32).
void expect_to_answer_as_its_steps(const std::vector<Motion>& steps, Verdict verdict) {
    const Polyhedron nut = scenes::nut({});
    const Polyhedron bolt = scenes::bolt({});
    const PathContact path = first_contact_on_path({.moving = nut, .fixed = bolt, .motions = steps});
    std::uint64_t node_pairs = 0;
    FirstContact alone;
    std::size_t segment = 0;
    for (; segment < steps.size() && alone.verdict != Verdict::contact; ++segment) {
        alone = first_contact({.moving = nut, .fixed = bolt, .motion = steps[segment]});
        node_pairs += alone.work.node_pairs;
    }
    EXPECT_EQ(path.contact.verdict, alone.verdict);
    EXPECT_EQ(path.segment, segment - 1);
    EXPECT_NEAR(path.contact.time.lower, alone.time.lower, 2e-12);
    EXPECT_EQ(path.contact.verdict, verdict);
    if (verdict == Verdict::clear) {
        EXPECT_LT(2 * path.contact.work.node_pairs, node_pairs);
    }
}

TEST(Path, OffAThreadAnswersAsItsStepsByThemselves) {
    for (const double slide : {2.0, 1.75}) {
        SCOPED_TRACE(slide);
        std::vector<Pose> poses;
        for (int i = 0; i <= 36; ++i)
            poses.push_back(scenes::nut_pose({.height = 10, .slide_per_turn = slide}, i / 36.0));
        const Verdict verdict = slide == 2 ? Verdict::clear : Verdict::contact;
        expect_to_answer_as_its_steps(screws_along(poses), verdict);
        expect_to_answer_as_its_steps(twists_along(poses), verdict);
    }
}

bool same_bits(const FirstContact& a, const FirstContact& b) {
    return a.verdict == b.verdict && a.time.lower == b.time.lower && a.time.upper == b.time.upper &&
           a.tau.lower == b.tau.lower && a.certain == b.certain && a.contacts.size() == b.contacts.size();
}

TEST(Batch, AnswersAreTheSameForAnyNumberOfThreads) {
    std::mt19937 random(11);
    const Polyhedron a = random_octahedron(random).polyhedron();
    const Polyhedron b = random_octahedron(random).polyhedron();
    std::vector<Motion> motions;
    for (int i = 0; i < 300; ++i)
        motions.emplace_back(ScrewMotion::between(random_pose(random, 3, 1), random_pose(random, 3, 1)));
    std::size_t last = 0;
    const auto count = [&](std::size_t done) { last = done; };
    const auto one =
        first_contact_batch({.moving = a, .fixed = b, .motions = motions, .batch = {.threads = 1, .progress = count}});
    EXPECT_EQ(last, motions.size());
    ASSERT_EQ(one.size(), motions.size());
    for (const unsigned threads : {0u, 2u, 5u}) {
        const auto many =
            first_contact_batch({.moving = a, .fixed = b, .motions = motions, .batch = {.threads = threads}});
        for (std::size_t i = 0; i < motions.size(); ++i)
            EXPECT_TRUE(same_bits(one[i], many[i])) << "motion " << i << ", " << threads << " threads";
    }
    for (std::size_t i = 0; i < motions.size(); ++i)
        EXPECT_TRUE(same_bits(one[i], first_contact({.moving = a, .fixed = b, .motion = motions[i]})));
}

} // namespace
} // namespace chasles::test
