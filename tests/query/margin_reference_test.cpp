// Queries with a margin against the exact reference: a small share of `chasles_attack --margins`.
#include "tests/attack/check_margin.h"
#include "tests/support/posed_motions.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using attack::AttackRandom;
using attack::MarginFamily;
using attack::Tally;

constexpr std::uint64_t seed = 31;

TEST(MarginQueries, EveryFamilyAgreesWithExactArithmetic) {
    std::cout << "seed " << seed << "\n";
    std::uint64_t number = 0;
    for (const MarginFamily& family : attack::margin_families()) {
        ++number;
        Tally tally;
        const auto count = static_cast<std::uint64_t>(1500 * family.share * times_if_long(20));
        for (std::uint64_t index = 0; index < count; ++index) {
            AttackRandom random(seed, number, index);
            const std::string wrong = check(family.make(random), tally);
            if (!wrong.empty())
                ADD_FAILURE() << family.name << ", index " << index << ": " << wrong;
        }
        EXPECT_FALSE(tally.is_broken()) << family.name;
        EXPECT_EQ(tally.loose, 0u) << family.name << ": alarms too early by more than the resolution";
        EXPECT_GT(tally.queries, count / 2) << family.name;
        EXPECT_GT((tally.touches - tally.at_start) * 20, tally.queries) << family.name << ": too few contacts";
        EXPECT_LT(tally.uncertain * 2, tally.queries) << family.name;
    }
}

/// A case of `chasles_attack --margins 100000`.
struct AttackCase {
    const char* family;
    std::uint64_t index;
    std::uint64_t seed = 3;
};

attack::MarginCase posed(const AttackCase& once) {
    std::uint64_t number = 200;
    for (const MarginFamily& family : attack::margin_families()) {
        AttackRandom random(once.seed, ++number, once.index);
        if (std::string_view(family.name) == once.family)
            return family.make(random);
    }
    throw std::logic_error("no such family");
}

std::string judged(const AttackCase& once, Tally& tally) {
    SCOPED_TRACE(once.family);
    const std::string wrong = check(posed(once), tally);
    EXPECT_EQ(tally.loose, 0u);
    return wrong.empty() ? "" : std::string(once.family) + ", index " + std::to_string(once.index) + ": " + wrong;
}

/// A former error: the answer described the uncertain part of a proven pair, or a pair that is proven only later.
TEST(MarginQueries, WhatIsProvenIsDescribed) {
    Tally tally;
    for (const AttackCase once : {AttackCase{"at the margin", 1301},
                                  {"at the margin", 2372},
                                  {"at the margin", 3093},
                                  {"at the margin", 10888},
                                  {"other units", 3330},
                                  {"degenerate", 13581, 11}})
        EXPECT_EQ(judged(once, tally), "");
    EXPECT_EQ(tally.uncertain, 0u);
}

/// A former error: double-double was alternately uncertain on long parts and found nothing on short parts, until the
/// limit of steps.
TEST(MarginQueries, EdgesThatTurnParallelAreToldApart) {
    Tally tally;
    for (const AttackCase once : {AttackCase{"degenerate", 3881},
                                  {"degenerate", 6460},
                                  {"at the margin", 2793},
                                  {"at the margin", 2840},
                                  {"at the margin", 8528},
                                  {"at the margin", 14928},
                                  {"slides above", 3496},
                                  {"slides above", 4335},
                                  {"slides above", 6289},
                                  {"other units", 504},
                                  {"other units", 4293}})
        EXPECT_EQ(judged(once, tally), "");
    EXPECT_EQ(tally.uncertain, 0u);
}

/// Contacts at tau 5e-17 and 6e-19, when two flat faces start to turn.
TEST(MarginQueries, FirstInstantsAreJudgedExactly) {
    Tally tally;
    for (const AttackCase once : {AttackCase{"rolling", 2921}, {"rolling", 4477}})
        EXPECT_EQ(judged(once, tally), "");
    EXPECT_EQ(tally.uncertain, 0u);
}

} // namespace
} // namespace chasles::test
