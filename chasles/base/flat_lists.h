// Lists of varying length, stored one after another in one array.
// A list costs four bytes and no allocation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// List i consists of items[offsets[i]] to items[offsets[i + 1] - 1].
template <typename T>
struct FlatLists {
    std::vector<std::uint32_t> offsets; ///< n + 1 offsets for n lists; without offsets every list is empty
    std::vector<T> items;

    [[nodiscard]] std::size_t size() const { return offsets.empty() ? 0 : offsets.size() - 1; }

    [[nodiscard]] std::span<const T> operator[](std::size_t list) const {
        if (offsets.empty())
            return {};
        return std::span<const T>(items).subspan(offsets[list], offsets[list + 1] - offsets[list]);
    }

    void append(std::span<const T> list) {
        if (offsets.empty())
            offsets.push_back(0);
        items.insert(items.end(), list.begin(), list.end());
        offsets.push_back(static_cast<std::uint32_t>(items.size()));
    }

    /// Releases unused memory.
    void shrink() {
        offsets.shrink_to_fit();
        items.shrink_to_fit();
    }

    /// Bytes held.
    [[nodiscard]] std::size_t memory() const {
        return offsets.capacity() * sizeof(std::uint32_t) + items.capacity() * sizeof(T);
    }
};

} // namespace chasles
