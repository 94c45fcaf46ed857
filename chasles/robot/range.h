// The range of motion of a robot: which configurations of a box of joints are clear, in contact or open, proven.
// Source: docs/derivations/40-ranges.md.
#pragma once

#include "chasles/robot/robot.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace chasles {

/// All configurations between two: of each variable the values in [lower, upper], both ends included. Variables with
/// equal ends stand still; the others are the joints of the box.
struct ConfigurationBox {
    Configuration lower;
    Configuration upper;

    /// Whether a configuration is in the box.
    [[nodiscard]] bool contains(const Configuration& configuration) const {
        return (configuration.array() >= lower.array()).all() && (configuration.array() <= upper.array()).all();
    }
};

/// The box of these variables within their limits, around a configuration in which all others stay. A variable without
/// limits has one turn, if all joints that follow it are where they were after it. Throws InvalidInput for an unknown
/// name, one that comes twice, and a variable without limits that repeats nothing.
CHASLES_EXPORT ConfigurationBox box_of_joints(const Robot& robot, std::span<const std::string> joints,
                                              const Configuration& configuration);

struct RangeOptions {
    /// The search stops once a witness is known and no more than this share of the box is open; in [0, 1].
    double tolerance = 0.01;
    double seconds = 60;                ///< what is not decided then is open
    unsigned threads = 0;               ///< at most so many; 0: all cores
    std::size_t most_cells = 1'000'000; ///< so many boxes of configurations are examined; the rest is open
    /// Called now and then with the share of the box that is decided, from one thread at a time; where it returns
    /// false, the rest stays open.
    std::function<bool(double decided)> progress = {};
};

/// What is proven of all configurations of a box.
enum class RangeVerdict : std::uint8_t {
    open,    ///< neither is proven
    clear,   ///< the robot touches nothing in any configuration of the box
    contact, ///< it touches in some configuration, the witness
};

/// The range of motion in a box of configurations. The boxes of the three lists have no inner point in common, and make
/// up the whole box; the largest ones come first.
struct [[nodiscard]] RobotRange {
    RangeVerdict verdict = RangeVerdict::open;
    std::vector<std::size_t> joints;       ///< the variables of the box that do not stand still
    std::vector<ConfigurationBox> clear;   ///< proven: the robot touches nothing, and with a margin comes within none
    std::vector<ConfigurationBox> contact; ///< proven: something touches in each configuration, or is within its margin
    std::vector<ConfigurationBox> open;    ///< nothing is proven
    double clear_share = 0;                ///< of the box, as a part of its volume
    double contact_share = 0;
    double open_share = 1;
    std::optional<Configuration> witness;          ///< something touches there, or is within its margin
    std::optional<RobotPair> pair;                 ///< that does
    std::size_t cells = 0;                         ///< boxes of configurations that were examined
    std::shared_ptr<const UntestedPairs> untested; ///< of the checker: never null in an answer
};

/// A proven box around a configuration.
struct [[nodiscard]] ClearBox {
    /// `clear`: in each configuration of the box the robot is proven to touch nothing. `contact`: the configuration
    /// itself touches something. `open`: that is not decided.
    RangeVerdict verdict = RangeVerdict::open;
    /// Contains the configuration; the configuration alone if no larger box is proven.
    ConfigurationBox box;
    double share = 0;        ///< of the box that was given, as a part of its volume
    bool is_maximal = false; ///< whether no side could be moved outwards by the tolerance and be proven
    std::size_t cells = 0;   ///< boxes of configurations that were examined
    std::shared_ptr<const UntestedPairs> untested; ///< of the checker: never null in an answer
};

} // namespace chasles
