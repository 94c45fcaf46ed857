// Sets of pairs of bodies that touch, to count missed contacts and false alarms.
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

namespace chasles::bench {

/// The smaller index first.
using PairSet = std::set<std::pair<std::size_t, std::size_t>>;

/// How many pairs of the first set are not in the second one.
inline std::size_t count_missing(const PairSet& pairs, const PairSet& in) {
    return std::size_t(std::ranges::count_if(pairs, [&](const auto& pair) { return !in.contains(pair); }));
}

} // namespace chasles::bench
