// Reads arrays through the buffer protocol, which costs a tenth of a microsecond; what is not as wanted goes through
// NumPy first.
#include "python/src/arrays.h"

#include "chasles/invalid_input.h"

#include <algorithm>
#include <nanobind/stl/string.h>

namespace chasles::python {
namespace {

template <typename Number>
constexpr const char* numpy_type = std::is_same_v<Number, double> ? "float64" : "int64";

template <typename Number>
constexpr const char* allowed_kinds = std::is_same_v<Number, double> ? "iuf" : "iu";

template <typename Number>
bool has_type(const Py_buffer& view) {
    const std::string_view format = view.format ? view.format : "B";
    if constexpr (std::is_same_v<Number, double>)
        return format == "d" && view.itemsize == sizeof(double);
    else
        return (format == "l" || format == "q") && view.itemsize == sizeof(Number);
}

bool is_contiguous(const Py_buffer& view) {
    Py_ssize_t step = view.itemsize;
    for (int i = view.ndim - 1; i >= 0; --i) {
        if (view.shape[i] > 1 && view.strides[i] != step)
            return false;
        step *= view.shape[i];
    }
    return true;
}

bool is_aligned(const Py_buffer& view) {
    return reinterpret_cast<std::uintptr_t>(view.buf) % alignof(double) == 0;
}

/// Whether the buffer was got; leaves no error behind.
bool get(nb::handle argument, Py_buffer& view) {
    if (!PyObject_CheckBuffer(argument.ptr()))
        return false;
    if (PyObject_GetBuffer(argument.ptr(), &view, PyBUF_STRIDES | PyBUF_FORMAT) == 0)
        return true;
    PyErr_Clear();
    return false;
}

std::string text_of(const nb::object& object) {
    return nb::cast<std::string>(nb::str(nb::handle(object)));
}

template <typename Number>
nb::object converted(nb::handle argument, const std::string& name) {
    const nb::module_ numpy = nb::module_::import_("numpy");
    nb::object array;
    try {
        array = numpy.attr("asarray")(argument);
    } catch (nb::python_error& error) {
        if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError))
            throw;
        throw InvalidInput(name + ": not an array: " + text_of(nb::borrow(error.value())));
    }
    const auto kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
    const bool is_empty = nb::cast<std::size_t>(array.attr("size")) == 0; // NumPy makes floats of []
    if (!is_empty && std::string_view(allowed_kinds<Number>).find(kind) == std::string_view::npos)
        throw InvalidInput(
            name + ": an array of " + text_of(array.attr("dtype")) +
            (std::is_same_v<Number, double> ? " is not one of real numbers" : " is not one of whole numbers"));
    return numpy.attr("require")(array, numpy_type<Number>, "CA");
}

} // namespace

std::string text_of_shape(std::span<const Py_ssize_t> shape) {
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i)
        text += (i ? ", " : "") + std::to_string(shape[i]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

template <typename Number>
ArrayArgument<Number>::ArrayArgument(nb::handle argument, const std::string& name)
    : view_(std::make_unique<Py_buffer>()) {
    if (get(argument, *view_)) {
        if (has_type<Number>(*view_) && view_->ndim > 0 && is_contiguous(*view_) && is_aligned(*view_))
            return;
        PyBuffer_Release(view_.get());
    }
    const nb::object array = converted<Number>(argument, name);
    if (PyObject_GetBuffer(array.ptr(), view_.get(), PyBUF_STRIDES | PyBUF_FORMAT) != 0) {
        view_.reset();
        throw nb::python_error();
    }
}

template <typename Number>
ArrayArgument<Number>::ArrayArgument(ArrayArgument&& other) noexcept = default;

template <typename Number>
ArrayArgument<Number>::~ArrayArgument() {
    if (view_)
        PyBuffer_Release(view_.get());
}

template <typename Number>
std::span<const Number> ArrayArgument<Number>::numbers() const {
    return {static_cast<const Number*>(view_->buf), std::size_t(view_->len) / sizeof(Number)};
}

template <typename Number>
std::string ArrayArgument<Number>::shape_text() const {
    return text_of_shape(shape());
}

template class ArrayArgument<double>;
template class ArrayArgument<std::int64_t>;

Eigen::Vector3d vector_from(nb::handle argument, const std::string& name) {
    const DoubleArray array(argument, name);
    if (array.shape().size() != 1 || array.numbers().size() != 3)
        throw InvalidInput(name + ": the shape is " + array.shape_text() + "; a point has (3,)");
    return Eigen::Map<const Eigen::Vector3d>(array.numbers().data());
}

nb::object array_of(std::span<const double> numbers, std::initializer_list<std::size_t> shape) {
    auto* const copy = new double[numbers.size() + 1]; // + 1: nothing is an array too
    std::ranges::copy(numbers, copy);
    const nb::capsule owner(copy, [](void* memory) noexcept { delete[] static_cast<double*>(memory); });
    return nb::cast(OwnArray(copy, shape.size(), shape.begin(), owner));
}

nb::object array_of(const Eigen::Vector3d& vector) {
    return array_of(std::span(vector.data(), 3), {3});
}

} // namespace chasles::python
