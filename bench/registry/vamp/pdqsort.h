// What VAMP uses of the library pdqsort: any sort will do.
#pragma once

#include <algorithm>
#include <utility>

template <class Iterator, class Compare>
void pdqsort(Iterator begin, Iterator end, Compare compare) {
    std::sort(begin, end, std::move(compare));
}
template <class Iterator, class Compare>
void pdqsort_branchless(Iterator begin, Iterator end, Compare compare) {
    std::sort(begin, end, std::move(compare));
}
