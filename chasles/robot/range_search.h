// What is proven of one box of configurations of a robot: a cell. At its middle, every pair has to be farther apart, or
// deeper in each other, than the joints of the cell may move it. Source: docs/derivations/40-ranges.md.
#pragma once

#include "chasles/robot/range.h"
#include "chasles/robot/range_pairs.h"
#include "chasles/robot/range_world.h"
#include "chasles/robot/segment_pairs.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace chasles::robot {

/// Ends of cells are whole numbers of this part of the box, so cells have exact shares of it.
inline constexpr int grid_bits = 40;
inline constexpr std::uint64_t grid_size = std::uint64_t{1} << grid_bits;

/// A part of a box of configurations, in parts of the grid along each axis.
struct RangeCell {
    struct Side {
        std::uint64_t lower = 0;
        std::uint64_t upper = grid_size;
        [[nodiscard]] std::uint64_t width() const { return upper - lower; }
    };
    std::vector<Side> sides;
    /// A pair that is not proven apart in the cell, by its index, and two faces that come near.
    struct NearPair {
        std::uint32_t index = 0;
        std::optional<NearFaces> faces = {};
    };
    std::shared_ptr<const std::vector<NearPair>> pairs;

    /// Of the whole box, as a part of its volume.
    [[nodiscard]] double share() const {
        double product = 1;
        for (const Side& side : sides)
            product *= double(side.width()) / double(grid_size);
        return product;
    }
};

/// Where something touches.
struct RangeWitness {
    Configuration configuration;
    RobotPair pair;
    bool overlaps = false; ///< proven by more than rounding
};

/// What is known of a single configuration.
struct RestAnswer {
    bool is_clear = true; ///< proven
    std::optional<RangeWitness> witness;
};

class RangeSearch {
public:
    /// The world is kept by reference. Throws InvalidInput for a box that is none.
    RangeSearch(const RangeWorld& world, const ConfigurationBox& box);

    /// The variables that do not stand still.
    [[nodiscard]] const std::vector<std::size_t>& axes() const { return axes_; }
    /// The whole box, with all pairs.
    [[nodiscard]] RangeCell whole() const;
    [[nodiscard]] ConfigurationBox box_of(const RangeCell& cell) const;

    /// What is proven of a cell.
    struct Outcome {
        bool is_clear = false;
        bool is_in_contact = false;
        std::vector<RangeCell> halves = {};       ///< otherwise; none if the cell cannot be divided
        std::optional<RangeWitness> witness = {}; ///< in the middle
    };
    /// `seeks_witness`: one is looked for in the middle, if the cell is not clear. Throws Cancelled.
    [[nodiscard]] Outcome examine(const RangeCell& cell, bool seeks_witness) const;
    /// Of all pairs. Throws Cancelled.
    [[nodiscard]] RestAnswer at(const Configuration& configuration) const;

private:
    using Pairs = std::vector<RangeCell::NearPair>;
    struct Middle;

    [[nodiscard]] double value(std::size_t axis, std::uint64_t place) const;
    [[nodiscard]] Middle middle_of(const RangeCell& cell) const;
    [[nodiscard]] PairAtRest at_middle(const RangePair& pair, const PairInCell& cell, const Middle& middle) const;
    [[nodiscard]] bool is_in_contact(const Middle& middle, std::optional<RangeWitness>& found) const;
    [[nodiscard]] RestAnswer at_rest(const Configuration& at, const Pairs& pairs) const;
    [[nodiscard]] std::vector<RangeCell> halves(const RangeCell& cell, const Middle& middle) const;
    [[nodiscard]] const OverlapSurface& moving_surface(const RangePair& pair) const;
    [[nodiscard]] const OverlapSurface& fixed_surface(const RangePair& pair) const;

    const RangeWorld& world_;
    const RobotChecker::Prepared& prepared_;
    ConfigurationBox box_;
    std::vector<std::size_t> axes_;
    std::vector<RangePair> pairs_;
};

} // namespace chasles::robot
