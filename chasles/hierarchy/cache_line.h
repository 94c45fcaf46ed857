// An allocator for memory that starts at a cache line.
// Pairs of sibling nodes of a BVH then share one cache line.
#pragma once

#include <cstddef>
#include <new>

namespace chasles {

inline constexpr std::size_t cache_line = 64; ///< bytes

/// An allocator for containers of the standard library.
template <class T>
struct CacheLineAllocator {
    using value_type = T;

    CacheLineAllocator() = default;
    template <class Other>
    // NOLINTNEXTLINE(google-explicit-constructor): required by containers
    CacheLineAllocator(const CacheLineAllocator<Other>&) {}

    T* allocate(std::size_t count) {
        return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t(cache_line)));
    }
    void deallocate(T* place, std::size_t) { ::operator delete(place, std::align_val_t(cache_line)); }

    friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

} // namespace chasles
