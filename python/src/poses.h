// Poses that Python hands over and is given.
#pragma once

#include "chasles/motion/pose.h"
#include "python/src/arrays.h"

#include <string>
#include <vector>

namespace chasles::python {

/// A pose from an array of shape (4, 4), or (7,) for x y z qw qx qy qz. Throws InvalidInput "NAME: WHY".
Pose pose_from(nb::handle argument, const char* name);

/// Poses behind one another: an array of shape (n, 4, 4) or (n, 7), looked at in place.
class PoseArray {
public:
    /// Throws InvalidInput "NAME: WHY".
    PoseArray(nb::handle argument, const std::string& name);

    [[nodiscard]] std::size_t size() const { return size_; }
    /// Needs no GIL. Throws InvalidInput that does not say which.
    [[nodiscard]] Pose operator[](std::size_t index) const;

private:
    DoubleArray array_;
    std::size_t size_ = 0;
    std::size_t numbers_ = 7; ///< of one pose
};

/// The same as poses of their own; throws InvalidInput "NAME[INDEX]: WHY".
std::vector<Pose> poses_from(nb::handle argument, const std::string& name);

/// As an array of shape (4, 4), rounded to double precision.
nb::object matrix_of(const Pose& pose);

/// As the seven numbers that it is kept by.
nb::object numbers_of(const Pose& pose);

} // namespace chasles::python
