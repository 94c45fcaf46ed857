// Sorts box centres into bins along each axis and divides the boxes by the best plane between two bins.
// Small groups are sorted along one axis instead, and every division is tried.
#include "chasles/hierarchy/split_boxes.h"

#include <algorithm>

namespace chasles {
namespace {

constexpr std::size_t few = 12;   ///< up to this many boxes, every division along one axis is tried
constexpr std::size_t many = 100; ///< from this many boxes on, 16 bins are used instead of 8
constexpr float infinite = std::numeric_limits<float>::infinity();

/// The expected cost of testing boxes: half the surface area of their bounding box times their number. Areas are
/// relative to the size of the whole; they neither overflow nor vanish.
class Cost {
public:
    explicit Cost(const PackedBox& whole) : unit_(1.0F / (whole.upper - whole.lower).head<3>().maxCoeff()) {}

    float operator()(const PackedBox& box, std::size_t count) const {
        const Eigen::Array4f size = (box.upper - box.lower) * unit_;
        return (size[0] * (size[1] + size[2]) + size[1] * size[2]) * static_cast<float>(count);
    }

private:
    float unit_;
};

/// The bins along one axis: the bounding box of the boxes in each bin, and their number.
template <std::size_t bin_count>
struct Bins {
    std::array<PackedBox, bin_count> boxes;
    std::array<std::uint32_t, bin_count> counts{};

    Bins() { boxes.fill(PackedBox::empty()); }
};

/// The map from doubled box centres to bins.
struct Binning {
    Eigen::Array4f origin;
    Eigen::Array4f scale;

    Binning(const PackedBox& centres, std::size_t bin_count) : origin(centres.lower) {
        const Eigen::Array4f extent = centres.upper - centres.lower;
        // The factor is below the number of bins: the last centre is in the last bin. All centres are in one bin if the
        // quotient would overflow.
        scale = (extent > 1e-36F).select(0.999F * static_cast<float>(bin_count) / extent, 0.0F);
    }

    /// The bins of a box along all axes.
    [[nodiscard]] Eigen::Array4i bins_of(const PackedBox& box) const {
        return ((box.lower + box.upper - origin) * scale).cast<int>();
    }

    /// The plane at the lower end of a bin.
    [[nodiscard]] Plane plane_before(std::size_t bin, int axis) const {
        return {axis, origin[axis] + static_cast<float>(bin) / scale[axis]};
    }
};

/// Counts the boxes and encloses them in each bin along all three axes.
template <std::size_t bin_count>
std::array<Bins<bin_count>, 3> fill_bins(const Binning& binning, std::span<const PackedBox> boxes) {
    std::array<Bins<bin_count>, 3> bins;
    for (const PackedBox& box : boxes) {
        const Eigen::Array4i place = binning.bins_of(box);
        for (int axis = 0; axis < 3; ++axis) {
            bins[axis].boxes[place[axis]].extend(box);
            ++bins[axis].counts[place[axis]];
        }
    }
    return bins;
}

/// A division: boxes in bins before `bin` along `axis` come first.
struct Choice {
    float cost = infinite;
    int axis = 0;
    std::size_t bin = 0;
};

/// Replaces the best choice if a division along this axis costs less.
template <std::size_t bin_count>
void improve(Choice& best, const Bins<bin_count>& bins, int axis, const Cost& cost) {
    std::array<float, bin_count> cost_from{}; // the cost of all bins from this bin on
    PackedBox box = PackedBox::empty();
    std::uint32_t count = 0;
    for (std::size_t bin = bin_count - 1; bin > 0; --bin) {
        box.extend(bins.boxes[bin]);
        count += bins.counts[bin];
        cost_from[bin] = count > 0 ? cost(box, count) : infinite;
    }
    box = PackedBox::empty();
    count = 0;
    for (std::size_t bin = 1; bin < bin_count; ++bin) {
        box.extend(bins.boxes[bin - 1]);
        count += bins.counts[bin - 1];
        const float total = count > 0 ? cost(box, count) + cost_from[bin] : infinite;
        if (total < best.cost)
            best = {total, axis, bin};
    }
}

/// The best plane between bins of any axis. Empty if all centres are in one bin along each axis.
template <std::size_t bin_count>
std::optional<Plane> best_plane_of(std::span<const PackedBox> group, const GroupBounds& bounds) {
    const Binning binning(bounds.centres, bin_count);
    const std::array<Bins<bin_count>, 3> bins = fill_bins<bin_count>(binning, group);
    const Cost cost(bounds.boxes);
    Choice best;
    for (int axis = 0; axis < 3; ++axis)
        improve(best, bins[axis], axis, cost);
    if (best.cost == infinite)
        return std::nullopt;
    return binning.plane_before(best.bin, best.axis);
}

/// Sorts by insertion.
void sort_by_centre(std::span<PackedBox> group, Eigen::Index axis) {
    for (std::size_t i = 1; i < group.size(); ++i) {
        const PackedBox moved = group[i];
        const float centre = moved.lower[axis] + moved.upper[axis];
        std::size_t place = i;
        for (; place > 0 && centre < group[place - 1].lower[axis] + group[place - 1].upper[axis]; --place)
            group[place] = group[place - 1];
        group[place] = moved;
    }
}

/// The division after the first `first` boxes.
Division divide_at(std::size_t first, std::span<const PackedBox> group) {
    return {first, {GroupBounds(group.first(first)), GroupBounds(group.subspan(first))}};
}

/// Tries every division along the axis with the greatest extent of the centres. Bins would cost more time.
Division divide_few(std::span<PackedBox> group, const GroupBounds& bounds) {
    if (group.size() == 2)
        return divide_at(1, group);
    Eigen::Index axis = 0;
    (bounds.centres.upper - bounds.centres.lower).head<3>().maxCoeff(&axis);
    sort_by_centre(group, axis);
    const Cost cost(bounds.boxes);
    // From the back: the cost of all boxes from each place on.
    std::array<float, few> cost_from{};
    PackedBox last = PackedBox::empty();
    for (std::size_t i = group.size() - 1; i > 0; --i) {
        last.extend(group[i]);
        cost_from[i] = cost(last, group.size() - i);
    }
    // From the front: the cost of the boxes before each place. Infinite costs leave the division in the middle.
    std::size_t best = group.size() / 2;
    float best_cost = infinite;
    PackedBox first = PackedBox::empty();
    for (std::size_t i = 1; i < group.size(); ++i) {
        first.extend(group[i - 1]);
        const float total = cost(first, i) + cost_from[i];
        if (total < best_cost) {
            best_cost = total;
            best = i;
        }
    }
    return divide_at(best, group);
}

} // namespace

std::optional<Plane> best_plane(std::span<const PackedBox> group, const GroupBounds& bounds) {
    return group.size() < many ? best_plane_of<8>(group, bounds) : best_plane_of<16>(group, bounds);
}

Division divide_by(const Plane& plane, std::span<PackedBox> group) {
    Division division{0, {}};
    std::size_t first = 0;
    for (PackedBox& box : group) { // swaps without a branch, which the processor could not predict
        const PackedBox moved = box;
        const std::size_t part = plane.puts_first(moved) ? 0 : 1;
        box = group[first];
        group[first] = moved;
        first += 1 - part;
        division.bounds[part].extend(moved);
    }
    division.first = first;
    return division;
}

Division halve(std::span<const PackedBox> group) {
    return divide_at(group.size() / 2, group);
}

Division divide(std::span<PackedBox> group, const GroupBounds& bounds) {
    if (group.size() <= few)
        return divide_few(group, bounds);
    const std::optional<Plane> plane = best_plane(group, bounds);
    if (!plane)
        return halve(group);
    // The plane is rounded: boxes next to it may change sides, and one part may become empty.
    const Division division = divide_by(*plane, group);
    return division.first == 0 || division.first == group.size() ? halve(group) : division;
}

} // namespace chasles
