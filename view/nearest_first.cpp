#include "view/nearest_first.h"

#include "chasles/base/number_text.h"

#include <algorithm>
#include <tuple>

namespace chasles::view {

std::vector<const PairDistance*> nearest_first(const DistanceMatrix& matrix) {
    std::vector<const PairDistance*> pairs;
    for (const PairDistance& pair : matrix.pairs)
        pairs.push_back(&pair);
    std::ranges::stable_sort(pairs, {}, [](const PairDistance* pair) {
        const LeastDistance& nearest = pair->nearest;
        const bool touches = nearest.distance.upper == 0;
        return std::tuple(!touches, touches ? nearest.time.lower : nearest.distance.lower, nearest.distance.upper);
    });
    pairs.resize(std::min(pairs.size(), most_pairs_in_text));
    return pairs;
}

std::string distance_text(const LeastDistance& nearest) {
    const auto& [lower, upper] = nearest.distance;
    return nearest.certain ? number_text(lower, 9) : number_text(lower, 6) + " to " + number_text(upper, 6);
}

} // namespace chasles::view
