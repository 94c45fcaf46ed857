#include "chasles/scene/curve_order.h"

#include "chasles/base/parallel_for.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace chasles::scene {

namespace {

using Eigen::Vector3d;
using Points = std::span<const Vector3d>;

/// The curve goes through 2^21 cells along each axis.
constexpr int bits_of_axis = 21;
/// So few points stay in any order.
constexpr std::size_t few = 32;
constexpr std::size_t bytes = 8;

struct Key {
    std::uint64_t code; ///< the place of a cell on the curve
    std::uint32_t index;
};
using Keys = std::span<Key>;

/// The bits of a cell's number, with two zeros between any two of them.
std::uint64_t spread(std::uint64_t cell) {
    cell = (cell | cell << 32) & 0x001f00000000ffff;
    cell = (cell | cell << 16) & 0x001f0000ff0000ff;
    cell = (cell | cell << 8) & 0x100f00f00f00f00f;
    cell = (cell | cell << 4) & 0x10c30c30c30c30c3;
    return (cell | cell << 2) & 0x1249249249249249;
}

/// The cells around the points of some keys.
class Grid {
public:
    /// Points at infinity do not count.
    Grid(Points points, std::span<const Key> keys) {
        Vector3d upper = -lower_;
        for (const Key& key : keys)
            if (const Vector3d& point = points[key.index]; std::isfinite(point.sum())) {
                lower_ = lower_.cwiseMin(point);
                upper = upper.cwiseMax(point);
            }
        cells_per_length_ = double(1U << bits_of_axis) / (upper - lower_).maxCoeff();
    }

    /// Whether there is more than one place. Otherwise all points are in one cell.
    [[nodiscard]] bool has_cells() const { return cells_per_length_ > 0 && std::isfinite(cells_per_length_); }
    [[nodiscard]] std::uint64_t code(const Vector3d& point) const {
        return spread(cell(point, 0)) | spread(cell(point, 1)) << 1 | spread(cell(point, 2)) << 2;
    }

private:
    [[nodiscard]] std::uint64_t cell(const Vector3d& point, Eigen::Index axis) const {
        constexpr double last = (1U << bits_of_axis) - 1;
        const double cell = (point[axis] - lower_[axis]) * cells_per_length_;
        return cell >= 0 ? std::uint64_t(std::min(cell, last)) : 0; // 0 also for what is not a number
    }

    Vector3d lower_ = Vector3d::Constant(INFINITY);
    double cells_per_length_;
};

/// Sorts by codes, byte by byte. Keys with one code stay in their order. `other` is as long as `keys`.
void sort_by_codes(Keys keys, Keys other) {
    std::array<std::array<std::uint32_t, 256>, bytes> counts{};
    const auto byte = [](const Key& key, std::size_t i) { return key.code >> (8 * i) & 0xff; };
    for (const Key& key : keys)
        for (std::size_t i = 0; i < bytes; ++i)
            ++counts[i][byte(key, i)];
    Keys from = keys, to = other;
    for (std::size_t i = 0; i < bytes; ++i) {
        if (counts[i][byte(keys.front(), i)] == keys.size())
            continue; // the same byte in all codes
        std::exclusive_scan(counts[i].begin(), counts[i].end(), counts[i].begin(), 0U);
        for (const Key& key : from)
            to[counts[i][byte(key, i)]++] = key;
        std::swap(from, to);
    }
    if (from.data() != keys.data())
        std::ranges::copy(from, keys.begin());
}

/// Sorts keys in cells of their own, and the keys of a full cell in smaller cells. A cell is smaller than the grid, so
/// this comes to an end.
void sort_along_curve(Points points, Keys keys, Keys other, unsigned threads) {
    const Grid grid(points, keys);
    if (!grid.has_cells())
        return;
    constexpr std::size_t chunk = 1024;
    parallel_chunks(threads, keys.size(), chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (Key& key : keys.subspan(begin, end - begin))
            key.code = grid.code(points[key.index]);
    });
    sort_by_codes(keys, other);
    for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
        while (end < keys.size() && keys[end].code == keys[begin].code)
            ++end;
        if (end - begin > few)
            sort_along_curve(points, keys.subspan(begin, end - begin), other.first(end - begin), 1);
    }
}

} // namespace

std::vector<std::uint32_t> curve_order(Points points, unsigned threads) {
    std::vector<Key> keys(2 * points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        keys[i].index = i;
    const Keys all(keys);
    if (points.size() > few)
        sort_along_curve(points, all.first(points.size()), all.last(points.size()), threads);
    std::vector<std::uint32_t> order;
    order.reserve(points.size());
    for (const Key& key : all.first(points.size()))
        order.push_back(key.index);
    return order;
}

} // namespace chasles::scene
