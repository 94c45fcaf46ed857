// Faces as an argument from Python: an array, or lists of any lengths.
#pragma once

#include <cstdint>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <optional>
#include <span>
#include <vector>

namespace chasles::python {

/// Faces from an array of shape (m, k), or from a sequence of m sequences of vertex indices. A contiguous array of
/// uint32 is used in place; any other argument is converted once. Throws InvalidInput "faces: REASON".
class FaceLists {
public:
    explicit FaceLists(nanobind::handle argument);

    [[nodiscard]] std::span<const std::span<const std::uint32_t>> lists() const { return lists_; }

private:
    bool use_in_place(nanobind::handle argument);
    void convert_array(nanobind::handle argument);
    void convert_lists(const nanobind::sequence& lists);
    /// Adds `rows` faces of `corners` consecutive indices each.
    void add_rows(const std::uint32_t* indices, std::size_t rows, std::size_t corners);

    nanobind::object held_; ///< the array that is used in place
    std::vector<std::uint32_t> converted_;
    std::vector<std::span<const std::uint32_t>> lists_;
};

} // namespace chasles::python
