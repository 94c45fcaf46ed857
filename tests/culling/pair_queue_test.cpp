// The queue of node pairs: a stack, or by time a stack for each of 64 steps. Against a plain list.
#include "chasles/culling/pair_queue.h"

#include "tests/support/random.h"

#include <gtest/gtest.h>
#include <set>

namespace chasles::culling {
namespace {

using namespace test;

NodePair pair(std::uint32_t id, float lower = 0) {
    return {id, id + 1, {lower, 1}};
}

/// Pops everything.
std::vector<std::uint32_t> drain(PairQueue& queue) {
    std::vector<std::uint32_t> ids;
    while (!queue.is_empty())
        ids.push_back(queue.pop().moving);
    return ids;
}

using Ids = std::vector<std::uint32_t>;

TEST(PairQueue, WithoutTimeTheLastPairComesFirst) {
    PairQueue queue(false);
    EXPECT_TRUE(queue.is_empty());
    queue.push(pair(1, 0.1F));
    queue.push(pair(2, 1.0F));
    queue.push(pair(3, 0.5F));
    EXPECT_FALSE(queue.is_empty());
    EXPECT_EQ(drain(queue), (Ids{3, 2, 1}));
    EXPECT_TRUE(queue.is_empty());
}

TEST(PairQueue, ByTimePairsOfAnEarlierStepComeFirst) {
    PairQueue queue(true);
    queue.push(pair(1, 0.9F));
    queue.push(pair(2, 0.0F));
    queue.push(pair(3, 1.0F));
    queue.push(pair(4, 0.5F));
    EXPECT_EQ(drain(queue), (Ids{2, 4, 1, 3}));
}

TEST(PairQueue, ByTimeTheLastPairOfAStepComesFirst) {
    PairQueue queue(true);
    const float step = 1 / 63.0F;
    queue.push(pair(1, 10.5F * step));
    queue.push(pair(2, 10.9F * step));
    queue.push(pair(3, 10.1F * step));
    queue.push(pair(4, 11.1F * step));
    EXPECT_EQ(drain(queue), (Ids{3, 2, 1, 4}));
}

TEST(PairQueue, AnEarlierPairThatComesLateOvertakes) {
    PairQueue queue(true);
    queue.push(pair(1, 0.8F));
    queue.push(pair(2, 0.4F));
    EXPECT_EQ(queue.pop().moving, 2U);
    queue.push(pair(3, 0.1F));
    EXPECT_EQ(drain(queue), (Ids{3, 1}));
}

TEST(PairQueue, EarliestIsAtMostTheEarliestStartAndLessThanAStepBefore) {
    PairQueue queue(true);
    EXPECT_EQ(queue.earliest(), 1);
    for (const float start : {1.0F, 0.77F, 0.5F, 0.3F, 0.01F, 0.0F}) {
        queue.push(pair(1, start));
        EXPECT_LE(queue.earliest(), start);
        EXPECT_GT(queue.earliest(), start - 1 / 63.0F);
    }
}

TEST(PairQueue, APairComesOutAsItWentIn) {
    PairQueue queue(true);
    queue.push({7, 9, {0.25F, 0.75F}});
    const NodePair found = queue.pop();
    EXPECT_EQ(found.moving, 7U);
    EXPECT_EQ(found.fixed, 9U);
    EXPECT_EQ(found.when.lower, 0.25F);
    EXPECT_EQ(found.when.upper, 0.75F);
}

TEST(PairQueue, ClearedItIsAsNew) {
    for (const bool by_time : {false, true}) {
        PairQueue queue(by_time);
        for (std::uint32_t i = 0; i < 10; ++i)
            queue.push(pair(i, 0.09F * float(i)));
        queue.pop();
        queue.clear();
        EXPECT_TRUE(queue.is_empty());
        if (by_time) {
            EXPECT_EQ(queue.earliest(), 1);
        }
        queue.push(pair(20, 0.5F));
        queue.push(pair(21, 0.9F));
        EXPECT_EQ(drain(queue), by_time ? (Ids{20, 21}) : (Ids{21, 20}));
    }
}

/// Places of popped pairs are used again, by pairs of any step: nothing is lost, and nothing comes twice.
TEST(PairQueue, IsAPlainListInTheOrderOfStepsForAnyPushesAndPops) {
    struct Entry {
        int step;
        std::uint32_t id;
    };
    Random random(781);
    for (const bool by_time : {false, true}) {
        PairQueue queue(by_time);
        std::vector<Entry> list; // in order of pushes
        const auto next = [&] {  // the last one of the earliest step
            auto best = list.begin();
            for (auto entry = list.begin(); entry != list.end(); ++entry)
                if (entry->step <= best->step)
                    best = entry;
            return best;
        };
        for (std::uint32_t i = 0; i < 20000; ++i) {
            const bool grows = (i / 1000) % 2 == 0;
            if (list.empty() || random.chance(grows ? 0.6 : 0.4)) {
                const auto lower = static_cast<float>(random.chance(0.1) ? random.integer(0, 1) : random.uniform(0, 1));
                queue.push(pair(i, lower));
                list.push_back({by_time ? static_cast<int>(lower * 63.0F) : 0, i});
            } else {
                const auto expected = next();
                ASSERT_EQ(queue.pop().moving, expected->id);
                list.erase(expected);
            }
            ASSERT_EQ(queue.is_empty(), list.empty());
            if (by_time) {
                ASSERT_EQ(queue.earliest(), list.empty() ? 1 : float(next()->step) / 63.0F);
            }
            if (random.chance(0.0005)) {
                queue.clear();
                list.clear();
            }
        }
    }
}

} // namespace
} // namespace chasles::culling
