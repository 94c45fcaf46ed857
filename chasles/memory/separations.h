// Parts of the moving body that are apart from parts of the fixed body, each along a direction of its own, kept while
// the body moves on. Most of them are told to stay apart on a way by how their box moves along their direction. Source:
// docs/derivations/31-neighbour-lists.md, "Limits" and "By how a part moves".
#pragma once

#include "chasles/algebra/vector.h"
#include "chasles/hierarchy/bvh.h"
#include "chasles/memory/way.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace chasles::memory {

/// Places for pairs of parts, in blocks of four. Moving parts are known by their boxes; of fixed parts, nothing is
/// known but the gaps to them. The body is kept by reference.
class Separations {
public:
    static constexpr std::size_t block_size = 4;

    explicit Separations(const Body& moving) : moving_(moving) {}

    void clear();
    /// Appends four empty places.
    void append_block();

    /// Fills a place with a pair whose moving part is that of a node. The pair is not known to be apart.
    void put(std::size_t index, const BvhNode& moving);
    /// The pair is apart by the gap, or more, at the start of the present way, along a vector of the fixed body's frame
    /// that is no longer than 1.
    void put_apart(std::size_t index, const algebra::Vector3<float>& along, double gap);
    /// Empties the place.
    void remove(std::size_t index);
    [[nodiscard]] bool holds(std::size_t index) const;

    /// The body has come to the start of a way.
    void arrive(const Arrival& arrival);
    /// The pairs that may be `Way::least_gap()` apart, or less, on the way that begins here; ascending, and valid until
    /// the next call. Each one is to be put apart or removed. Pairs with limits above the bound are known to be farther
    /// apart: it is at least the sum of the margin, the travel of the way, and what is travelled `with_rounding`.
    const std::vector<std::size_t>& due(const Way& way, double bound);

private:
    using Four = std::array<float, block_size>;

    /// Directions and boxes: x, y and z of four pairs.
    struct Block {
        std::array<Four, 3> along{};
        std::array<Four, 3> lower{};
        std::array<Four, 3> upper{};
    };
    /// How far parts move along their directions on the present way, or farther.
    struct Gains {
        Four lanes{};
        bool are_found = false;
        bool are_listed = false; ///< in moved_
    };
    /// How points move from the start of the way to its end, about the centre of the hierarchy: y -> turn y + shift.
    /// Each number in all lanes.
    struct Displacement {
        std::array<std::array<Four, 3>, 3> turn{};
        std::array<Four, 3> shift{};
        Four error{};
    };

    void set_limit(std::size_t index, double limit);
    void list(std::size_t place);
    void find_reached(double bound);
    void add_due(std::size_t place, double bound, double needed);
    void set_displacement(const Way& way);
    void find_gains(std::size_t place);

    const Body& moving_;
    std::vector<Block> blocks_;
    std::vector<Gains> gains_; ///< of each block
    std::vector<double>
        limits_; ///< pairs are apart by at least the limit less what is travelled; infinite: empty places
    std::vector<double> least_;          ///< of each group of limits, or less
    double travelled_ = 0;               ///< up to the start of the present way
    bool moves_ = false;                 ///< on the present way
    Displacement displacement_;          ///< likewise
    std::vector<std::uint32_t> moved_;   ///< blocks of which the present way tells more on arrival
    std::vector<std::uint32_t> reached_; ///< blocks with limits up to the bound
    std::vector<std::size_t> due_;
};

} // namespace chasles::memory
