// Numbers of which the small ones are asked for again and again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace chasles::search {

/// A list of numbers. A search for the small ones skips blocks by their least number.
class Limits {
public:
    struct Taken {
        std::size_t index;
        double limit;
    };

    [[nodiscard]] double operator[](std::size_t index) const { return limits_[index]; }
    void push_back(double limit) {
        if (limits_.size() % block == 0)
            least_.push_back(infinite);
        limits_.push_back(infinite);
        set(limits_.size() - 1, limit);
    }
    void set(std::size_t index, double limit) {
        limits_[index] = limit;
        least_[index / block] = std::min(least_[index / block], limit);
    }
    /// Leaves the greater one of both numbers. The block may be searched once more than it needs.
    void raise(std::size_t index, double limit) { limits_[index] = std::max(limits_[index], limit); }
    void clear() {
        limits_.clear();
        least_.clear();
    }

    /// Replaces the numbers that are not greater than the bound by infinity. Returns them until the next call, in
    /// ascending order of their indices.
    const std::vector<Taken>& take_up_to(double bound) {
        taken_.clear();
        for (std::size_t k = 0; k < least_.size(); ++k)
            if (!(least_[k] > bound))
                take_up_to(bound, k);
        return taken_;
    }

private:
    static constexpr std::size_t block = 64;
    static constexpr double infinite = std::numeric_limits<double>::infinity();

    void take_up_to(double bound, std::size_t of_block) {
        double least = infinite;
        const std::size_t end = std::min((of_block + 1) * block, limits_.size());
        for (std::size_t i = of_block * block; i < end; ++i) {
            if (limits_[i] > bound) {
                least = std::min(least, limits_[i]);
            } else {
                taken_.push_back({i, limits_[i]});
                limits_[i] = infinite;
            }
        }
        least_[of_block] = least;
    }

    std::vector<double> limits_;
    std::vector<double> least_; ///< of each block, or less
    std::vector<Taken> taken_;
};

} // namespace chasles::search
