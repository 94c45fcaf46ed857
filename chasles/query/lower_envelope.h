// The least of many distances over time, each with bounds by steps. Source: docs/derivations/39-profile.md, "Many
// pairs".
#pragma once

#include "chasles/query/profile.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace chasles::query {

class LowerEnvelope {
public:
    LowerEnvelope();
    /// Of no distances.
    static const LowerEnvelope& none();

    /// Whether nothing was added.
    [[nodiscard]] bool is_empty() const { return steps_.size() == 1 && std::isinf(steps_.front().upper); }
    /// The greatest upper bound within a part of the time, or infinity: a distance that stays above it there adds
    /// nothing.
    [[nodiscard]] double greatest_upper(const Bracket& part) const;
    [[nodiscard]] double greatest_upper() const { return greatest_upper({0, 1}); }

    /// Adds a distance that is known within a part of the time; outside of it, it is no matter.
    void add(const DistanceProfile& distance, const Bracket& part, std::uint32_t name);
    /// Distances that are left may be as small as this.
    void leave(double lower);

    /// With the names of the distances that are least in `nearest`. Bounds are infinite where nothing was added.
    [[nodiscard]] DistanceProfile result() const;

private:
    struct Step {
        double begin = 0;
        double lower;
        double upper;
        std::uint32_t name = 0; ///< of the distance with the least upper bound

        void take(double other_lower, double other_upper, std::uint32_t other_name);
        [[nodiscard]] bool is_same(const Step& other) const {
            return lower == other.lower && upper == other.upper && name == other.name;
        }
    };

    static void append(std::vector<Step>& steps, const Step& step);
    [[nodiscard]] double end_of(std::size_t i) const { return i + 1 < steps_.size() ? steps_[i + 1].begin : 1; }
    [[nodiscard]] std::size_t step_at(double time) const;

    std::vector<Step> steps_; ///< from 0 to 1; at first one without a distance
    bool certain_ = true;
    Work work_;
};

/// The names that `nearest` counts, in the order of their first steps. Afterwards it counts these.
template <class Name>
std::vector<Name> used_names(std::vector<std::uint32_t>& nearest, const std::vector<Name>& names) {
    constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> places(names.size(), unused);
    std::vector<Name> used;
    if (names.empty())
        nearest.clear();
    for (std::uint32_t& index : nearest) {
        std::uint32_t& place = places[index];
        if (place == unused) {
            place = std::uint32_t(used.size());
            used.push_back(names[index]);
        }
        index = place;
    }
    return used;
}

} // namespace chasles::query
