// Arrays that Python hands over, as contiguous numbers, and arrays that it is given.
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

/// What an array of real numbers is in signatures.
#define CHASLES_ARRAY "numpy.typing.NDArray[numpy.float64]"

using OwnArray = nb::ndarray<nb::numpy, double>;

/// An argument that NumPy can make an array of real numbers from, of any type and strides, as contiguous numbers of one
/// type: in place if it is that already, otherwise converted, once. Throws InvalidInput "NAME: WHY".
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
    /// Whether the numbers of the view could be had.
    bool take_view();

    Py_buffer view_{}; ///< holds the array
    std::vector<Number> converted_;
    std::span<const Number> numbers_;
};

using DoubleArray = ArrayArgument<double>;
using IndexArray = ArrayArgument<std::int64_t>;

/// "(4, 3)", as Python writes a shape.
std::string text_of_shape(std::span<const Py_ssize_t> shape);

/// "(0.5, 1, -2)", six digits each.
std::string text_of(const Eigen::Vector3d& vector);

/// A point or vector from three numbers. Throws InvalidInput "NAME: WHY".
Eigen::Vector3d vector_from(nb::handle argument, const std::string& name);

/// Copies as arrays of their own.
nb::object array_of(const Eigen::Vector3d& vector);
nb::object array_of(std::span<const double> numbers, std::initializer_list<std::size_t> shape);

} // namespace chasles::python
