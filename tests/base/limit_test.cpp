// Limits: of time, by a function, inside each other, and on the threads of the work.
#include "chasles/base/limit_of_thread.h"

#include "chasles/base/parallel_for.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace chasles {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

TEST(Limit, OfTime) {
    EXPECT_FALSE(is_cancelled());
    const Limit limit(0.02);
    EXPECT_EQ(LimitOfThread::get(), &limit);
    EXPECT_FALSE(Limit().is_over());
    std::this_thread::sleep_for(std::chrono::milliseconds(25));
    EXPECT_TRUE(limit.is_over());
    EXPECT_THROW(throw_if_cancelled(), Cancelled);
}

TEST(Limit, LongTimesDoNotWrapAround) {
    for (const double seconds : {1e9, 1e18, 1e300, forever}) {
        const Limit limit(seconds);
        EXPECT_FALSE(limit.is_over()) << seconds;
    }
}

TEST(Limit, OfNoTimeIsOverAtOnce) {
    for (const double seconds : {0.0, -1.0, -forever, std::numeric_limits<double>::quiet_NaN()}) {
        const Limit limit(seconds);
        EXPECT_TRUE(limit.is_over()) << seconds;
    }
}

TEST(Limit, EndsWithItsScope) {
    {
        const Limit limit(1e-9);
        EXPECT_TRUE(is_cancelled());
    }
    EXPECT_FALSE(is_cancelled());
}

TEST(Limit, InsideAnotherOneShortensIt) {
    const Limit outer(1e-9);
    const Limit inner(1e9);
    EXPECT_TRUE(inner.is_over());
}

TEST(Limit, AsksItsFunctionFiftyTimesASecond) {
    int calls = 0;
    bool goes_on = true;
    const Limit limit(forever, [&] { return ++calls, goes_on; });
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(110))
        EXPECT_FALSE(limit.is_over());
    EXPECT_GE(calls, 2);
    EXPECT_LE(calls, 6);
    goes_on = false;
    std::this_thread::sleep_for(std::chrono::milliseconds(25));
    EXPECT_TRUE(limit.is_over());
    goes_on = true;
    EXPECT_TRUE(limit.is_over()) << "for good";
}

TEST(Limit, HoldsOnTheThreadsOfTheWork) {
    std::atomic<int> with_limit = 0;
    const Limit limit(1e9);
    parallel_for(0, 100, [&](std::size_t begin, std::size_t end) {
        if (LimitOfThread::get() == &limit)
            with_limit += int(end - begin);
    });
    EXPECT_EQ(with_limit, 100);
    std::thread([&] { EXPECT_EQ(LimitOfThread::get(), nullptr); }).join();
}

TEST(Watch, LooksAfterSoMuchWork) {
    Watch without;
    for (int i = 0; i < 10'000; ++i)
        EXPECT_FALSE(without.is_over(1));
    const Limit limit(1e-9);
    Watch watch;
    int steps = 1;
    while (!watch.is_over(1))
        ++steps;
    EXPECT_EQ(steps, 256);
}

} // namespace
} // namespace chasles
