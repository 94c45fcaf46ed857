// Arrays as arguments from Python, read as contiguous numbers, and arrays returned to Python.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <span>
#include <string>
#include <vector>

namespace chasles::python {

namespace nb = nanobind;

/// The type of an array of real numbers in signatures.
#define CHASLES_ARRAY "numpy.typing.NDArray[numpy.float64]"

using OwnArray = nb::ndarray<nb::numpy, double>;

/// An argument that NumPy can convert to an array of numbers, of any type and strides, as contiguous numbers of one
/// type. An argument that has this form is used in place; any other argument is converted once. Throws InvalidInput
/// "NAME: REASON".
template <typename Number>
class ArrayArgument {
public:
    ArrayArgument(nb::handle argument, const std::string& name);
    ~ArrayArgument();
    ArrayArgument(const ArrayArgument&) = delete;
    ArrayArgument& operator=(const ArrayArgument&) = delete;

    [[nodiscard]] std::span<const Number> numbers() const { return numbers_; }
    /// Sizes of the dimensions, outermost first.
    [[nodiscard]] std::span<const Py_ssize_t> shape() const { return {view_.shape, std::size_t(view_.ndim)}; }
    [[nodiscard]] std::string shape_text() const;

private:
    /// Reads the numbers of view_ in place or converts them. Returns false if their type is not supported.
    bool use_view();

    Py_buffer view_{}; ///< keeps the array alive
    std::vector<Number> converted_;
    std::span<const Number> numbers_;
};

/// Throws InvalidInput "NAME: REASON" for a masked array of NumPy, or a list of them, with an entry that is masked.
/// What is under a mask is no number of the user's, and neither the buffer of the array nor `numpy.asarray` tells of
/// it.
void refuse_masked(nb::handle argument, const std::string& name);

using DoubleArray = ArrayArgument<double>;
using IndexArray = ArrayArgument<std::int64_t>;

/// "(4, 3)", as Python writes a shape.
std::string text_of_shape(std::span<const Py_ssize_t> shape);

/// An argument in a message: "0.5", or "a list" where it is long.
std::string text_of_argument(nb::handle argument);

/// "(0.5, 1, -2)", with six digits per number.
std::string text_of(const Eigen::Vector3d& vector);

/// A point or vector from three numbers. Throws InvalidInput "NAME: REASON".
Eigen::Vector3d vector_from(nb::handle argument, const std::string& name);

/// New arrays with copies of the numbers.
nb::object array_of(const Eigen::Vector3d& vector);
nb::object array_of(std::span<const double> numbers, std::initializer_list<std::size_t> shape);

} // namespace chasles::python
