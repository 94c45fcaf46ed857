// Pairs that an answer about many bodies says nothing about, and why.
// Decision: docs/decisions/0092-untested-pairs.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace chasles {

/// Why a pair is not tested. Where several reasons hold, the first one of this list counts for a robot.
enum class UntestedReason : std::uint8_t {
    no_shapes,         ///< one of them has no surface
    at_rest,           ///< they do not move against each other
    adjacent,          ///< a link of a robot, and the next one above it that has shapes
    disabled,          ///< by the description of a robot, as an SRDF file does
    ignored,           ///< by the caller
    touching_at_start, ///< by Scene::ignore_touching_at_start
};

struct UntestedPair {
    std::string first;
    std::string second;
    UntestedReason reason = UntestedReason::ignored;
    bool is_with_scene = false; ///< a link or part of a robot, and a body of the scene
};

/// Each pair of bodies, links and parts is either tested or counted here once.
struct UntestedPairs {
    static constexpr std::size_t reasons = 6;
    static constexpr std::size_t most_named = 100;

    std::size_t tested = 0;                    ///< the number of all other pairs
    std::array<std::size_t, reasons> counts{}; ///< by reason
    std::vector<UntestedPair> named;           ///< in the order of reasons and names; of each reason at most 100
    std::vector<std::string> without_shapes;   ///< links: their pairs are not among `named`

    [[nodiscard]] std::size_t count(UntestedReason reason) const { return counts[std::size_t(reason)]; }
    [[nodiscard]] std::size_t total() const { return std::accumulate(counts.begin(), counts.end(), std::size_t{0}); }
    /// Counts a pair, and names it if there is room.
    void add(std::string_view first, std::string_view second, UntestedReason reason, bool is_with_scene = false) {
        if (++counts[std::size_t(reason)] <= most_named)
            named.push_back({std::string(first), std::string(second), reason, is_with_scene});
    }
};

} // namespace chasles
