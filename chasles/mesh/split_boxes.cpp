// Centres are counted into bins along each axis; the best plane between two bins divides the boxes.
#include "chasles/mesh/split_boxes.h"

#include <algorithm>
#include <array>
#include <limits>

namespace chasles {
namespace {

constexpr int most_bins = 16;
constexpr std::size_t few = 12;
constexpr float infinite = std::numeric_limits<float>::infinity();

struct Bin {
    PackedBox box = PackedBox::empty();
    std::size_t count = 0;

    void extend(const Bin& other) {
        box.extend(other.box);
        count += other.count;
    }
};

using AxisBins = std::array<Bin, most_bins>;

/// Doubled: the sum of both corners.
Eigen::Array4f centre_of(const PackedBox& box) {
    return box.lower + box.upper;
}

/// Areas are measured in the size of the whole, so that they neither overflow nor vanish.
float cost(const PackedBox& box, std::size_t count, float unit) {
    const Eigen::Array4f size = (box.upper - box.lower) * unit;
    return (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]) * static_cast<float>(count);
}

/// From centres to numbers of bins.
struct Binning {
    Eigen::Array4f origin;
    Eigen::Array4f scale;
    int count; ///< few boxes need few bins

    Binning(const PackedBox& centres, std::size_t boxes) : origin(centres.lower), count(boxes < 100 ? 8 : most_bins) {
        const Eigen::Array4f extent = centres.upper - centres.lower;
        // Less than the number of bins, so that the last centre falls into the last bin. One bin where it would
        // overflow.
        scale = (extent > 1e-36F).select(0.999F * static_cast<float>(count) / extent, 0.0F);
    }

    [[nodiscard]] Eigen::Array4i bins_of(const PackedBox& box) const {
        return ((centre_of(box) - origin) * scale).cast<int>();
    }

    /// The same along one axis, to the last bit.
    [[nodiscard]] int bin_of(const PackedBox& box, int axis) const {
        return static_cast<int>((box.lower[axis] + box.upper[axis] - origin[axis]) * scale[axis]);
    }
};

std::array<AxisBins, 3> fill_bins(const Binning& binning, std::span<const PackedBox> boxes) {
    std::array<AxisBins, 3> bins;
    for (const PackedBox& box : boxes) {
        const Eigen::Array4i place = binning.bins_of(box);
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins[axis][place[axis]];
            bin.box.extend(box);
            ++bin.count;
        }
    }
    return bins;
}

/// Boxes in bins below `bin` along `axis` come first.
struct Division {
    float cost = infinite;
    int axis = 0;
    int bin = 0;
};

void improve(Division& best, std::span<const Bin> bins, int axis, float unit) {
    const int bin_count = static_cast<int>(bins.size());
    std::array<float, most_bins> cost_from{}; // of all bins from here on
    Bin last;
    for (int bin = bin_count - 1; bin > 0; --bin) {
        last.extend(bins[bin]);
        cost_from[bin] = last.count > 0 ? cost(last.box, last.count, unit) : infinite;
    }
    Bin first;
    for (int bin = 1; bin < bin_count; ++bin) {
        first.extend(bins[bin - 1]);
        const float total = first.count > 0 ? cost(first.box, first.count, unit) + cost_from[bin] : infinite;
        if (total < best.cost)
            best = {total, axis, bin};
    }
}

/// Swaps from both ends, so that the order depends on nothing but the boxes.
template <typename ComesFirst>
std::size_t partition(BoxGroup group, ComesFirst comes_first) {
    std::size_t begin = 0;
    std::size_t end = group.size();
    while (true) {
        while (begin < end && comes_first(group.boxes[begin]))
            ++begin;
        while (begin < end && !comes_first(group.boxes[end - 1]))
            --end;
        if (begin == end)
            return begin;
        std::swap(group.boxes[begin], group.boxes[end - 1]);
        std::swap(group.faces[begin], group.faces[end - 1]);
    }
}

std::size_t split_many(BoxGroup group, const GroupBounds& bounds) {
    const Binning binning(bounds.centres, group.size());
    const std::array<AxisBins, 3> bins = fill_bins(binning, group.boxes);
    Division best;
    for (int axis = 0; axis < 3; ++axis)
        improve(best, std::span(bins[axis]).first(static_cast<std::size_t>(binning.count)), axis, bounds.unit());
    if (best.cost == infinite)
        return group.size() / 2;
    return partition(group, [&](const PackedBox& box) { return binning.bin_of(box, best.axis) < best.bin; });
}

void sort_by_centre(BoxGroup group, Eigen::Index axis) {
    for (std::size_t i = 1; i < group.size(); ++i)
        for (std::size_t j = i; j > 0 && centre_of(group.boxes[j])[axis] < centre_of(group.boxes[j - 1])[axis]; --j) {
            std::swap(group.boxes[j], group.boxes[j - 1]);
            std::swap(group.faces[j], group.faces[j - 1]);
        }
}

/// Tries every place along the axis on which the centres spread most; bins would cost more than the boxes.
std::size_t split_few(BoxGroup group, const GroupBounds& bounds) {
    Eigen::Index axis = 0;
    (bounds.centres.upper - bounds.centres.lower).head<3>().maxCoeff(&axis);
    sort_by_centre(group, axis);
    const float unit = bounds.unit();
    std::array<float, few> cost_from{};
    PackedBox last = PackedBox::empty();
    for (std::size_t i = group.size() - 1; i > 0; --i) {
        last.extend(group.boxes[i]);
        cost_from[i] = cost(last, group.size() - i, unit);
    }
    std::size_t best = group.size() / 2;
    float best_cost = infinite;
    PackedBox first = PackedBox::empty();
    for (std::size_t i = 1; i < group.size(); ++i) {
        first.extend(group.boxes[i - 1]);
        const float total = cost(first, i, unit) + cost_from[i];
        if (total < best_cost) {
            best_cost = total;
            best = i;
        }
    }
    return best;
}

} // namespace

GroupBounds::GroupBounds(std::span<const PackedBox> group) {
    for (const PackedBox& box : group) {
        const Eigen::Array4f centre = centre_of(box);
        centres.extend({centre, centre});
        boxes.extend(box);
    }
}

float GroupBounds::unit() const {
    return 1.0F / (boxes.upper - boxes.lower).maxCoeff();
}

std::size_t split_boxes(BoxGroup group, const GroupBounds& bounds) {
    return group.size() <= few ? split_few(group, bounds) : split_many(group, bounds);
}

} // namespace chasles
