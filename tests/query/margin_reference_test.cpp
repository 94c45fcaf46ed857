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
        EXPECT_GT((tally.touches - tally.at_start) * 20, tally.queries) << family.name << ": hardly any contact";
        EXPECT_LT(tally.uncertain * 2, tally.queries) << family.name;
    }
}

} // namespace
} // namespace chasles::test
