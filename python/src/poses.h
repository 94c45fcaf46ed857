// Conversion of poses from and to Python.
#pragma once

#include "chasles/motion/pose.h"
#include "python/src/arrays.h"

#include <string>
#include <vector>

namespace chasles::python {

/// A pose from an array of shape (4, 4), or (7,) for x y z qw qx qy qz. Throws InvalidInput "NAME: REASON".
Pose pose_from(nb::handle argument, const char* name);

/// An array of poses, of shape (n, 4, 4) or (n, 7), used in place.
class PoseArray {
public:
    /// Throws InvalidInput "NAME: REASON".
    PoseArray(nb::handle argument, const std::string& name);

    [[nodiscard]] std::size_t size() const { return size_; }
    /// Needs no GIL. Throws InvalidInput without the index.
    [[nodiscard]] Pose operator[](std::size_t index) const;

private:
    DoubleArray array_;
    std::size_t size_ = 0;
    std::size_t numbers_ = 7; ///< numbers per pose
};

/// Copies of the poses of such an array. Throws InvalidInput "NAME[INDEX]: REASON".
std::vector<Pose> poses_from(nb::handle argument, const std::string& name);

/// The pose as an array of shape (4, 4), rounded to double precision.
nb::object matrix_of(const Pose& pose);

/// The pose as its seven stored numbers.
nb::object numbers_of(const Pose& pose);

} // namespace chasles::python
