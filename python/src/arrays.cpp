// Reads arrays through the buffer protocol, which takes a tenth of a microsecond. NumPy converts all other arguments,
// which takes a few microseconds.
#include "python/src/arrays.h"

#include "chasles/base/invalid_input.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <nanobind/stl/string.h>

namespace chasles::python {
namespace {

template <typename Number>
constexpr const char* numpy_type = std::is_same_v<Number, double> ? "float64" : "int64";

template <typename Number>
constexpr const char* allowed_kinds = std::is_same_v<Number, double> ? "iuf" : "iu";

template <typename Number>
bool is_of(const Py_buffer& view) {
    return view.itemsize == sizeof(Number) && reinterpret_cast<std::uintptr_t>(view.buf) % alignof(Number) == 0;
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

/// Appends the numbers of a dimension, including all inner dimensions, in order.
template <typename Given, typename Number>
void append(const Py_buffer& view, int dimension, const char* at, std::vector<Number>& numbers) {
    for (Py_ssize_t i = 0; i < view.shape[dimension]; ++i, at += view.strides[dimension]) {
        if (dimension + 1 < view.ndim) {
            append<Given>(view, dimension + 1, at, numbers);
            continue;
        }
        Given given;
        std::memcpy(&given, at, sizeof(Given)); // it need not be aligned
        numbers.push_back(static_cast<Number>(given));
    }
}

template <typename Given, typename Number>
bool convert(const Py_buffer& view, std::vector<Number>& numbers) {
    numbers.reserve(std::size_t(view.len / view.itemsize));
    append<Given>(view, 0, static_cast<const char*>(view.buf), numbers);
    return true;
}

/// Converts whole numbers in the native byte order.
template <typename Number>
bool convert_whole(char format, const Py_buffer& view, std::vector<Number>& numbers) {
    switch (format) {
    case 'b':
        return convert<signed char>(view, numbers);
    case 'B':
        return convert<unsigned char>(view, numbers);
    case 'h':
        return convert<short>(view, numbers);
    case 'H':
        return convert<unsigned short>(view, numbers);
    case 'i':
        return convert<int>(view, numbers);
    case 'I':
        return convert<unsigned>(view, numbers);
    case 'l':
        return convert<long>(view, numbers);
    case 'L':
        return convert<unsigned long>(view, numbers);
    case 'q':
        return convert<long long>(view, numbers);
    case 'Q':
        return convert<unsigned long long>(view, numbers);
    default:
        return false;
    }
}

/// Returns whether the argument has a buffer. Clears any Python error.
bool get(nb::handle argument, Py_buffer& view) {
    if (!PyObject_CheckBuffer(argument.ptr()) || PyBytes_Check(argument.ptr())) // bytes are text, not numbers
        return false;
    if (PyObject_GetBuffer(argument.ptr(), &view, PyBUF_STRIDES | PyBUF_FORMAT) == 0)
        return true;
    PyErr_Clear();
    return false;
}

std::string text_of(const nb::object& object) {
    return nb::cast<std::string>(nb::str(nb::handle(object)));
}

/// "[2, 0]": where the first entry is true.
std::string place_of_first(const nb::object& flags) {
    return text_of(nb::module_::import_("numpy").attr("argwhere")(flags)[0].attr("tolist")());
}

constexpr int deepest_list = 4; // paths of poses of rows of numbers

/// Refuses a masked array, and one in lists of lists, with an entry that is masked.
void refuse_masked(nb::handle argument, const nb::object& masked_module, const std::string& name, int depth = 0) {
    if (PyList_Check(argument.ptr()) || PyTuple_Check(argument.ptr())) {
        if (depth < deepest_list)
            for (const nb::handle entry : nb::borrow<nb::sequence>(argument))
                refuse_masked(entry, masked_module, name, depth + 1);
        return;
    }
    const bool has_plain_type = !PyType_HasFeature(Py_TYPE(argument.ptr()), Py_TPFLAGS_HEAPTYPE);
    if (has_plain_type || !nb::isinstance(argument, masked_module.attr("MaskedArray")) ||
        !nb::cast<bool>(nb::bool_(masked_module.attr("is_masked")(argument))))
        return;
    const nb::object mask = masked_module.attr("getmaskarray")(argument);
    const bool is_one_number = nb::cast<std::size_t>(mask.attr("ndim")) == 0;
    throw InvalidInput(name + ": " + (is_one_number ? "a number" : "the entry " + place_of_first(mask)) +
                       " is masked, which leaves no number; give one by array.filled(...), or leave the entry out");
}

/// Whether the argument may be a masked array or hold one. All types of NumPy but these are types of C.
bool may_be_masked(nb::handle argument) {
    return PyType_HasFeature(Py_TYPE(argument.ptr()), Py_TPFLAGS_HEAPTYPE) || PyList_Check(argument.ptr()) ||
           PyTuple_Check(argument.ptr());
}

/// The first entry of an array of objects that is no number of this class, and its index. The entry is null if all are.
std::pair<nb::object, std::size_t> first_misfit(const nb::object& array, const nb::object& number) {
    std::size_t index = 0;
    for (const nb::handle entry : array.attr("flat")) {
        if (!nb::isinstance(entry, number))
            return {nb::borrow(entry), index};
        ++index;
    }
    return {};
}

/// What an array of objects holds, and how numbers are made of it.
template <typename Number>
std::string about_objects(const nb::object& array) {
    constexpr bool is_real = std::is_same_v<Number, double>;
    const nb::object number = nb::module_::import_("numbers").attr(is_real ? "Real" : "Integral");
    const auto [first, index] = first_misfit(array, number);
    if (!first.is_valid())
        return std::string("; its entries are numbers, and array.astype(") + (is_real ? "float" : "int") +
               ") makes one";
    if (first.is_none()) {
        const nb::object place = nb::module_::import_("numpy").attr("unravel_index")(index, array.attr("shape"));
        std::string text;
        for (const nb::handle part : place)
            text += (text.empty() ? "" : ", ") + text_of(nb::borrow(part));
        return ": the entry [" + text + "] is None";
    }
    const std::string type = text_of(first.type().attr("__name__"));
    if (nb::isinstance<nb::list>(first) || nb::isinstance<nb::tuple>(first))
        return " (of lists of different lengths)";
    if (nb::hasattr(first, "x") && nb::hasattr(first, "y") && nb::hasattr(first, "z"))
        return " (of " + type + "); take their numbers: [[p.x, p.y, p.z] for p in points]";
    if (nb::hasattr(first, "X") && nb::hasattr(first, "Y") && nb::hasattr(first, "Z"))
        return " (of " + type + "); take their numbers: [[p.X, p.Y, p.Z] for p in points]";
    return " (of " + type + ")";
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
        throw InvalidInput(name + ": not an array: " + text_of(nb::borrow(error.value())) +
                           "; rows of one length are needed, as in [[0, 0, 0], [1, 0, 0]]");
    }
    const auto kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
    const bool is_empty = nb::cast<std::size_t>(array.attr("size")) == 0; // NumPy makes floats of []
    if (!is_empty && std::string_view(allowed_kinds<Number>).find(kind) == std::string_view::npos)
        throw InvalidInput(name + ": an array of " + text_of(array.attr("dtype")) +
                           (std::is_same_v<Number, double> ? " is not an array of real numbers"
                                                           : " is not an array of whole numbers") +
                           (kind == "O" ? about_objects<Number>(array) : ""));
    return numpy.attr("require")(array, numpy_type<Number>, "CA");
}

} // namespace

std::string text_of_shape(std::span<const Py_ssize_t> shape) {
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i)
        text += (i ? ", " : "") + std::to_string(shape[i]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

std::string text_of_argument(nb::handle argument) {
    constexpr std::size_t most = 40;
    const auto name = nb::cast<std::string>(argument.type().attr("__name__"));
    const bool begins_with_vowel = std::string_view("aeiouAEIOU").find(name.front()) != std::string_view::npos;
    const std::string type = (begins_with_vowel ? "an " : "a ") + name;
    try {
        const std::string text = nb::cast<std::string>(nb::repr(argument));
        return text.size() <= most && text.find('\n') == std::string::npos ? text : type;
    } catch (nb::python_error& error) {
        if (!error.matches(PyExc_Exception)) // an interruption
            throw;
        return type; // such as of an object of which only __new__ was called
    }
}

std::string text_of(const Eigen::Vector3d& vector) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", vector.x(), vector.y(), vector.z());
}

void refuse_masked(nb::handle argument, const std::string& name) {
    if (!may_be_masked(argument))
        return;
    const nb::object masked_module = nb::module_::import_("sys").attr("modules").attr("get")("numpy.ma");
    if (!masked_module.is_none()) // otherwise there is no such array
        refuse_masked(argument, masked_module, name);
}

template <typename Number>
ArrayArgument<Number>::ArrayArgument(nb::handle argument, const std::string& name) {
    refuse_masked(argument, name);
    if (get(argument, view_)) {
        if (use_view())
            return;
        PyBuffer_Release(&view_);
    }
    const nb::object array = converted<Number>(argument, name);
    if (PyObject_GetBuffer(array.ptr(), &view_, PyBUF_STRIDES | PyBUF_FORMAT) != 0)
        throw nb::python_error();
    numbers_ = {static_cast<const Number*>(view_.buf), std::size_t(view_.len) / sizeof(Number)};
}

template <typename Number>
ArrayArgument<Number>::~ArrayArgument() {
    PyBuffer_Release(&view_);
}

template <typename Number>
bool ArrayArgument<Number>::use_view() {
    constexpr bool is_real = std::is_same_v<Number, double>;
    const std::string_view format = view_.format ? view_.format : "B";
    if (view_.ndim == 0 || format.size() != 1)
        return false;
    const bool has_type = is_real ? format == "d" : format == "l" || format == "q";
    if (has_type && is_of<Number>(view_) && is_contiguous(view_)) {
        numbers_ = {static_cast<const Number*>(view_.buf), std::size_t(view_.len) / sizeof(Number)};
        return true;
    }
    const bool is_converted = is_real && format == "d"   ? convert<double>(view_, converted_)
                              : is_real && format == "f" ? convert<float>(view_, converted_)
                                                         : convert_whole(format[0], view_, converted_);
    numbers_ = converted_;
    return is_converted;
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
        throw InvalidInput(name + ": the shape is " + array.shape_text() + "; a point has (3,), as in [0, 0, 1]");
    return Eigen::Map<const Eigen::Vector3d>(array.numbers().data());
}

nb::object array_of(std::span<const double> numbers, std::initializer_list<std::size_t> shape) {
    auto* const copy = new double[numbers.size() + 1]; // + 1: the array may be empty
    std::ranges::copy(numbers, copy);
    const nb::capsule owner(copy, [](void* memory) noexcept { delete[] static_cast<double*>(memory); });
    return nb::cast(OwnArray(copy, shape.size(), shape.begin(), owner));
}

nb::object array_of(const Eigen::Vector3d& vector) {
    return array_of(std::span(vector.data(), 3), {3});
}

} // namespace chasles::python
