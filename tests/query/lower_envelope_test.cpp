// The least of step functions, beside the least at every time.
#include "chasles/query/lower_envelope.h"

#include "tests/support/random.h"

#include <gtest/gtest.h>
#include <limits>

namespace chasles::test {
namespace {

using query::LowerEnvelope;

struct Distance {
    DistanceProfile profile;
    Bracket part;
    std::uint32_t name = 0;
};

/// Steps at sixteenths of the part.
Distance random_distance(Random& random, std::uint32_t name) {
    Distance distance;
    distance.name = name;
    const int begin = random.integer(0, 3), end = random.integer(begin + 1, 4);
    distance.part = {begin / 4.0, end / 4.0};
    distance.profile.certain = true;
    for (int i = 0; i <= 16; ++i)
        if (i == 0 || i == 16 || random.chance(0.4)) {
            distance.profile.times.push_back(i / 16.0);
            distance.profile.lower.push_back(random.integer(0, 20));
            distance.profile.upper.push_back(distance.profile.lower.back() + random.integer(0, 5));
        }
    return distance;
}

std::size_t step_during(const DistanceProfile& profile, double time) {
    return std::size_t(std::ranges::upper_bound(profile.times, time) - profile.times.begin()) - 1;
}

struct Bounds {
    double lower = std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

Bounds least_at(const std::vector<Distance>& distances, double time) {
    Bounds least;
    for (const Distance& distance : distances) {
        const auto& [profile, part, name] = distance;
        if (time < part.lower || time >= part.upper)
            continue;
        const std::size_t step = step_during(profile, (time - part.lower) / (part.upper - part.lower));
        least.lower = std::min(least.lower, profile.lower[step]);
        least.upper = std::min(least.upper, profile.upper[step]);
    }
    return least;
}

TEST(LowerEnvelope, IsTheLeastAtEveryTime) {
    Random random(4501);
    for (int trial = 0; trial < 300; ++trial) {
        LowerEnvelope envelope;
        std::vector<Distance> distances;
        for (int i = random.integer(0, 6); i > 0; --i) {
            distances.push_back(random_distance(random, std::uint32_t(distances.size())));
            envelope.add(distances.back().profile, distances.back().part, distances.back().name);
        }
        const DistanceProfile found = envelope.result();
        ASSERT_EQ(found.times.size(), found.nearest.size() + 1);
        double greatest = 0;
        for (int i = 0; i < 256; ++i) {
            const double time = (i + 0.5) / 256;
            const Bounds expected = least_at(distances, time);
            const std::size_t step = step_during(found, time);
            EXPECT_EQ(found.lower[step], expected.lower);
            EXPECT_EQ(found.upper[step], expected.upper);
            greatest = std::max(greatest, expected.upper);
            if (expected.upper < std::numeric_limits<double>::infinity()) {
                const Distance& named = distances[found.nearest[step]];
                EXPECT_EQ(least_at({named}, time).upper, expected.upper);
            }
        }
        EXPECT_EQ(envelope.greatest_upper(), greatest);
        for (std::size_t i = 1; i < found.nearest.size(); ++i) // no step is cut for nothing
            EXPECT_TRUE(found.lower[i] != found.lower[i - 1] || found.upper[i] != found.upper[i - 1] ||
                        found.nearest[i] != found.nearest[i - 1]);
    }
}

TEST(LowerEnvelope, LeavesWhatMayBeNearer) {
    LowerEnvelope envelope;
    DistanceProfile one;
    one.times = {0, 0.5, 1};
    one.lower = {1, 3, 3};
    one.upper = {2, 4, 4};
    one.certain = true;
    envelope.add(one, {0, 1}, 7);
    envelope.leave(5);
    EXPECT_TRUE(envelope.result().certain);
    envelope.leave(2.5);
    const DistanceProfile found = envelope.result();
    EXPECT_FALSE(found.certain);
    EXPECT_EQ(found.lower, (std::vector<double>{1, 2.5, 2.5}));
    EXPECT_EQ(found.upper, one.upper);
}

TEST(LowerEnvelope, NamesThatAreUsedAreInOrder) {
    std::vector<std::uint32_t> nearest{4, 1, 4, 2};
    const std::vector<char> names{'a', 'b', 'c', 'd', 'e'};
    EXPECT_EQ(query::used_names(nearest, names), (std::vector<char>{'e', 'b', 'c'}));
    EXPECT_EQ(nearest, (std::vector<std::uint32_t>{0, 1, 0, 2}));
    EXPECT_TRUE(query::used_names(nearest, std::vector<char>()).empty());
    EXPECT_TRUE(nearest.empty());
}

} // namespace
} // namespace chasles::test
