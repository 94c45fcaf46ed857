// Sorting with the same result everywhere. In WebAssembly by heaps: std::sort adds 5 to 15 kB to the module for each
// type.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

namespace chasles {

/// As std::ranges::sort. Algorithms place elements that count as equal differently, so where the order matters only
/// equal ones may count as equal.
template <class Range, class Less = std::ranges::less, class Projection = std::identity>
void sort(Range&& range, Less less = {}, Projection projection = {}) {
#if defined(__wasm__)
    std::ranges::make_heap(range, std::ref(less), std::ref(projection));
    std::ranges::sort_heap(range, std::ref(less), std::ref(projection));
#else
    std::ranges::sort(range, less, projection);
#endif
}

/// Sorts, and leaves one of equal elements.
template <class Element>
void sort_unique(std::vector<Element>& elements) {
    chasles::sort(elements);
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
}

} // namespace chasles
