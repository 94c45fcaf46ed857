// Which links can ever touch? Proven over all configurations within the limits of the joints, instead of sampled.
// Source: docs/derivations/29-robots.md, "Pairs that never touch".
#pragma once

#include "chasles/robot/robot.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace chasles {

/// What is proven about two links.
enum class PairReason : std::uint8_t {
    never,     ///< they touch in no configuration
    always,    ///< they touch in every configuration
    adjacent,  ///< a link and the next one above it that has shapes, not tested; nothing is proven
    sometimes, ///< they touch in some configurations and in others not
    open,      ///< time was up, or a joint has no limits
};

/// Two links, and whether they can touch.
struct PairProof {
    std::string first;
    std::string second;
    PairReason reason = PairReason::open;
    /// The links overlap there, or touch. Joints that are not between them are neutral.
    std::optional<Configuration> witness = {};
    std::size_t cells = 0;    ///< boxes of configurations that were examined
    std::size_t tried = 0;    ///< single configurations
    std::size_t touching = 0; ///< of these: how many are not proven clear
    double seconds = 0;
};

struct PairProofOptions {
    double seconds = 600; ///< for all pairs; what is not decided then is open
    unsigned threads = 0; ///< at most so many; 0: all cores
    /// Called now and then with the number of pairs that are done, from any one thread at a time; where it returns
    /// false, the rest stays open.
    std::function<bool(std::size_t done, std::size_t pairs)> progress = {};
};

/// All pairs of links that have shapes, in the order of the description; whether they are tested makes no difference,
/// but for adjacent ones.
/// Only the joints between two links count. Which pairs stay open depends on the time; what is decided does not.
/// Throws InvalidInput for a time that is not positive.
CHASLES_EXPORT std::vector<PairProof> prove_pairs(const Robot& robot, const PairProofOptions& options = {});

} // namespace chasles
