// Times of calls: the machine is noisy, so each is the least of several, and cases are summed up by their median.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace chasles::bench {

/// The least time of a call, in microseconds.
template <class Work>
double least_microseconds(int calls, const Work& work) {
    double least = 1e300;
    for (int call = 0; call < calls; ++call) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
        least = std::min(least, taken.count());
    }
    return least;
}

/// The number that this share of all numbers does not exceed; 0 for no numbers.
inline double quantile(std::vector<double> numbers, double share) {
    if (numbers.empty())
        return 0;
    std::ranges::sort(numbers);
    return numbers[std::size_t(share * double(numbers.size() - 1))];
}

/// 0 for no numbers.
inline double median(std::vector<double> numbers) {
    if (numbers.empty())
        return 0;
    std::ranges::nth_element(numbers, numbers.begin() + std::ptrdiff_t(numbers.size() / 2));
    return numbers[numbers.size() / 2];
}

} // namespace chasles::bench
