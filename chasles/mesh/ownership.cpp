// The faces take turns and claim one free feature in each round. A face without a free feature leaves the rounds.
// The number of claimants therefore falls quickly.
#include "chasles/mesh/ownership.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace chasles {
namespace {

/// Marks a free feature, and one that is left out.
constexpr std::uint32_t no_owner = 0xffffffff;
constexpr std::uint32_t left_out = 0xfffffffe;

/// A face that still claims features.
struct Claimant {
    std::uint32_t face;
    std::uint32_t next; ///< position of the first of its features that is not tested yet
};

/// Gives the claimant its next free feature. Returns false if no feature is free.
bool claim_one(Claimant& claimant, std::uint32_t end, std::span<const std::uint32_t> features,
               std::vector<std::uint32_t>& owner) {
    while (claimant.next < end) {
        const std::uint32_t feature = features[claimant.next++];
        if (feature == no_feature || owner[feature] != no_owner)
            continue;
        owner[feature] = claimant.face;
        return true;
    }
    return false;
}

/// The features of each owner in ascending order, by a counting sort.
FlatLists<std::uint32_t> lists_by_owner(const std::vector<std::uint32_t>& owner, std::size_t face_count) {
    FlatLists<std::uint32_t> lists;
    lists.offsets.assign(face_count + 1, 0);
    for (const std::uint32_t face : owner)
        if (face < left_out)
            ++lists.offsets[face + 1];
    std::partial_sum(lists.offsets.begin(), lists.offsets.end(), lists.offsets.begin());
    lists.items.resize(lists.offsets.back());
    std::vector<std::uint32_t> next(lists.offsets.begin(), lists.offsets.end() - 1);
    for (std::uint32_t feature = 0; feature < owner.size(); ++feature)
        if (owner[feature] < left_out)
            lists.items[next[owner[feature]]++] = feature;
    return lists;
}

} // namespace

FlatLists<std::uint32_t> share_features(std::span<const std::uint32_t> offsets, std::span<const std::uint32_t> features,
                                        const std::vector<char>& is_left_out) {
    const std::size_t face_count = offsets.size() - 1;
    std::vector<std::uint32_t> owner(is_left_out.size());
    std::ranges::transform(is_left_out, owner.begin(), [](char is_out) { return is_out != 0 ? left_out : no_owner; });
    std::vector<Claimant> claimants(face_count);
    for (std::uint32_t face = 0; face < face_count; ++face)
        claimants[face] = {face, offsets[face]};
    while (!claimants.empty()) {
        std::size_t staying = 0;
        for (Claimant claimant : claimants)
            if (claim_one(claimant, offsets[claimant.face + 1], features, owner))
                claimants[staying++] = claimant;
        claimants.resize(staying);
    }
    return lists_by_owner(owner, face_count);
}

} // namespace chasles
