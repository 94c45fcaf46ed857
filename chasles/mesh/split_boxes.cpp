// Centres are counted into bins along each axis; the best plane between two bins divides the boxes.
#include "chasles/mesh/split_boxes.h"

#include <algorithm>
#include <array>
#include <limits>

namespace chasles {
namespace {

constexpr int bin_count = 16;
constexpr float infinite = std::numeric_limits<float>::infinity();

struct Bin {
    PackedBox box = PackedBox::empty();
    std::size_t count = 0;

    void extend(const Bin& other) {
        box.extend(other.box);
        count += other.count;
    }
};

using AxisBins = std::array<Bin, bin_count>;

/// From centres to numbers of bins. Centres are doubled: the sum of both corners.
struct Binning {
    Eigen::Array4f origin;
    Eigen::Array4f scale;
    float unit; ///< areas are measured in it, so that they neither overflow nor vanish

    explicit Binning(std::span<const PackedBox> boxes) {
        PackedBox centres = PackedBox::empty();
        PackedBox bounds = PackedBox::empty();
        for (const PackedBox& box : boxes) {
            const Eigen::Array4f centre = box.lower + box.upper;
            centres.extend({centre, centre});
            bounds.extend(box);
        }
        origin = centres.lower;
        const Eigen::Array4f extent = centres.upper - centres.lower;
        // Less than the number of bins, so that the last centre falls into the last bin. One bin where it would
        // overflow.
        scale = (extent > 1e-36F).select(0.999F * bin_count / extent, 0.0F);
        unit = 1.0F / (bounds.upper - bounds.lower).maxCoeff();
    }

    [[nodiscard]] Eigen::Array4i bins_of(const PackedBox& box) const {
        return ((box.lower + box.upper - origin) * scale).cast<int>();
    }

    [[nodiscard]] float cost(const Bin& bin) const {
        const Eigen::Array4f size = (bin.box.upper - bin.box.lower) * unit;
        return (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]) * static_cast<float>(bin.count);
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

void improve(Division& best, const AxisBins& bins, int axis, const Binning& binning) {
    std::array<float, bin_count> cost_from{}; // of all bins from here on
    Bin last;
    for (int bin = bin_count - 1; bin > 0; --bin) {
        last.extend(bins[bin]);
        cost_from[bin] = last.count > 0 ? binning.cost(last) : infinite;
    }
    Bin first;
    for (int bin = 1; bin < bin_count; ++bin) {
        first.extend(bins[bin - 1]);
        const float cost = first.count > 0 ? binning.cost(first) + cost_from[bin] : infinite;
        if (cost < best.cost)
            best = {cost, axis, bin};
    }
}

/// Swaps from both ends, so that the order depends on nothing but the boxes.
template <typename ComesFirst> std::size_t partition(BoxGroup group, ComesFirst comes_first) {
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

} // namespace

PackedBox PackedBox::empty() { return {Eigen::Array4f::Constant(infinite), Eigen::Array4f::Constant(-infinite)}; }

std::size_t split_boxes(BoxGroup group) {
    const Binning binning(group.boxes);
    const std::array<AxisBins, 3> bins = fill_bins(binning, group.boxes);
    Division best;
    for (int axis = 0; axis < 3; ++axis)
        improve(best, bins[axis], axis, binning);
    if (best.cost == infinite)
        return group.size() / 2;
    return partition(group, [&](const PackedBox& box) { return binning.bins_of(box)[best.axis] < best.bin; });
}

} // namespace chasles
