// Shares the time among all pairs of links. Source: docs/derivations/29-robots.md, "Pairs that never touch".
#include "chasles/robot/pair_proof.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/query/requirements.h"
#include "chasles/robot/pair_search.h"

#include <algorithm>
#include <chrono>

namespace chasles {

namespace {

using robot::PairSearch;
using robot::seconds_since;

/// A pair of links, and how to examine it; neighbours that the robot does not test are not examined.
struct Examined {
    PairProof proof;
    std::optional<PairSearch> search = {};
};

std::vector<Examined> pairs_of(const Robot& robot, const PairProofOptions& options) {
    const auto& links = robot.description().links;
    std::vector<Examined> pairs;
    for (std::size_t i = 0; i < links.size(); ++i)
        for (std::size_t j = i + 1; j < links.size(); ++j) {
            if (links[i].collisions.empty() || links[j].collisions.empty())
                continue;
            pairs.push_back({{links[i].name, links[j].name}});
            if (robot.model().neighbours.contains({i, j}) && !robot.is_tested(links[i].name, links[j].name))
                pairs.back().proof.reason = PairReason::adjacent;
            else
                pairs.back().search.emplace(robot, i, j, options);
        }
    return pairs;
}

/// The pairs that more time may decide. Pairs with few joints between them come first, and leave their time to the
/// others.
std::vector<std::size_t> in_order_of_effort(const std::vector<Examined>& pairs) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].search && pairs[i].proof.reason == PairReason::open && pairs[i].search->is_unfinished())
            order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return pairs[i].search->dimension(); });
    return order;
}

/// Each pair has an equal share of the time that is left. False if the user ends it.
bool examine_in_turn(std::vector<Examined>& pairs, const std::vector<std::size_t>& order,
                     const PairProofOptions& options, std::chrono::steady_clock::time_point start) {
    std::size_t done = pairs.size() - order.size();
    for (std::size_t k = 0; k < order.size(); ++k) {
        auto& [proof, search] = pairs[order[k]];
        const auto goes_on = [&] { return !options.progress || options.progress(done, pairs.size()); };
        if (!goes_on() || is_cancelled())
            return false;
        const double left = options.seconds - seconds_since(start);
        search->run(proof, std::max(0.0, left / double(order.size() - k)), goes_on);
        done += proof.reason != PairReason::open || !search->is_unfinished() ? 1 : 0;
    }
    return true;
}

} // namespace

std::vector<PairProof> prove_pairs(const Robot& robot, const PairProofOptions& options) {
    query::require(options.seconds > 0, "seconds", "must be positive");
    const auto start = std::chrono::steady_clock::now();
    std::vector<Examined> pairs = pairs_of(robot, options);
    // Pairs that their share of the time left open share what the others have not used.
    for (std::vector<std::size_t> order = in_order_of_effort(pairs); !order.empty(); order = in_order_of_effort(pairs))
        if (!examine_in_turn(pairs, order, options, start) || seconds_since(start) >= options.seconds)
            break;
    if (options.progress)
        options.progress(pairs.size(), pairs.size());
    std::vector<PairProof> proofs;
    proofs.reserve(pairs.size());
    for (Examined& pair : pairs)
        proofs.push_back(std::move(pair.proof));
    return proofs;
}

} // namespace chasles
