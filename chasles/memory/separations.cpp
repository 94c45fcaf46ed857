#include "chasles/memory/separations.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi" // on passing vectors: all functions with vector arguments are inlined here
#endif

namespace chasles::memory {

namespace {

using algebra::Vector3;

constexpr double nowhere = std::numeric_limits<double>::infinity();
/// Places that are skipped together. Measured with drag_bench.
constexpr std::size_t blocks_of_group = 16;
constexpr std::size_t group_size = blocks_of_group * Separations::block_size;

/// What rounding may add to a gain: a share of the lengths in it, and what flushed floats lose (note 31, "Rounding").
constexpr double rounding_of_gains = 0x1p-19;
constexpr double flushed = 0x1p-110;

/// A float for each pair of a block.
typedef float Floats __attribute__((vector_size(16))); // NOLINT(modernize-use-using)

Floats loaded(const std::array<float, 4>& lanes) {
    Floats floats;
    std::memcpy(&floats, lanes.data(), sizeof floats);
    return floats;
}

Floats least_of(Floats a, Floats b) {
    return a < b ? a : b;
}

double least_of_four(const double* numbers) {
    return std::min(std::min(numbers[0], numbers[2]), std::min(numbers[1], numbers[3]));
}

std::array<float, 4> in_all_lanes(double value) {
    const auto rounded = float(value);
    return {rounded, rounded, rounded, rounded};
}

} // namespace

void Separations::clear() {
    blocks_.clear();
    gains_.clear();
    limits_.clear();
    least_.clear();
    reached_.clear();
    moved_.clear();
    moves_ = false;
    due_.clear();
    travelled_ = 0;
}

void Separations::append_block() {
    if (limits_.size() % group_size == 0)
        least_.push_back(nowhere);
    blocks_.emplace_back();
    gains_.emplace_back();
    limits_.resize(limits_.size() + block_size, nowhere);
}

void Separations::put(std::size_t index, const BvhNode& moving) {
    const std::size_t lane = index % block_size;
    Block& block = blocks_[index / block_size];
    for (std::size_t i = 0; i < 3; ++i) {
        block.along[i][lane] = 0;
        block.lower[i][lane] = moving.lower[i];
        block.upper[i][lane] = moving.upper[i];
    }
    set_limit(index, -nowhere);
}

void Separations::set_limit(std::size_t index, double limit) {
    limits_[index] = limit;
    least_[index / group_size] = std::min(least_[index / group_size], limit);
}

void Separations::put_apart(std::size_t index, const Vector3<float>& along, double gap) {
    const std::size_t place = index / block_size;
    for (int i = 0; i < 3; ++i)
        blocks_[place].along[std::size_t(i)][index % block_size] = along[i];
    set_limit(index, gap + travelled_);
    if (moves_)
        list(place);
    gains_[place].are_found = false;
}

void Separations::remove(std::size_t index) {
    limits_[index] = nowhere;
}

bool Separations::holds(std::size_t index) const {
    return limits_[index] < nowhere;
}

void Separations::list(std::size_t place) {
    if (!gains_[place].are_listed)
        moved_.push_back(std::uint32_t(place));
    gains_[place].are_listed = true;
}

/// On chords, a gap is linear.
void Separations::arrive(const Arrival& arrival) {
    const double before = with_rounding(travelled_) + arrival.beside;
    for (const std::uint32_t place : moved_) {
        if (!gains_[place].are_found)
            find_gains(place);
        gains_[place].are_listed = false;
        double* const limits = &limits_[place * block_size];
        for (std::size_t lane = 0; lane < block_size; ++lane) {
            const double gap = limits[lane] - before + arrival.share * double(gains_[place].lanes[lane]);
            limits[lane] = std::max(limits[lane], gap + arrival.travelled);
        }
    }
    moved_.clear();
    travelled_ = arrival.travelled;
}

const std::vector<std::size_t>& Separations::due(const Way& way, double bound) {
    due_.clear();
    find_reached(bound);
    moves_ = !way.rests();
    if (moves_)
        set_displacement(way);
    const double needed = with_rounding(travelled_) + way.least_gap();
    for (const std::uint32_t place : reached_) {
        if (moves_) {
            list(place);
            find_gains(place);
        }
        add_due(place, bound, needed);
    }
    return due_;
}

/// Without branches: which limits are reached cannot be foretold.
void Separations::find_reached(double bound) {
    reached_.resize(blocks_.size());
    std::size_t count = 0;
    for (std::size_t group = 0; group < least_.size(); ++group) {
        if (least_[group] > bound)
            continue;
        double least = nowhere;
        const std::size_t end = std::min((group + 1) * blocks_of_group, blocks_.size());
        for (std::size_t place = group * blocks_of_group; place < end; ++place) {
            const double least_of_block = least_of_four(&limits_[place * block_size]);
            least = std::min(least, least_of_block);
            reached_[count] = std::uint32_t(place);
            count += least_of_block <= bound ? 1 : 0;
        }
        least_[group] = least;
    }
    reached_.resize(count);
}

void Separations::add_due(std::size_t place, double bound, double needed) {
    const double* const limits = &limits_[place * block_size];
    std::array<double, block_size> ends;
    for (std::size_t lane = 0; lane < block_size; ++lane)
        ends[lane] = moves_ ? limits[lane] + double(gains_[place].lanes[lane]) : limits[lane];
    if (std::min(least_of_four(limits), least_of_four(ends.data())) > needed)
        return;
    for (std::size_t lane = 0; lane < block_size; ++lane)
        if (limits[lane] <= bound && !(std::min(limits[lane], ends[lane]) > needed))
            due_.push_back(place * block_size + lane);
}

void Separations::set_displacement(const Way& way) {
    const auto& [start, end] = way.ends;
    const Vector3<double> centre = motion::vector_in<double>(moving_.bvh().centre());
    const Vector3<double> shift = end(centre) - start(centre);
    for (int i = 0; i < 3; ++i) {
        displacement_.shift[std::size_t(i)] = in_all_lanes(shift[i]);
        for (int j = 0; j < 3; ++j)
            displacement_.turn[std::size_t(i)][std::size_t(j)] =
                in_all_lanes(end.rotation.row[i][j] - start.rotation.row[i][j]);
    }
    const double size = length(shift) + 2 * std::sqrt(motion::squared_turn(start, end)) * moving_.bvh().radius();
    displacement_.error = in_all_lanes(rounding_of_gains * size + flushed);
}

/// The least of n . (V y + w) over each box.
void Separations::find_gains(std::size_t place) {
    const Block& block = blocks_[place];
    const auto along = [&, x = loaded(block.along[0]), y = loaded(block.along[1]),
                        z = loaded(block.along[2])](const Four& of_x, const Four& of_y, const Four& of_z) {
        return x * loaded(of_x) + y * loaded(of_y) + z * loaded(of_z);
    };
    const auto& [turn, shift, error] = displacement_;
    Floats gain = along(shift[0], shift[1], shift[2]) - loaded(error);
    for (std::size_t j = 0; j < 3; ++j) {
        const Floats rate = along(turn[0][j], turn[1][j], turn[2][j]);
        gain += least_of(rate * loaded(block.lower[j]), rate * loaded(block.upper[j]));
    }
    std::memcpy(gains_[place].lanes.data(), &gain, sizeof gain);
    gains_[place].are_found = true;
}

} // namespace chasles::memory
