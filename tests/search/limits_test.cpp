// Lists of limits against lists that are searched whole.
#include "chasles/search/limits.h"

#include <gtest/gtest.h>
#include <random>

namespace chasles::search {
namespace {

TEST(Limits, TakesWhatIsNotGreaterThanTheBound) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(0, 1);
    Limits limits;
    std::vector<double> plain;
    std::size_t taken_in_all = 0;
    for (int round = 0; round < 400; ++round) {
        for (int i = 0; i < 5; ++i) {
            plain.push_back(number(random));
            limits.push_back(plain.back());
        }
        for (int i = 0; i < 5; ++i) {
            const std::size_t index = random() % plain.size();
            const double limit = number(random);
            const bool raises = random() % 2 == 0;
            plain[index] = raises ? std::max(plain[index], limit) : limit;
            raises ? limits.raise(index, limit) : limits.set(index, limit);
        }
        const double bound = 0.3 * number(random);
        std::size_t expected = 0;
        const auto taken = limits.take_up_to(bound);
        for (std::size_t i = 0; i < plain.size(); ++i) {
            if (plain[i] > bound)
                continue;
            ASSERT_LT(expected, taken.size());
            EXPECT_EQ(taken[expected].index, i);
            EXPECT_EQ(taken[expected].limit, plain[i]);
            ++expected;
            plain[i] = std::numeric_limits<double>::infinity();
        }
        EXPECT_EQ(taken.size(), expected);
        taken_in_all += expected;
    }
    EXPECT_GT(taken_in_all, 500U);
    limits.clear();
    EXPECT_TRUE(limits.take_up_to(1).empty());
}

} // namespace
} // namespace chasles::search
