#include "python/src/face_lists.h"

#include "chasles/invalid_input.h"
#include "python/src/arrays.h"

#include <limits>

namespace chasles::python {
namespace {

std::uint32_t index_from(std::int64_t index, std::size_t face) {
    if (index < 0 || index > std::numeric_limits<std::uint32_t>::max())
        throw InvalidInput("faces[" + std::to_string(face) + "]: there is no vertex " + std::to_string(index));
    return static_cast<std::uint32_t>(index);
}

std::vector<std::uint32_t> outline(std::span<const std::int64_t> indices, std::size_t face) {
    std::vector<std::uint32_t> result(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
        result[i] = index_from(indices[i], face);
    return result;
}

Faces from_array(nb::handle argument) {
    const IndexArray array(argument, "faces");
    if (array.shape().size() != 2)
        throw InvalidInput("faces: the shape is " + array.shape_text() +
                           "; faces have (m, 3), or (m, k) for k corners each");
    const auto corners = std::size_t(array.shape()[1]);
    Faces faces(std::size_t(array.shape()[0]));
    for (std::size_t face = 0; face < faces.size(); ++face)
        faces[face] = outline(array.numbers().subspan(face * corners, corners), face);
    return faces;
}

Faces from_lists(const nb::sequence& lists) {
    Faces faces;
    for (const nb::handle list : lists) {
        const std::string name = "faces[" + std::to_string(faces.size()) + "]";
        const IndexArray indices(list, name);
        if (indices.shape().size() != 1)
            throw InvalidInput(name + ": the shape is " + indices.shape_text() +
                               "; a face is a list of vertex indices");
        faces.push_back(outline(indices.numbers(), faces.size()));
    }
    return faces;
}

/// Lists of one length are as good as an array, and faster as one.
bool has_one_length(const nb::sequence& lists) {
    std::size_t length = 0;
    for (const nb::handle list : lists) {
        const Py_ssize_t size = PyObject_Length(list.ptr());
        if (size < 0) {
            PyErr_Clear();
            return true; // no list of lists at all: the array will say what is wrong
        }
        if (length != 0 && std::size_t(size) != length)
            return false;
        length = std::size_t(size);
    }
    return true;
}

} // namespace

Faces faces_from(nb::handle argument) {
    nb::sequence lists;
    const bool is_list = PyList_Check(argument.ptr()) || PyTuple_Check(argument.ptr());
    if (is_list && nb::try_cast(argument, lists) && !has_one_length(lists))
        return from_lists(lists);
    return from_array(argument);
}

} // namespace chasles::python
