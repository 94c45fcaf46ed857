// A memory of two bodies is refused for other bodies; SlidingBody compares the answers with it and without it.
#include "chasles/memory/pair_memory.h"

#include "chasles/query/first_contact.h"
#include "tests/query/bodies.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

TEST(PairMemory, BelongsToTwoBodiesInTheirRoles) {
    const Polyhedron a = box({1, 1, 1}).polyhedron(), b = box({1, 2, 1}).polyhedron();
    PairMemory memory(a, b);
    EXPECT_TRUE(memory.is_of(a, b));
    EXPECT_FALSE(memory.is_of(b, a));
    const Motion motion = ScrewMotion::between(shifted(5, 0, 0), shifted(2, 0, 0));
    EXPECT_EQ(first_contact({a, b, motion, {}, &memory}).verdict, Verdict::contact);
    EXPECT_EQ(refusal([&] {
                  static_cast<void>(first_contact({b, a, motion, {}, &memory}));
              }),
              "query: memory: is of other bodies");
}

/// The memory may be asked about far places in between, and about any kind of motion.
TEST(PairMemory, ChangesNoAnswerWhereverTheBodyGoes) {
    std::mt19937 random(3);
    const Polyhedron moving = box({0.3, 0.2, 0.1}).polyhedron(), fixed = box({1, 1, 1}).polyhedron();
    PairMemory memory(moving, fixed);
    int contacts = 0, clear = 0;
    for (int i = 0; i < 3000; ++i) {
        const double reach = i % 4 == 0 ? 0.5 : 1e-3;
        const Pose start = turned({uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, 1.05, 1.4)},
                                  {1, 1, 0}, uniform(random, -0.3, 0.3));
        const Pose goal = composed(start, turned(random_vector(random, reach), {0, 1, 2}, uniform(random, 0, reach)));
        const Motion motion =
            i % 3 == 0 ? Motion(SweepMotion::between(start, goal)) : ScrewMotion::between(start, goal);
        const QueryOptions options{.margin = uniform(random, 0.001, 0.1)};
        const FirstContact found = first_contact({moving, fixed, motion, options, &memory});
        const FirstContact expected = first_contact({moving, fixed, motion, options});
        EXPECT_EQ(found.verdict, expected.verdict) << "motion " << i;
        EXPECT_LE(found.time.lower, expected.time.upper) << "motion " << i; // both contain the true time
        EXPECT_LE(expected.time.lower, found.time.upper) << "motion " << i;
        EXPECT_LE(found.time.upper - found.time.lower, 1e-12) << "motion " << i;
        contacts += found.verdict == Verdict::contact ? 1 : 0;
        clear += found.verdict == Verdict::clear ? 1 : 0;
    }
    EXPECT_GT(contacts, 100);
    EXPECT_GT(clear, 500);
}

} // namespace
} // namespace chasles::test
