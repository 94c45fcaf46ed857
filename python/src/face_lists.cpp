#include "python/src/face_lists.h"

#include "chasles/base/invalid_input.h"
#include "python/src/arrays.h"

#include <limits>

namespace chasles::python {
namespace {

std::uint32_t index_from(std::int64_t index, std::size_t face) {
    if (index < 0 || index > std::numeric_limits<std::uint32_t>::max())
        throw InvalidInput("faces[" + std::to_string(face) + "]: there is no vertex " + std::to_string(index));
    return static_cast<std::uint32_t>(index);
}

/// Whether all lists have one length. They can then be converted as one array, which is faster.
bool has_one_length(const nb::sequence& lists) {
    std::size_t length = 0;
    for (const nb::handle list : lists) {
        const Py_ssize_t size = PyObject_Length(list.ptr());
        if (size < 0) {
            PyErr_Clear();
            return true; // not a list of lists: the conversion to an array throws the error message
        }
        if (length != 0 && std::size_t(size) != length)
            return false;
        length = std::size_t(size);
    }
    return true;
}

} // namespace

FaceLists::FaceLists(nb::handle argument) {
    refuse_masked(argument, "faces");
    nb::sequence lists;
    const bool is_list = PyList_Check(argument.ptr()) || PyTuple_Check(argument.ptr());
    if (is_list && nb::try_cast(argument, lists) && !has_one_length(lists))
        convert_lists(lists);
    else if (!use_in_place(argument))
        convert_array(argument);
}

void FaceLists::add_rows(const std::uint32_t* indices, std::size_t rows, std::size_t corners) {
    lists_.reserve(rows);
    for (std::size_t row = 0; row < rows; ++row)
        lists_.emplace_back(indices + row * corners, corners);
}

bool FaceLists::use_in_place(nb::handle argument) {
    nb::ndarray<const std::uint32_t, nb::ndim<2>, nb::c_contig, nb::device::cpu> array;
    if (!nb::isinstance<nb::ndarray<>>(argument) || !nb::try_cast(argument, array, false))
        return false;
    held_ = nb::borrow(argument);
    add_rows(array.data(), array.shape(0), array.shape(1));
    return true;
}

void FaceLists::convert_array(nb::handle argument) {
    const IndexArray array(argument, "faces");
    if (array.shape().size() != 2)
        throw InvalidInput("faces: the shape is " + array.shape_text() +
                           "; faces have (m, 3), or (m, k) for k corners each, as in [[0, 1, 2], [0, 2, 3]]");
    const auto corners = std::size_t(array.shape()[1]);
    converted_.reserve(array.numbers().size());
    for (const std::int64_t index : array.numbers())
        converted_.push_back(index_from(index, converted_.size() / corners));
    add_rows(converted_.data(), std::size_t(array.shape()[0]), corners);
}

void FaceLists::convert_lists(const nb::sequence& lists) {
    std::vector<std::size_t> ends;
    for (const nb::handle list : lists) {
        const std::string name = "faces[" + std::to_string(ends.size()) + "]";
        const IndexArray indices(list, name);
        if (indices.shape().size() != 1)
            throw InvalidInput(name + ": the shape is " + indices.shape_text() +
                               "; a face is a list of vertex indices");
        for (const std::int64_t index : indices.numbers())
            converted_.push_back(index_from(index, ends.size()));
        ends.push_back(converted_.size());
    }
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
        lists_.push_back(std::span<const std::uint32_t>(converted_).subspan(begin, end - begin));
        begin = end;
    }
}

} // namespace chasles::python
