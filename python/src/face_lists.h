// Faces as Python hands them over: an array, or lists of any lengths.
#pragma once

#include "python/src/body.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <optional>
#include <span>

namespace chasles::python {

/// From an array of shape (m, k), or a sequence of m sequences of vertex indices. An array of 32-bit numbers is looked
/// at in place, anything else is converted, once. Throws InvalidInput "faces: WHY".
class FaceLists {
public:
    explicit FaceLists(nanobind::handle argument);

    [[nodiscard]] std::span<const std::span<const std::uint32_t>> lists() const { return lists_; }
    [[nodiscard]] Faces copies() const;

private:
    bool look_at(nanobind::handle argument);
    void convert_array(nanobind::handle argument);
    void convert_lists(const nanobind::sequence& lists);
    /// Rows of so many indices each, behind one another.
    void cut(const std::uint32_t* indices, std::size_t rows, std::size_t corners);

    nanobind::object held_; ///< what is looked at in place
    std::vector<std::uint32_t> converted_;
    std::vector<std::span<const std::uint32_t>> lists_;
};

} // namespace chasles::python
