// Sorting of ranges whose order is total. In WebAssembly by heaps: std::sort adds 5 to 15 kB to the module for each
// type.
#pragma once

#include <algorithm>
#include <functional>

namespace chasles {

/// As std::ranges::sort. No two elements may count as equal, unless they are: then all algorithms give the same order.
template <class Range, class Less = std::ranges::less, class Projection = std::identity>
void sort(Range&& range, Less less = {}, Projection projection = {}) {
#if defined(__wasm__)
    std::ranges::make_heap(range, std::ref(less), std::ref(projection));
    std::ranges::sort_heap(range, std::ref(less), std::ref(projection));
#else
    std::ranges::sort(range, less, projection);
#endif
}

} // namespace chasles
